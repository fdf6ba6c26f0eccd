// SPDX-License-Identifier: GPL-2.0-or-later
/// \file slip_map.h
/// What one rupture did on a plane, as maps of its cells and as a series in time †.
#ifndef LSM_POSTPROC_SLIP_MAP_H
#define LSM_POSTPROC_SLIP_MAP_H

#include <array>
#include <vector>

#include "events/event_picker.h"
#include "files/slip_history.h"

namespace LSM::postproc {

/// Moment per time in one record.
struct MomentRate {
  double time;  ///< middle of the record, since the rupture began
  FaultVector rate;
};

/// Maps of the rectangle in which a rupture slipped, row by row from the lowest up, and along
/// strike within a row. Slip before it, after it and outside of the rectangle is left out.
struct SlipMap {
  FaultAxis strike, dip;     ///< of the rectangle; on a ring it may continue across the seam
  double x_first, z_first;   ///< hypocentre
  std::vector<double> slip;  ///< length of the slip of each cell, from begin to end
  /// Time since the rupture began at which the slip velocity of a cell exceeds the least one for
  /// the first time, linear between the middles of the records, hence up to 1.5 records early where
  /// it jumps; NaN where it never does.
  std::vector<double> time;
  std::vector<double> rate;  ///< largest slip velocity of a cell in a record
  std::vector<MomentRate> moment;

  double x(std::size_t cell) const { return strike.centre(static_cast<int>(cell) % strike.bins); }
  double z(std::size_t cell) const { return dip.centre(static_cast<int>(cell) / strike.bins); }
};

/// Reads the records of a rupture from the history of its plane.
/// \param event a rupture of the same run
/// \param least slip velocity above which it has come to a cell
/// \throws FileError if the history cannot be read
/// \throws std::runtime_error if it does not have all of the rupture, or this slips nowhere as fast
SlipMap slip_map(SlipHistoryReader &reader, const Event &event, double least);

/// A piece of the line on which a map has one value.
struct ContourPiece {
  double level;
  std::array<double, 2> x, z;
};
/// Contours at whole multiples of `spacing` of a function with values at the middles of the cells,
/// which is linear on the two triangles between each four of them, and absent where a value is NaN.
std::vector<ContourPiece> contours(const SlipMap &map, const std::vector<double> &values,
                                   double spacing);

}  // namespace LSM::postproc

#endif
