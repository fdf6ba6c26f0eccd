// SPDX-License-Identifier: GPL-2.0-or-later
/// \file block_length.h
/// How many consecutive values have to stay together when a correlated series is resampled.
#ifndef LSM_POSTPROC_BLOCK_LENGTH_H
#define LSM_POSTPROC_BLOCK_LENGTH_H

#include <vector>

namespace LSM::postproc {

/// Block length (in values) with the least mean-square error of the variance of the mean in a
/// circular block bootstrap: Politis & White 2004 (Econometric Reviews 23, 53) as corrected by
/// Patton, Politis & White 2009 (ibid. 28, 372). It grows as the cube root of the number of values:
/// blocks are long against the correlation, so that few sequences are cut, and short against the
/// series, so that there are many of them. Our choice: at least that cube root, so that
/// correlations too weak to be significant lag by lag are allowed for, and at most a tenth of the
/// series.
/// \param values consecutive values of a stationary series with mean 0
double block_length(const std::vector<double> &values);

}  // namespace LSM::postproc

#endif
