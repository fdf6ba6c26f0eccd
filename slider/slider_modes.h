// SPDX-License-Identifier: GPL-2.0-or-later
/// \file slider_modes.h
/// Forces between blocks that are coupled by a stiffness per mode, with FFTW.
#ifndef SLIDER_MODES_H
#define SLIDER_MODES_H

#include <memory>
#include <vector>

#include "slider_array.h"
#include "slider_parameters.h"

struct fftw_plan_s;

namespace Slider {

/// Arrays of ModeForces, in whole chunks.
struct ModeArrays {
  double *apart = nullptr;           ///< displacements less a common part, as blocks move far
  double *spectrum = nullptr;        ///< transform of these: real and imaginary part of each mode
  const double *factors = nullptr;   ///< -C / blocks, for real and imaginary part of each mode
  int values = 0;                    ///< length of spectrum and of factors
  const double *coupling = nullptr;  ///< force of the coupling, without leaf springs
};

/// The coupling of a periodic fault: the force on block i is -sum_j C_ij u_j, where C is K(q) less
/// its value at q = 0, the leaf spring, which pulls towards the plate.
///
/// Transforms are planned once, with FFTW_ESTIMATE: measured plans depend on the load of the
/// machine, and so would the last digits of the results. Any number of blocks is allowed; those
/// with small prime factors are fastest.
class ModeForces {
 public:
  /// \param modes stiffness of the modes 0 to blocks / 2
  ModeForces(const std::vector<double> &modes, int blocks);
  ~ModeForces();
  ModeForces(const ModeForces &) = delete;
  ModeForces &operator=(const ModeForces &) = delete;

  /// Computes the force of the coupling on each block.
  /// \param u displacements
  const double *find(const double *u);

  /// The arrays for a kernel that itself fills in the displacements and multiplies the spectrum by
  /// the factors, and calls transform() and transform_back().
  const ModeArrays &arrays() const { return arrays_; }
  void transform();
  void transform_back();

 private:
  int blocks_;
  Array apart_, spectrum_, factors_, coupling_;
  ModeArrays arrays_;
  fftw_plan_s *forward_, *backward_;
};

/// Returns the coupling by modes that the parameters describe, or null if springs couple the
/// blocks.
inline std::unique_ptr<ModeForces> mode_forces(const Parameters &p) {
  return p.by_springs() ? nullptr : std::make_unique<ModeForces>(p.modes, p.blocks);
}

}  // namespace Slider

#endif
