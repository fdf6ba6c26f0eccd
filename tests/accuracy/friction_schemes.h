// SPDX-License-Identifier: GPL-2.0-or-later
/// \file friction_schemes.h
/// A small fault without LAMMPS, on one core, to compare two ways of solving friction: the
/// tangential spring of pair lsm/friction, and friction without a spring, solved at half steps as
/// in Place & Mora (1999) by projected Gauss-Seidel sweeps. Forces, plates and integrator are those
/// of the LAMMPS styles, so that the spring gives their trajectory.
#ifndef LSM_ACCURACY_FRICTION_SCHEMES_H
#define LSM_ACCURACY_FRICTION_SCHEMES_H

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

#include "friction/force_laws.h"

namespace Accuracy {

/// Vector in the plane.
struct Vector {
  double x = 0.0, y = 0.0;
  friend Vector operator+(Vector a, Vector b) { return {a.x + b.x, a.y + b.y}; }
  friend Vector operator-(Vector a, Vector b) { return {a.x - b.x, a.y - b.y}; }
  friend Vector operator*(double s, Vector a) { return {s * a.x, s * a.y}; }
  friend double dot(Vector a, Vector b) { return a.x * b.x + a.y * b.y; }
};

enum class Side : std::uint8_t { block, below, above, lower_plate, upper_plate };

struct Disc {
  Vector x, v, f;
  double r = 0.0, m = 0.0;
  Side side = Side::block;
};

/// Constants of the scene; compare fault_event.in.
struct Constants {
  double length = 0.0, k = 1.0, kt = 1.0, mu = 0.6, stress = 0.0, velocity = 0.0, viscosity = 0.0,
         impedance = 0.0;
};

/// A pair across the fault that touches or may touch soon. The spring uses the elongation xi and
/// the vector of the previous step, and the rigid law uses the impulse.
struct Contact {
  int i = 0, j = 0;
  bool touches = false;
  double xi = 0.0, impulse = 0.0;
  Vector before;
  double normal_force = 0.0;
  Vector tangent;
};

/// State shortly before an event: discs, links and contacts.
struct Scene {
  Constants constants;
  std::vector<Disc> discs;
  std::vector<std::array<int, 2>> links;
  std::vector<Contact> contacts;
};

/// What both laws have in common: links, normal forces, plates, viscosity and the list of contacts.
class SmallFault {
 public:
  explicit SmallFault(Scene scene) : s_(std::move(scene)), c_(s_.constants) {
    for (std::size_t n = 0; n < s_.discs.size(); ++n) {
      const Disc &d = s_.discs[n];
      const auto id = static_cast<int>(n);
      if (d.side == Side::below) below_.push_back(id);
      if (d.side == Side::above) above_.push_back(id);
      if (d.side == Side::lower_plate) plates_[0].add(id, d);
      if (d.side == Side::upper_plate) plates_[1].add(id, d);
    }
    list_contacts();
  }

  const std::vector<Disc> &discs() const { return s_.discs; }

 protected:
  /// Sets the forces to those of the links.
  /// \return elastic energy of the links
  double link_forces() {
    double pe = 0.0;
    for (Disc &d : s_.discs) d.f = {};
    for (const auto &l : s_.links) {
      Disc &a = s_.discs[static_cast<std::size_t>(l[0])],
           &b = s_.discs[static_cast<std::size_t>(l[1])];
      const Vector d = around(a.x - b.x);
      const double r = std::sqrt(dot(d, d)), stretch = r - (a.r + b.r);
      const Vector f = (LSM::Spring::force(c_.k, stretch) / r) * d;
      a.f = a.f - f;
      b.f = b.f + f;
      pe += LSM::Spring::energy(c_.k, stretch);
    }
    return pe;
  }

  /// Half a kick of the blocks. Viscosity acts for half a step, after a final and before an initial
  /// kick.
  void half_kick(double dt, bool initial) {
    const double damp = std::exp(-0.5 * c_.viscosity * dt);
    for (Disc &d : s_.discs) {
      if (d.side >= Side::lower_plate) continue;
      if (initial) d.v = damp * d.v;
      d.v = d.v + (0.5 * dt / d.m) * d.f;
      if (!initial) d.v = damp * d.v;
    }
    for (int p : {0, 1}) {
      Plate &plate = plates_[p];
      double fy = p == 0 ? c_.stress * c_.length : -c_.stress * c_.length;
      for (int n : plate.discs) fy += disc(n).f.y;
      const double absorbed = std::exp(-0.5 * c_.impedance * c_.length / plate.mass * dt);
      if (initial) plate.vy *= damp * absorbed;
      plate.vy += 0.5 * dt * fy / plate.mass;
      if (!initial) plate.vy *= damp * absorbed;
      for (int n : plate.discs) disc(n).v = {p == 0 ? -c_.velocity : c_.velocity, plate.vy};
    }
  }

  void drift(double dt) {
    for (Disc &d : s_.discs) d.x = d.x + dt * d.v;
    double fastest = 0.0;
    for (const auto &side : {below_, above_})
      for (int n : side) fastest = std::max(fastest, dot(disc(n).v, disc(n).v));
    moved_ += 2.0 * dt * std::sqrt(fastest);
    if (moved_ > skin) list_contacts();
  }

  Vector around(Vector d) const {
    d.x -= c_.length * std::round(d.x / c_.length);
    return d;
  }
  Disc &disc(int n) { return s_.discs[static_cast<std::size_t>(n)]; }

  Scene s_;
  const Constants &c_;

 private:
  static constexpr double skin = 0.2,
                          near = 1.05;  // near: in sums of radii, as in pair lsm/friction
  struct Plate {
    std::vector<int> discs;
    double mass = 0.0, vy = 0.0;
    void add(int n, const Disc &d) {
      discs.push_back(n);
      mass += d.m;
      vy = d.v.y;
    }
  };

  /// Lists the pairs that may touch before the fastest disc has moved by the skin; known pairs keep
  /// their state.
  void list_contacts() {
    std::vector<Contact> fresh;
    std::sort(above_.begin(), above_.end(),
              [this](int a, int b) { return wrapped(a) < wrapped(b); });
    const double reach = near * 2.0 + skin;
    for (int i : below_) {
      const double from = wrapped(i);
      for (const double shift : {-c_.length, 0.0, c_.length}) {
        auto j = std::lower_bound(above_.begin(), above_.end(), from + shift - reach,
                                  [this](int n, double x) { return wrapped(n) < x; });
        for (; j != above_.end() && wrapped(*j) <= from + shift + reach; ++j) {
          const Vector d = around(disc(i).x - disc(*j).x);
          if (std::sqrt(dot(d, d)) > near * (disc(i).r + disc(*j).r) + skin) continue;
          Contact c;
          c.i = i;
          c.j = *j;
          c.before = d;
          fresh.push_back(c);
        }
      }
    }
    auto order = [](const Contact &a, const Contact &b) {
      return a.i != b.i ? a.i < b.i : a.j < b.j;
    };
    std::sort(fresh.begin(), fresh.end(), order);
    std::sort(s_.contacts.begin(), s_.contacts.end(), order);
    for (const Contact &known : s_.contacts) {
      const auto at = std::lower_bound(fresh.begin(), fresh.end(), known, order);
      if (at != fresh.end() && at->i == known.i && at->j == known.j) *at = known;
    }
    s_.contacts = std::move(fresh);
    moved_ = 0.0;
  }
  double wrapped(int n) const {
    const double x = s_.discs[static_cast<std::size_t>(n)].x.x;
    return x - c_.length * std::floor(x / c_.length);
  }

  std::vector<int> below_, above_;
  std::array<Plate, 2> plates_;
  double moved_ = 0.0;
};

/// Friction with a tangential spring; the onset of a contact is located within the step.
class SpringFault : public SmallFault {
 public:
  SpringFault(Scene scene, double dt) : SmallFault(std::move(scene)), dt_(dt) {
    pe_ = forces(true);
  }

  void step() {
    half_kick(dt_, true);
    drift(dt_);
    pe_ = forces(false);
    half_kick(dt_, false);
  }
  double pe() const { return pe_; }

 private:
  double forces(bool setup) {
    double pe = link_forces();
    const LSM::Coulomb::Coefficients law{c_.kt, c_.mu, c_.mu};
    for (Contact &c : s_.contacts) {
      Disc &a = disc(c.i), &b = disc(c.j);
      const Vector d = around(a.x - b.x);
      const double r = std::sqrt(dot(d, d)), r0 = a.r + b.r;
      const double fn = LSM::contact_normal_force(c_.k, r, r0);
      const Vector n = (1.0 / r) * d;
      if (r >= r0) {
        c.touches = false;
        c.xi = 0.0;
      } else {
        if (!setup) {
          const Vector middle = d + c.before, change = d - c.before;
          double along =
              (middle.x * change.y - middle.y * change.x) / std::sqrt(dot(middle, middle));
          if (!c.touches) along *= LSM::share_in_contact(std::sqrt(dot(c.before, c.before)), r, r0);
          c.xi = LSM::friction_step<LSM::Coulomb>(law, {fn, c.xi, along, 0.0, false}).xi;
        }
        c.touches = true;
        const double ft = c_.kt * c.xi;
        const Vector f{fn * n.x + ft * n.y, fn * n.y - ft * n.x};
        a.f = a.f + f;
        b.f = b.f - f;
        pe += LSM::Spring::energy(c_.k, r - r0) + LSM::Spring::energy(c_.kt, c.xi);
      }
      c.before = d;
    }
    return pe;
  }

  double dt_, pe_;
};

/// Friction without a spring: at each half step impulses of at most mu F_n dt stop the tangential
/// motion of every contact as far as they can. Sweeps over the contacts are repeated until no
/// velocity changes by more than the tolerance.
class RigidFault : public SmallFault {
 public:
  RigidFault(Scene scene, double dt, double tolerance)
      : SmallFault(std::move(scene)), dt_(dt), tolerance_(tolerance) {
    for (Contact &c : s_.contacts) c.impulse = -0.5 * c_.kt * c.xi * dt_;
    pe_ = forces();
    half_kick(dt_, true);
    solve(0.5 * dt_);
    for (Contact &c : s_.contacts) c.impulse *= 2.0;
  }

  void step() {
    drift(dt_);
    pe_ = forces();
    half_kick(dt_, false);
    half_kick(dt_, true);
    solve(dt_);
    ++steps_;
  }
  double pe() const { return pe_; }
  double sweeps_per_step() const {
    return static_cast<double>(sweeps_) / static_cast<double>(steps_);
  }

 private:
  double forces() {
    double pe = link_forces();
    for (Contact &c : s_.contacts) {
      Disc &a = disc(c.i), &b = disc(c.j);
      const Vector d = around(a.x - b.x);
      const double r = std::sqrt(dot(d, d)), r0 = a.r + b.r;
      c.touches = r < r0;
      if (!c.touches) {
        c.impulse = 0.0;
        continue;
      }
      c.normal_force = LSM::contact_normal_force(c_.k, r, r0);
      const Vector n = (1.0 / r) * d;
      c.tangent = {-n.y, n.x};
      a.f = a.f + c.normal_force * n;
      b.f = b.f - c.normal_force * n;
      pe += LSM::Spring::energy(c_.k, r - r0);
    }
    return pe;
  }

  void apply(const Contact &c, double impulse) {
    Disc &a = disc(c.i), &b = disc(c.j);
    a.v = a.v + (impulse / a.m) * c.tangent;
    b.v = b.v - (impulse / b.m) * c.tangent;
  }

  void solve(double dt) {
    for (const Contact &c : s_.contacts)
      if (c.touches) apply(c, c.impulse);  // that of the previous step is a good start
    double change = 0.0;
    int sweep = 0;
    do {
      change = 0.0;
      for (Contact &c : s_.contacts) {
        if (!c.touches) continue;
        const Disc &a = disc(c.i), &b = disc(c.j);
        const double mobility = 1.0 / a.m + 1.0 / b.m, most = c_.mu * c.normal_force * dt;
        const double wanted = c.impulse - dot(a.v - b.v, c.tangent) / mobility;
        const double impulse = std::clamp(wanted, -most, most), more = impulse - c.impulse;
        if (more == 0.0) continue;
        apply(c, more);
        c.impulse = impulse;
        change = std::max(change, std::fabs(more) * mobility);
      }
      ++sweep;
    } while (change > tolerance_ && sweep < 10000);
    sweeps_ += sweep;
  }

  double dt_, tolerance_, pe_;
  std::int64_t sweeps_ = 0, steps_ = 0;
};

}  // namespace Accuracy

#endif
