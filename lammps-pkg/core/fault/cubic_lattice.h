// SPDX-License-Identifier: GPL-2.0-or-later
/// \file fault/cubic_lattice.h
/// Two blocks of the simple cubic lattice with a flat fault between them (*).
///
/// Each node is linked along 6 edges and 12 diagonals of faces, all of the same stiffness k: C11 =
/// 3 k/a, C12 = C44 = k/a, which is isotropic. Every cube contributes a quarter of each of its 12
/// edges, half of each of its 12 diagonals, and an eighth of the mass of its nodes. Thus masses and
/// links in the borders of a block are shares of those inside, and a homogeneous strain is exact up
/// to the borders. The nodes on both sides of the fault are those of one plane, split: they are
/// drawn a spacing apart, as contacts have a length.
#ifndef LSM_CUBIC_LATTICE_H
#define LSM_CUBIC_LATTICE_H

#include <array>
#include <cmath>
#include <cstdint>
#include <stdexcept>
#include <string>

namespace LSM {

class CubicLattice {
 public:
  struct Node {
    int x, y, z;
  };
  struct Sizes {
    double length = 0.0;                  ///< along the fault: x
    double width = 0.0;                   ///< of both blocks together: y
    double depth = 0.0;                   ///< z, from -depth to 0
    double spacing = 0.0;                 ///< of the nodes, and their diameter
    bool ring_x = false, ring_z = false;  ///< whether the fault is periodic
  };
  /// Types of links: along edges, by their share of the stiffness, and along diagonals.
  enum LinkType { EDGE = 1, HALF_EDGE, QUARTER_EDGE, DIAGONAL, HALF_DIAGONAL };
  static constexpr int LINK_TYPES = HALF_DIAGONAL, LINKS = 18;

  CubicLattice() = default;
  /// \throws std::invalid_argument
  explicit CubicLattice(const Sizes &s) : a_(s.spacing), ring_{s.ring_x, false, s.ring_z} {
    if (!(a_ > 0.0) || !std::isfinite(a_)) fail("spacing", a_, "a positive number");
    count_ = {intervals("length", s.length) + !ring_[0],
              2 * (1 + intervals("width", 0.5 * s.width, "half ")),
              intervals("depth", s.depth) + !ring_[2]};
    if (static_cast<double>(count_[0]) * count_[1] * count_[2] > 2e9 / LINKS)
      throw std::invalid_argument("too many particles");
  }

  int count(int axis) const { return count_[static_cast<std::size_t>(axis)]; }
  std::int64_t size() const { return std::int64_t{1} * count_[0] * count_[1] * count_[2]; }
  int block(const Node &n) const { return n.y < count_[1] / 2 ? 0 : 1; }
  bool in_fault(const Node &n) const { return n.y == count_[1] / 2 - 1 || n.y == count_[1] / 2; }
  bool in_plate(const Node &n) const { return n.y == 0 || n.y == count_[1] - 1; }
  /// Consecutive from 1.
  std::int64_t id(const Node &n) const {
    return 1 + n.x + std::int64_t{1} * count_[0] * (n.z + std::int64_t{1} * count_[2] * n.y);
  }
  /// The fault is in the middle of x and y, and its highest nodes are at z = 0.
  std::array<double, 3> place(const Node &n) const {
    return {a_ * (n.x - 0.5 * (count_[0] - 1)), a_ * (n.y - 0.5 * (count_[1] - 1)),
            a_ * (n.z - (count_[2] - 1))};
  }
  /// Half a spacing beyond the outermost nodes: where a period ends.
  std::array<double, 2> limits(int axis) const {
    const std::size_t c = static_cast<std::size_t>(axis);
    const Node last = {count_[0] - 1, count_[1] - 1, count_[2] - 1};
    return {place({0, 0, 0})[c] - 0.5 * a_, place(last)[c] + 0.5 * a_};
  }
  /// Share of the mass of a node inside.
  double share(const Node &n) const {
    double part = 1.0;
    for (int axis = 0; axis < 3; ++axis)
      if (in_border(n, axis)) part *= 0.5;
    return part;
  }

  /// Calls act(node, type of link) for the neighbours of a node, each once if `forward` (there are
  /// as many behind it), otherwise all.
  template <class Act>
  void for_links(const Node &n, bool forward, const Act &act) const {
    static constexpr int steps[][3] = {{1, 0, 0}, {0, 1, 0},  {0, 0, 1}, {1, 1, 0}, {1, -1, 0},
                                       {1, 0, 1}, {1, 0, -1}, {0, 1, 1}, {0, 1, -1}};
    for (const auto &step : steps)
      for (const int sign : {1, -1}) {
        if (forward && sign < 0) continue;
        Node to = {n.x + sign * step[0], n.y + sign * step[1], n.z + sign * step[2]};
        if (!wrap(to.x, 0) || !wrap(to.y, 1) || !wrap(to.z, 2) || block(to) != block(n)) continue;
        int zeros = 0, type = 0;  // the type is that of the whole link plus the halvings
        for (int axis = 0; axis < 3; ++axis)
          if (step[axis] == 0) {
            ++zeros;
            type += in_border(n, axis);
          }
        act(to, (zeros == 2 ? EDGE : DIAGONAL) + type);
      }
  }

 private:
  double a_ = 1.0;
  std::array<bool, 3> ring_{};
  std::array<int, 3> count_{};

  [[noreturn]] static void fail(const std::string &name, double value, const std::string &what) {
    throw std::invalid_argument(name + " = " + std::to_string(value) + ", expected " + what);
  }
  int intervals(const char *name, double size, const std::string &part = "") const {
    const double n = size / a_;
    if (!(n > 2.5 && n < 1e6)) fail(part + name, size, "3 to 1e6 times the spacing");
    if (std::fabs(n - std::round(n)) > 1e-6)
      fail(part + name, size, "a multiple of the spacing " + std::to_string(a_));
    return static_cast<int>(std::lround(n));
  }
  bool in_border(const Node &n, int axis) const {
    if (axis == 1) return in_fault(n) || in_plate(n);
    const int at = axis == 0 ? n.x : n.z;
    return !ring_[static_cast<std::size_t>(axis)] && (at == 0 || at == count(axis) - 1);
  }
  bool wrap(int &at, int axis) const {
    const int n = count(axis);
    if (ring_[static_cast<std::size_t>(axis)]) at = (at + n) % n;
    return at >= 0 && at < n;
  }
};

}  // namespace LSM

#endif
