// SPDX-License-Identifier: GPL-2.0-or-later
#include "fault/packing.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <sstream>
#include <stdexcept>
#include <tuple>

#include "numerics/constants.h"
#include "numerics/random.h"

namespace LSM {

namespace {

/// A grid of cells over [0, length) x [ylo, yhi], periodic in x. No cell is smaller than `least`.
template <class Entry>
class Cells {
 public:
  const int nx, ny;
  const double dx, dy;

  Cells(double length, double ylo, double yhi, double least)
      : nx(std::max(1, static_cast<int>(length / least))),
        ny(std::max(1, static_cast<int>((yhi - ylo) / least))),
        dx(length / nx),
        dy((yhi - ylo) / ny),
        length_(length),
        ylo_(ylo),
        cells_(static_cast<std::size_t>(nx) * static_cast<std::size_t>(ny)) {}

  int column(double x) const { return std::min(nx - 1, std::max(0, static_cast<int>(x / dx))); }
  int row(double y) const {
    return std::min(ny - 1, std::max(0, static_cast<int>((y - ylo_) / dy)));
  }
  /// The column may lie one beyond the periodic boundary; shift() is then to be added to the x of
  /// its entries.
  std::vector<Entry> &at(int ix, int iy) {
    ix += ix < 0 ? nx : ix >= nx ? -nx : 0;
    return cells_[static_cast<std::size_t>(ix) * static_cast<std::size_t>(ny) +
                  static_cast<std::size_t>(iy)];
  }
  double shift(int ix) const { return ix < 0 ? -length_ : ix >= nx ? length_ : 0.0; }
  void insert(double x, double y, const Entry &entry) { at(column(x), row(y)).push_back(entry); }

  const std::vector<std::vector<Entry>> &all() const { return cells_; }

 private:
  double length_, ylo_;
  std::vector<std::vector<Entry>> cells_;
};

/// One block, or both if the fault line is among the lines between the first and the last:
/// [0, length) x [ylo, yhi], periodic in x, with a cell grid for neighbour searches. No disc
/// crosses a line.
class BlockPacker {
 public:
  BlockPacker(const PackingSettings &settings, const std::vector<double> &lines, Random &random)
      : set_(settings),
        lines_(lines),
        ylo_(lines.front()),
        yhi_(lines.back()),
        random_(random),
        // no cell is smaller than rmax, so a search of few rings is enough
        cells_(settings.length, ylo_, yhi_, settings.rmax) {}

  void run() {
    if (set_.random_faces) place_face();
    if (set_.random_seeds)
      place_seeds();
    else
      place_seeds_on_grid();
    fill();
  }

  int64_t tries() const { return tries_; }

  /// Calls f(x, y, r) for each disc, cell by cell.
  template <class F>
  void for_each(F &&f) const {
    for (const auto &cell : cells_.all())
      for (const Entry &e : cell) f(e.x, e.y, e.r);
  }

 private:
  struct Entry {
    double x, y, r;
  };

  /// A disc (line = 0) at (x, y) relative to the trial point, or a line at height y below
  /// (line = +1) or above (line = -1) the point. s is the distance of its surface from the point.
  struct Object {
    double s, x, y, r;
    int line;
  };

  static constexpr double FAR = 1e300;

  double wrap(double x) const {
    if (x < 0.0) x += set_.length;
    // a tiny negative x may round to length
    if (x >= set_.length) x -= set_.length;
    return x;
  }

  /// Whether a disc at (x, y), x in [0, length) and y in [ylo, yhi], crosses no line and overlaps
  /// no other disc.
  bool fits(double x, double y, double r) {
    const double slack = set_.tolerance * r;
    for (const double line : lines_)
      if (std::fabs(y - line) < r - slack) return false;
    // A disc further away than this along x or y cannot overlap.
    const double reach = r + set_.rmax;
    const int kx = std::min(static_cast<int>(reach / cells_.dx) + 1, (cells_.nx - 1) / 2);
    const int ylow = cells_.row(y - reach), yhigh = cells_.row(y + reach);
    const int cx = cells_.column(x);
    for (int ix = cx - kx; ix <= cx + kx; ++ix) {
      const double shift = cells_.shift(ix);
      for (int iy = ylow; iy <= yhigh; ++iy)
        for (const Entry &e : cells_.at(ix, iy)) {
          const double ex = e.x + shift - x, ey = e.y - y;
          const double sum = (e.r + r) * (1.0 - set_.tolerance);
          if (ex * ex + ey * ey < sum * sum) return false;
        }
    }
    return true;
  }

  // ---------------------------------------------------------------- face and seeds

  /// Discs of random radius that touch the fault line at random places.
  void place_face() {
    const double line = 0.5 * set_.width, away = ylo_ < line ? -1.0 : 1.0;
    until_full([&](double xlo, double xsize) {
      const double x = wrap(xlo + xsize * random_.uniform());
      const auto [least, most] = range(true);
      const double r = random_.uniform(least, most);
      return insert_if_it_fits(x, line + away * r, r);
    });
  }

  /// Places as many discs as a hexagonal grid of spacing 2 rmax has, so that no hole is too wide to
  /// be filled. Their positions are random, as a grid would give the faces its period along the
  /// whole fault.
  void place_seeds() {
    const double height = yhi_ - ylo_;
    const int columns = static_cast<int>(set_.length / (2.0 * set_.rmax));
    const int rows =
        1 + static_cast<int>((height - 2.0 * set_.rmax) / (std::sqrt(3.0) * set_.rmax));
    int missing = columns * rows;
    for (int failed = 0; missing > 0 && failed < set_.max_failures;) {
      const double x = wrap(set_.length * random_.uniform());
      const double y = ylo_ + height * random_.uniform();
      const double r = random_.uniform(set_.rmin, set_.rmax);
      const bool fitted = insert_if_it_fits(x, y, r);
      missing -= fitted;
      failed = fitted ? 0 : failed + 1;
    }
  }

  /// Discs of random radius on a hexagonal grid, in coordinates that do not depend on the block.
  void place_seeds_on_grid() {
    const double across = std::sqrt(3.0) * set_.rmax, along = 2.0 * set_.rmax;
    for (int j = static_cast<int>(std::ceil(ylo_ / across)); j * across <= yhi_; ++j)
      for (int i = 0; i < set_.length / along; ++i) {
        const double r = random_.uniform(set_.rmin, set_.rmax);
        insert_if_it_fits(wrap(along * (i + 0.5 * (j % 2))), across * j, r);
      }
  }

  bool insert_if_it_fits(double x, double y, double r) {
    if (!fits(x, y, r)) return false;
    cells_.insert(x, y, {x, y, r});
    return true;
  }

  // ---------------------------------------------------------------- filling

  void fill() {
    until_full([this](double xlo, double xsize) {
      ++tries_;
      return try_point(xlo, xsize);
    });
  }

  /// Calls attempt(xlo, xsize) until it has failed max_failures times in a row everywhere. The
  /// block is divided along x into tiles about TILE rmax long, which take turns until they are
  /// full, so that the density does not depend on the length. Without faces there is one tile.
  template <class Attempt>
  void until_full(Attempt &&attempt) {
    const int most = static_cast<int>(set_.length / (TILE * set_.rmax));
    const int ntile = set_.random_faces ? std::max(1, most) : 1;
    const double tile = set_.length / ntile;
    std::vector<int> failures(static_cast<std::size_t>(ntile), 0);
    int open = ntile;
    while (open > 0) {
      for (int t = 0; t < ntile; ++t) {
        int &failed = failures[static_cast<std::size_t>(t)];
        if (failed >= set_.max_failures) continue;
        for (int n = 0; n < ROUND && failed < set_.max_failures; ++n)
          failed = attempt(t * tile, tile) ? 0 : failed + 1;
        if (failed >= set_.max_failures) --open;
      }
    }
  }

  bool try_point(double xlo, double xsize) {
    const double px = wrap(xlo + xsize * random_.uniform());
    const double py = ylo_ + (yhi_ - ylo_) * random_.uniform();
    Object near[3];
    if (!nearest(px, py, near)) return false;
    Entry circles[2];
    const int n = tangent_circles(near, circles);
    const auto [least, most] = range(set_.face_rmax > 0.0 && touches_fault(py, near));
    const auto in_range = [least = least, most = most](double r) {
      return r >= least && r <= most;
    };
    for (int i = 0; i < n; ++i) {
      auto &[x, y, r] = circles[i];
      if (!in_range(r) || !polish(near, x, y, r) || !in_range(r)) continue;
      const double nx = wrap(px + x), ny = py + y;
      if (ny > ylo_ && ny < yhi_ && insert_if_it_fits(nx, ny, r)) return true;
    }
    return false;
  }

  /// Radii of discs, of which those at the fault line may have their own.
  std::pair<double, double> range(bool at_fault) const {
    if (at_fault && set_.face_rmax > 0.0) return {set_.face_rmin, set_.face_rmax};
    return {set_.rmin, set_.rmax};
  }

  /// Whether one of the objects around a point at height py is the fault line.
  bool touches_fault(double py, const Object *near) const {
    return std::any_of(near, near + 3, [this, py](const Object &o) {
      return o.line && std::fabs(py + o.y - 0.5 * set_.width) < 0.25 * set_.width;
    });
  }

  static void offer(Object *near, const Object &o) {
    if (o.s >= near[2].s) return;
    int i = 2;
    for (; i > 0 && o.s < near[i - 1].s; --i) near[i] = near[i - 1];
    near[i] = o;
  }

  /// The three objects nearest to (px, py) by surface distance, nearest first.
  bool nearest(double px, double py, Object *near) {
    near[0] = near[1] = near[2] = {FAR, 0.0, 0.0, 0.0, 0};
    for (const double line : lines_)
      offer(near, {std::fabs(py - line), 0.0, line - py, 0.0, line <= py ? 1 : -1});
    const int nx = cells_.nx, ny = cells_.ny, cx = cells_.column(px), cy = cells_.row(py);
    const double dx = cells_.dx, dy = cells_.dy;
    const double fx = px - cx * dx, fy = py - ylo_ - cy * dy;
    const double inset = std::min(std::min(fx, dx - fx), std::min(fy, dy - fy));
    const double step = std::min(dx, dy);
    const int last = std::max((nx - 1) / 2, ny - 1);
    for (int k = 0; k <= last; ++k) {
      // centres in ring k and beyond are at least this far away
      if (k > 0 && inset + (k - 1) * step - set_.rmax >= near[2].s) break;
      for (int jy = -k; jy <= k; ++jy) {
        const int iy = cy + jy;
        if (iy < 0 || iy >= ny) continue;
        const bool edge = (jy == -k || jy == k);
        const double gy = jy == 0 ? 0.0 : (jy > 0 ? jy * dy - fy : fy - (jy + 1) * dy);
        for (int jx = -k; jx <= k; jx += (edge || k == 0) ? 1 : 2 * k) {
          if (2 * jx > nx - 1 || -2 * jx > nx - 1) continue;
          const double gx = jx == 0 ? 0.0 : (jx > 0 ? jx * dx - fx : fx - (jx + 1) * dx);
          const double far = near[2].s + set_.rmax;
          if (near[2].s < FAR && gx * gx + gy * gy >= far * far) continue;
          const double shift = cells_.shift(cx + jx) - px;
          for (const Entry &e : cells_.at(cx + jx, iy)) {
            const double ex = e.x + shift, ey = e.y - py, limit = near[2].s + e.r;
            const double d2 = ex * ex + ey * ey;
            if (limit <= 0.0 || d2 >= limit * limit) continue;
            offer(near, {std::sqrt(d2) - e.r, ex, ey, e.r, 0});
          }
        }
      }
    }
    return near[2].s < FAR;
  }

  /// Circles that touch three objects from outside (at most two), smaller radius first.
  /// With the first disc as origin, |p| = r + r1, the other two conditions are linear in (p, r):
  /// p . n_k = a_k - b_k r, hence p = A - B r, and |A - B r| = r + r1 is a quadratic equation.
  static int tangent_circles(const Object *o, Entry *circles) {
    int base = -1, lines = 0;
    for (int i = 0; i < 3; ++i) {
      if (o[i].line)
        ++lines;
      else if (base < 0)
        base = i;
    }
    // a circle that touches two lines is wider than rmax allows
    if (lines > 1) return 0;
    const Object &d = o[base];
    double n[2][2], a[2], b[2];
    int m = 0;
    for (int i = 0; i < 3; ++i) {
      if (i == base) continue;
      if (o[i].line) {
        n[m][0] = 0.0;
        n[m][1] = 1.0;
        a[m] = o[i].y - d.y;
        b[m] = -o[i].line;
      } else {
        const double ex = o[i].x - d.x, ey = o[i].y - d.y;
        n[m][0] = ex;
        n[m][1] = ey;
        a[m] = 0.5 * (ex * ex + ey * ey - (o[i].r - d.r) * (o[i].r + d.r));
        b[m] = o[i].r - d.r;
      }
      ++m;
    }
    const double det = n[0][0] * n[1][1] - n[0][1] * n[1][0];
    if (det == 0.0) return 0;
    const double ax = (a[0] * n[1][1] - a[1] * n[0][1]) / det;
    const double ay = (a[1] * n[0][0] - a[0] * n[1][0]) / det;
    const double bx = (b[0] * n[1][1] - b[1] * n[0][1]) / det;
    const double by = (b[1] * n[0][0] - b[0] * n[1][0]) / det;
    // q2 r^2 - 2 q1 r + q0 = 0
    const double q2 = bx * bx + by * by - 1.0;
    const double q1 = ax * bx + ay * by + d.r;
    const double q0 = ax * ax + ay * ay - d.r * d.r;
    const double disc = q1 * q1 - q2 * q0;
    if (!(disc >= 0.0)) return 0;
    // roots as q0 / s and s / q2: no cancellation, and one of them stays finite when q2 -> 0
    const double s = q1 >= 0.0 ? q1 + std::sqrt(disc) : q1 - std::sqrt(disc);
    double root[2];
    int count = 0;
    if (s != 0.0) root[count++] = q0 / s;
    if (q2 != 0.0) root[count++] = s / q2;
    if (count == 2 && root[1] < root[0]) std::swap(root[0], root[1]);
    for (int i = 0; i < count; ++i)
      circles[i] = {d.x + ax - bx * root[i], d.y + ay - by * root[i], root[i]};
    return count;
  }

  /// Newton steps on the three gaps: the closed form loses digits when the three objects are
  /// nearly in line. False if the gaps cannot be brought down to rounding.
  bool polish(const Object *o, double &x, double &y, double &r) const {
    const double exact = EXACT * set_.rmax, close = CLOSE * set_.rmax;
    double worst = FAR;
    for (int iter = 0; iter < 4; ++iter) {
      // row i: gradient (g0, g1, -1) of gap i = distance - r
      double g[3][2], f[3];
      double next = 0.0;
      for (int i = 0; i < 3; ++i) {
        if (o[i].line) {
          g[i][0] = 0.0;
          g[i][1] = o[i].line;
          f[i] = o[i].line * (y - o[i].y) - r;
        } else {
          const double ex = x - o[i].x, ey = y - o[i].y;
          const double d = std::sqrt(ex * ex + ey * ey);
          if (!(d > 0.0)) return false;
          g[i][0] = ex / d;
          g[i][1] = ey / d;
          f[i] = d - o[i].r - r;
        }
        next = std::max(next, f[i] < 0.0 ? -f[i] : f[i]);
      }
      if (!(next < FAR)) return false;
      if (next < exact || (iter > 0 && next >= worst)) {
        worst = next;
        break;
      }
      worst = next;
      const double a00 = g[1][0] - g[0][0], a01 = g[1][1] - g[0][1], e0 = f[1] - f[0];
      const double a10 = g[2][0] - g[0][0], a11 = g[2][1] - g[0][1], e1 = f[2] - f[0];
      const double det = a00 * a11 - a01 * a10;
      if (det == 0.0) return false;
      const double ux = (e0 * a11 - e1 * a01) / det, uy = (e1 * a00 - e0 * a10) / det;
      x -= ux;
      y -= uy;
      r += f[0] - g[0][0] * ux - g[0][1] * uy;
    }
    return worst < close;
  }

  // gaps in units of rmax, so that the packing does not depend on the unit of length
  static constexpr double EXACT = 1e-15;  // no step improves on this
  static constexpr double CLOSE = 1e-13;  // largest gap accepted, before the rounding of x itself
  static constexpr double TILE = 15.0;    // length of a tile in rmax
  static constexpr int ROUND = 64;        // tries in one tile before the next tile takes its turn

  const PackingSettings &set_;
  const std::vector<double> lines_;
  const double ylo_, yhi_;
  Random &random_;
  Cells<Entry> cells_;
  int64_t tries_ = 0;
};

template <class A, class B>
[[noreturn]] void reject(const char *name, const A &value, const char *expected, const B &bound) {
  std::ostringstream msg;
  msg << name << " = " << value << ", expected " << expected << bound;
  throw std::invalid_argument(msg.str());
}

// Across the period, three links of this ratio fit into the smallest length, 8 rmax, so that no two
// discs are linked twice; and strains begin far from those that stop a run.
constexpr double MOST_LINK_RATIO = 1.25;

constexpr double SECTION = 64.0;  // of discs in memory, in rmax

void check(const PackingSettings &s) {
  const std::pair<const char *, double> positive[] = {
      {"length", s.length}, {"width", s.width},         {"rmin", s.rmin},
      {"rmax", s.rmax},     {"tolerance", s.tolerance}, {"linkgap", s.link_gap},
  };
  for (const auto &p : positive)
    if (!(p.second > 0.0) || !(p.second < 1e300))
      reject(p.first, p.second, "a positive finite number", "");
  if (!(s.rmin < s.rmax)) reject("rmin", s.rmin, "a value below rmax = ", s.rmax);
  if (s.face_rmin != 0.0 || s.face_rmax != 0.0) {
    if (!(s.face_rmin > 0.0) || !(s.face_rmin <= s.face_rmax))
      reject("faceradii", s.face_rmin, "a number above 0, and at most the second, ", s.face_rmax);
    if (!(s.face_rmax <= s.rmax)) reject("faceradii", s.face_rmax, "at most rmax = ", s.rmax);
  }
  const double smallest = s.face_rmax > 0.0 ? std::min(s.rmin, s.face_rmin) : s.rmin;
  if (s.max_failures < 1) reject("failures", s.max_failures, "at least ", 1);
  if (!(s.tolerance <= 1e-4)) reject("tolerance", s.tolerance, "at most ", 1e-4);
  // Discs that overlap within the tolerance must still count as tangent.
  if (!(s.link_gap < 0.1 * smallest))
    reject("linkgap", s.link_gap, "less than rmin/10, also of faceradii: ", 0.1 * smallest);
  if (!(s.link_ratio >= 1.0) || !(s.link_ratio <= MOST_LINK_RATIO))
    reject("linkratio", s.link_ratio, "1 to ", MOST_LINK_RATIO);
  if (!(s.fault_zone >= s.link_gap) || !(s.fault_zone < 1e300))
    reject("faultzone", s.fault_zone, "at least linkgap = ", s.link_gap);
  // each disc must meet at most one image of any other, with room for the neighbour search
  if (!(s.length >= 8.0 * s.rmax))
    reject("length", s.length, "at least 8 rmax for a periodic fault, that is ", 8.0 * s.rmax);
  // no disc reaches from the fault zone of its block to the plate
  const double least = 2.0 * (2.0 * s.rmax + s.fault_zone + s.link_gap);
  if (!(s.width > least))
    reject("width", s.width, "more than 2 (2 rmax + faultzone + linkgap) = ", least);
  if (s.length / s.rmax * (s.width / s.rmax) > 5e8)
    reject("length", s.length, "less than 5e8 rmax^2 / width = ", 5e8 * s.rmax * s.rmax / s.width);
}

/// Surface distance of a disc from the fault line.
double fault_gap(const PackingSettings &s, const Disc &d) {
  return (d.block == 0 ? 0.5 * s.width - d.y : d.y - 0.5 * s.width) - d.r;
}

void fill_blocks(const PackingSettings &s, Packing &result) {
  Random random(s.seed);
  const double middle = 0.5 * s.width;
  std::vector<std::vector<double>> parts{{0.0, middle}, {middle, s.width}};
  if (s.mirror)
    parts = {{0.0, middle}};
  else if (!s.random_faces)
    parts = {{0.0, middle, s.width}};
  for (const std::vector<double> &lines : parts) {
    BlockPacker packer(s, lines, random);
    packer.run();
    result.tries += packer.tries();
    packer.for_each([&](double x, double y, double r) {
      const int block = y < middle ? 0 : 1;
      Disc disc{x, y, r, block, false, (block == 0 ? y : s.width - y) - r < s.link_gap};
      disc.fault = fault_gap(s, disc) < s.fault_zone;
      result.discs.push_back(disc);
    });
  }
  if (!s.mirror) return;
  const std::size_t lower = result.discs.size();
  for (std::size_t i = 0; i < lower; ++i) {
    Disc disc = result.discs[i];
    disc.y = s.width - disc.y;
    disc.block = 1;
    result.discs.push_back(disc);
  }
}

/// Sorts discs by sections along the fault; within a section, those that can be in contact come
/// first, then the blocks, then the plates, each sorted by x. Loops over particles, links or
/// contacts in this order find their data in the cache, and each kind is contiguous.
void sort_discs(const PackingSettings &s, Packing &result) {
  const double section = SECTION * s.rmax;
  const auto key = [section](const Disc &d) {
    return std::make_tuple(static_cast<int>(d.x / section), d.plate ? 2 : (d.fault ? 0 : 1), d.x,
                           d.y);
  };
  std::sort(result.discs.begin(), result.discs.end(),
            [&key](const Disc &a, const Disc &b) { return key(a) < key(b); });
}

/// Links discs that are tangent or close. The cells are at least as large as the longest link.
void link_discs(const PackingSettings &s, Packing &result) {
  const int n = static_cast<int>(result.discs.size());
  const auto longest = [&s](double sum) { return std::max(sum + s.link_gap, s.link_ratio * sum); };
  Cells<int> cells(s.length, 0.0, s.width, longest(2.0 * s.rmax));
  for (int i = 0; i < n; ++i) cells.insert(result.disc(i).x, result.disc(i).y, i);
  std::vector<int> partners;
  for (int i = 0; i < n; ++i) {
    const Disc &a = result.disc(i);
    partners.clear();
    const int cx = cells.column(a.x), cy = cells.row(a.y);
    for (int ix = cx - 1; ix <= cx + 1; ++ix)
      for (int iy = std::max(0, cy - 1); iy <= std::min(cells.ny - 1, cy + 1); ++iy)
        for (const int j : cells.at(ix, iy)) {
          if (j <= i) continue;
          const Disc &b = result.disc(j);
          if (b.block != a.block) continue;
          const auto [ex, ey] = link_vector(s.length, a, b);
          const double limit = longest(a.r + b.r);
          if (ex * ex + ey * ey < limit * limit) partners.push_back(j);
        }
    std::sort(partners.begin(), partners.end());
    for (const int j : partners) result.links.emplace_back(i, j);
  }
}

/// The discs that are linked to each disc.
using Partners = std::vector<std::vector<std::size_t>>;

Partners partners_of(const Packing &packing) {
  Partners partners(packing.discs.size());
  for (const auto &l : packing.links) {
    partners[static_cast<std::size_t>(l.first)].push_back(static_cast<std::size_t>(l.second));
    partners[static_cast<std::size_t>(l.second)].push_back(static_cast<std::size_t>(l.first));
  }
  return partners;
}

/// Finds discs with fewer than ENOUGH_LINKS links. With `remove`, links to such discs do not count.
std::vector<char> with_few_links(const Packing &packing, const Partners &partners, bool remove) {
  std::vector<char> few(partners.size(), 0);
  std::vector<std::size_t> links, check(partners.size());
  for (const auto &of_one : partners) links.push_back(of_one.size());
  std::iota(check.begin(), check.end(), std::size_t{0});
  while (!check.empty()) {
    const std::size_t i = check.back();
    check.pop_back();
    if (few[i] || packing.discs[i].plate || links[i] >= ENOUGH_LINKS) continue;
    few[i] = 1;
    if (!remove) continue;
    for (const std::size_t j : partners[i]) {
      --links[j];
      check.push_back(j);
    }
  }
  return few;
}

/// Finds discs that belong to a plate or are connected to one through discs that are not removed.
std::vector<char> connected_to_plates(const Packing &packing, const Partners &partners,
                                      const std::vector<char> &removed) {
  std::vector<char> connected(partners.size(), 0);
  std::vector<std::size_t> check;
  const auto connect = [&](std::size_t i) {
    connected[i] = 1;
    check.push_back(i);
  };
  for (std::size_t i = 0; i < connected.size(); ++i)
    if (packing.discs[i].plate) connect(i);
  while (!check.empty()) {
    const std::size_t i = check.back();
    check.pop_back();
    for (const std::size_t j : partners[i])
      if (!connected[j] && !removed[j]) connect(j);
  }
  return connected;
}

void remove_discs(const std::vector<char> &removed, Packing &packing) {
  std::vector<int> place(removed.size(), -1);
  std::vector<Disc> discs;
  for (std::size_t i = 0; i < removed.size(); ++i) {
    if (removed[i]) continue;
    place[i] = static_cast<int>(discs.size());
    discs.push_back(packing.discs[i]);
  }
  packing.discs.swap(discs);
  std::vector<std::pair<int, int>> links;
  for (const auto &l : packing.links) {
    const int i = place[static_cast<std::size_t>(l.first)],
              j = place[static_cast<std::size_t>(l.second)];
    if (i >= 0 && j >= 0) links.emplace_back(i, j);
  }
  packing.links.swap(links);
}

/// Finds the loose discs and, if asked to, removes them and those that this leaves loose.
void find_loose(const PackingSettings &s, Packing &result) {
  const Partners partners = partners_of(result);
  std::vector<char> loose = with_few_links(result, partners, s.remove_loose);
  const std::vector<char> connected = connected_to_plates(
      result, partners, s.remove_loose ? loose : std::vector<char>(loose.size(), 0));
  for (std::size_t i = 0; i < loose.size(); ++i) {
    loose[i] = loose[i] || !connected[i];
    if (!loose[i]) continue;
    ++result.loose;
    if (fault_gap(s, result.discs[i]) < s.link_gap) ++result.loose_tangent;
  }
  if (s.remove_loose) remove_discs(loose, result);
}

/// Sum of n n^T over the links of a disc (n: direction of the link).
struct Support {
  double xx = 0.0, xy = 0.0, yy = 0.0;
  int links = 0;

  double mean() const { return 0.5 * (xx + yy); }
  double apart() const {
    const double half = 0.5 * (xx - yy);
    return std::sqrt(half * half + xy * xy);
  }
  double softest() const { return std::max(0.0, mean() - apart()); }
  double stiffest() const { return mean() + apart(); }
};

std::vector<Support> supports(double length, const Packing &packing) {
  std::vector<Support> support(packing.discs.size());
  for (const auto &l : packing.links) {
    const auto i = static_cast<std::size_t>(l.first), j = static_cast<std::size_t>(l.second);
    const auto [ex, ey] = link_vector(length, packing.discs[i], packing.discs[j]);
    const double d2 = ex * ex + ey * ey;
    for (const std::size_t k : {i, j}) {
      support[k].xx += ex * ex / d2;
      support[k].xy += ex * ey / d2;
      support[k].yy += ey * ey / d2;
      ++support[k].links;
    }
  }
  return support;
}

void measure(const PackingSettings &s, Packing &result) {
  double area = 0.0;
  bool first = true;
  const std::vector<Support> support = supports(s.length, result);
  for (std::size_t i = 0; i < result.discs.size(); ++i) {
    const Disc &d = result.discs[i];
    area += d.r * d.r;
    result.rmin_found = i == 0 ? d.r : std::min(result.rmin_found, d.r);
    if (fault_gap(s, d) < s.link_gap) ++result.fault_tangent[d.block];
    if (d.plate) continue;
    const double softest = support[i].softest();
    result.weakest = first ? softest : std::min(result.weakest, softest);
    first = false;
  }
  result.area_fraction = pi * area / (s.length * s.width);
  const auto n = static_cast<double>(result.discs.size());
  result.coordination = n > 0 ? 2.0 * static_cast<double>(result.links.size()) / n : 0.0;
}

/// The discs tangent to the fault line, and the part of the line that they cover on the side where
/// it is less.
struct Faces {
  int discs = 0;
  double covered = 0.0;
};

Faces faces_of(const PackingSettings &s, const Packing &packing) {
  Faces faces;
  double sides[2] = {0.0, 0.0};
  for (const Disc &d : packing.discs) {
    if (fault_gap(s, d) >= s.link_gap) continue;
    ++faces.discs;
    sides[d.block] += 2.0 * d.r / s.length;
  }
  faces.covered = std::min(sides[0], sides[1]);
  return faces;
}

/// With less, the blocks are rubble that touches in a few places. (*)
constexpr double LEAST_COVERED = 1.0 / 3.0;
/// The same of the number of discs at the fault line. (*)
constexpr double LEAST_LEFT = 0.1;

/// Rejects a block with a hole from plate to fault: somewhere along x it has no disc.
void reject_hole(const PackingSettings &s, const Packing &packing, int block) {
  std::vector<std::pair<double, double>> covered;
  for (const Disc &d : packing.discs)
    if (d.block == block && !d.plate) covered.emplace_back(d.x - d.r, d.x + d.r);
  if (covered.empty()) return;
  std::sort(covered.begin(), covered.end());
  double reached = 0.0;
  for (const auto &one : covered) reached = std::max(reached, one.second - s.length);
  covered.emplace_back(s.length + std::min(0.0, covered.front().first), s.length);
  for (const auto &[from, to] : covered) {
    if (from > reached + s.link_gap)
      reject("rmin", s.rmin, "radii that fill the blocks, but ",
             (block == 0 ? "the lower one has a hole from plate to fault at x = "
                         : "the upper one has a hole from plate to fault at x = ") +
                 std::to_string(0.5 * (from + reached)));
    reached = std::max(reached, to);
  }
}

}  // namespace

std::pair<double, double> link_vector(double length, const Disc &a, const Disc &b) {
  double ex = b.x - a.x;
  if (ex > 0.5 * length) ex -= length;
  if (ex < -0.5 * length) ex += length;
  return {ex, b.y - a.y};
}

Packing make_packing(const PackingSettings &settings) {
  check(settings);
  Packing result;
  fill_blocks(settings, result);
  sort_discs(settings, result);
  link_discs(settings, result);
  const Faces before = faces_of(settings, result);
  find_loose(settings, result);
  if (settings.remove_loose) {
    for (const int block : {0, 1})
      if (std::none_of(result.discs.begin(), result.discs.end(),
                       [block](const Disc &d) { return d.block == block && !d.plate; }))
        reject("loose", "remove",
               "discs of this range of radii to hold each other, but none of the ",
               block == 0 ? "lower block is left" : "upper block is left");
    const Faces after = faces_of(settings, result);
    if ((before.covered >= LEAST_COVERED && after.covered < LEAST_COVERED) ||
        after.discs < LEAST_LEFT * before.discs)
      reject("loose", "remove", "discs of this range of radii to hold each other, but ",
             std::to_string(result.discs.size()) + " are left, " + std::to_string(after.discs) +
                 " of " + std::to_string(before.discs) +
                 " tangent to the fault line; give a wider range, or loose keep");
    for (const int block : {0, 1}) reject_hole(settings, result, block);
  }
  measure(settings, result);
  return result;
}

int most_neighbours(double radius, double r) {
  const double least = 0.9 * r;
  return static_cast<int>(pi / std::asin(least / (radius + least)));
}

std::vector<double> masses_for_step(const Packing &packing, double length, double dt,
                                    double stiffness, double kt) {
  const std::vector<Support> support = supports(length, packing);
  double least = std::numeric_limits<double>::infinity();
  for (const Disc &d : packing.discs) least = std::min(least, d.r);
  std::vector<double> masses;
  for (std::size_t i = 0; i < packing.discs.size(); ++i) {
    const int room = most_neighbours(packing.discs[i].r, least) - support[i].links;
    const double felt =
        stiffness * support[i].stiffest() + std::max(0, room) * std::max(stiffness, kt);
    masses.push_back(0.5 * dt * dt * felt);
  }
  return masses;
}

}  // namespace LSM
