// SPDX-License-Identifier: GPL-2.0-or-later
#include "fault/lattice.h"

#include <algorithm>

#include <stdexcept>
#include <string>

namespace LSM {

Packing make_lattice(const LatticeSettings &s) {
  if (!(s.spacing > 0.0) || !std::isfinite(s.spacing))
    throw std::invalid_argument("spacing = " + std::to_string(s.spacing) +
                                ", expected a positive number");
  if (!(s.length < 1e6 * s.spacing) || s.columns() < 4)
    throw std::invalid_argument("length = " + std::to_string(s.length) +
                                ", expected 4 to 1e6 times the spacing");
  if (!(s.width < 1e6 * s.spacing) || s.rows() < 3)
    throw std::invalid_argument("width = " + std::to_string(s.width) +
                                ", expected 4 to 1e6 times the spacing");
  const int columns = s.columns(), rows = s.rows();
  if (static_cast<double>(columns) * rows > 2e8) throw std::invalid_argument("too many particles");
  Packing packing;
  std::vector<int> first;  // disc of each row
  const auto count = [&](int row) { return s.ring || row % 2 == 0 ? columns : columns - 1; };
  for (int line = -rows; line < rows; ++line) {
    const int block = line < 0 ? 0 : 1, row = block ? line : -1 - line;
    const double y = 0.5 * s.spacing + row * s.row_height();
    first.push_back(static_cast<int>(packing.discs.size()));
    for (int n = 0; n < count(row); ++n)
      packing.discs.push_back({-s.half_length() + (n + 0.5 + 0.5 * (row % 2)) * s.spacing,
                               block ? y : -y, 0.5 * s.spacing, block, row == 0, row == rows - 1});
    // a disc half a spacing beyond the end belongs to the other end
    if (s.ring && row % 2 == 1) packing.discs.back().x = -s.half_length();
  }
  const auto link = [&packing](int a, int b) {
    packing.links.emplace_back(std::min(a, b), std::max(a, b));
  };
  for (int line = 0; line < 2 * rows; ++line) {
    const int row = line < rows ? rows - 1 - line : line - rows, mine = count(row);
    for (int n = 0; n + (s.ring ? 0 : 1) < mine; ++n)
      link(first[line] + n, first[line] + (n + 1) % mine);
    if (line + 1 == rows || line + 1 == 2 * rows) continue;
    // the row above is shifted by half a spacing, to the right from an even row
    const int others = count(line + 1 < rows ? row - 1 : row + 1);
    for (int n = 0; n < mine; ++n)
      for (int m : {n - (row % 2 ? 0 : 1), n + (row % 2 ? 1 : 0)}) {
        if (s.ring) m = (m + others) % others;
        if (m >= 0 && m < others) link(first[line] + n, first[line + 1] + m);
      }
  }
  std::sort(packing.links.begin(), packing.links.end());
  packing.fault_tangent[0] = packing.fault_tangent[1] = columns;
  packing.rmin_found = 0.5 * s.spacing;
  packing.coordination =
      2.0 * static_cast<double>(packing.links.size()) / static_cast<double>(packing.discs.size());
  return packing;
}

}  // namespace LSM
