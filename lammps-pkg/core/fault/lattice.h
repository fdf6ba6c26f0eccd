// SPDX-License-Identifier: GPL-2.0-or-later
/// \file fault/lattice.h
/// Two blocks of the regular triangular lattice whose rows at the fault are mirror images of each
/// other (*).
#ifndef LSM_LATTICE_H
#define LSM_LATTICE_H

#include <cmath>

#include "fault/packing.h"

namespace LSM {

struct LatticeSettings {
  double length = 0.0;   ///< along the fault
  double width = 0.0;    ///< of both blocks together
  double spacing = 0.0;  ///< diameter of the discs
  bool ring = true;      ///< whether the fault is periodic

  int columns() const { return static_cast<int>(std::lround(length / spacing)); }
  double row_height() const { return 0.5 * std::sqrt(3.0) * spacing; }
  int rows() const {
    return 1 + static_cast<int>(0.5 * width / row_height() * (1.0 + 1e-12));
  }  ///< of a block
  /// The fault line is in the middle, with x from -half_length to half_length.
  double half_length() const { return 0.5 * columns() * spacing; }
  /// Distance from the fault line to the centres of the outer rows.
  double half_width() const { return 0.5 * spacing + (rows() - 1) * row_height(); }
};

/// Whether a link lies in a straight border of a block. Half of the surroundings are missing there;
/// with half the stiffness, and half the mass of its discs, the blocks are linear triangular finite
/// elements.
inline bool in_border(const Packing &packing, const std::pair<int, int> &link) {
  const Disc &a = packing.disc(link.first), &b = packing.disc(link.second);
  return (a.fault && b.fault) || (a.plate && b.plate);
}

/// Places discs row by row, from the lowest row to the highest. The discs of the two rows at the
/// fault face each other, at x = (n + 1/2) spacing from one end, so that each bin as wide as a disc
/// holds one of them. Without ring, every second row has one disc less.
/// \throws std::invalid_argument
Packing make_lattice(const LatticeSettings &s);

}  // namespace LSM

#endif
