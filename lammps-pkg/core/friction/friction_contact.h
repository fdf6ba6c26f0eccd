// SPDX-License-Identifier: GPL-2.0-or-later
/// \file friction/friction_contact.h
/// What is remembered of two particles that touch, or nearly touch, from one step to the next.
#ifndef LSM_FRICTION_CONTACT_H
#define LSM_FRICTION_CONTACT_H

#include <array>
#include <cmath>

#include "friction/force_laws.h"

namespace LSM::friction_contact {

/// Numbers of a displacement along a contact: one, along the tangent (-ny, nx), in two dimensions;
/// in three a vector in the plane of the tangents.
template <int DIM>
constexpr int ALONG = DIM == 2 ? 1 : 3;
template <int DIM>
using Along = std::array<double, ALONG<DIM>>;
using Vector = std::array<double, 3>;

/// Indices of the numbers that are kept for a contact: elongation of the tangential spring, the
/// vector from j to i in the step before, the status, and the state of the law, if it has one. The
/// first are always kept, so that a restart may switch static friction or the onset on or off. Seen
/// from j, vectors change their sign, and nothing else.
template <int DIM>
struct Kept {
  static constexpr int XI = 0, VECTOR = ALONG<DIM>, STATUS = VECTOR + DIM, LAW_STATE = STATUS + 1;
};

/// With the onset located, pairs that nearly touch are kept as well, so that the vector before the
/// contact is known.
constexpr double STICKS = 0.0, SLIDES = 1.0, NEAR = -1.0;
constexpr double NEAR_REACH = 1.05;  ///< in sums of radii

/// Values shared by all contacts of a force evaluation.
struct Step {
  bool setup;       ///< setup of a run, for a step that was done: contacts stay as they are,
  double rounding;  ///< except those of discs that a command has moved by more than this
  double time;      ///< duration of the step
  bool located;     ///< whether the onset of a contact within the step is located
};

template <int DIM>
[[gnu::always_inline]] inline double square_of(const double *d) {
  double square = d[0] * d[0] + d[1] * d[1];
  if constexpr (DIM == 3) square += d[2] * d[2];
  return square;
}

/// Keeps the vector of a pair without contact as long as the pair is near.
template <int DIM>
inline void keep_near(bool near, const double *d, bool &touch, double *h) {
  using Is = Kept<DIM>;
  touch = near;
  for (int c = 0; c < ALONG<DIM>; c++) h[Is::XI + c] = 0.0;
  for (int c = 0; c < DIM; c++) h[Is::VECTOR + c] = near ? d[c] : 0.0;
  h[Is::STATUS] = near ? NEAR : STICKS;
}

template <class Law, int DIM>
[[gnu::always_inline]] inline void begin(const typename Law::Coefficients &c, double *h) {
  h[Kept<DIM>::STATUS] = STICKS;
  Law::begin(c, h + Kept<DIM>::LAW_STATE);
}

/// Displacement along the tangent in a step: the change of the pair vector since the step before,
/// not velocity times time step. Ghost velocities need not be communicated, and evaluating the
/// forces twice at the same positions (run after run, restart) changes nothing. The tangent is that
/// of the middle of the step, so that it is of second order.
inline double displacement(double delx, double dely, double before_x, double before_y) {
  const double mx = delx + before_x, my = dely + before_y;
  const double msq = mx * mx + my * my;
  const double minv = msq > 0.0 ? 1.0 / std::sqrt(msq) : 0.0;
  return (my * (before_x - delx) + mx * (dely - before_y)) * minv;
}

inline double dot(const Vector &a, const Vector &b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
inline Vector unit(const Vector &v) {
  const double square = dot(v, v), inverse = square > 0.0 ? 1.0 / std::sqrt(square) : 0.0;
  return {inverse * v[0], inverse * v[1], inverse * v[2]};
}
inline Vector middle(const double *d, const double *before) {
  return unit({d[0] + before[0], d[1] + before[1], d[2] + before[2]});
}

/// The same in three dimensions, in the plane across the normal of the middle of the step.
inline Vector displacement(const double *d, const double *before) {
  const Vector n = middle(d, before);
  Vector moved = {d[0] - before[0], d[1] - before[1], d[2] - before[2]};
  const double along = dot(moved, n);
  for (int c = 0; c < 3; c++) moved[c] -= along * n[c];
  return moved;
}

/// A vector across the unit vector `from`, turned with it to the unit vector `to` by the shortest
/// way, which keeps its length: particles do not rotate, so that a pair has no twist.
inline Vector turned(const Vector &v, const Vector &from, const Vector &to) {
  const double apart = 1.0 + dot(from, to);
  const double share = apart > 1e-9 ? dot(v, to) / apart : 0.0;
  Vector result = v;
  for (int c = 0; c < 3; c++) result[c] -= share * (from[c] + to[c]);
  return result;
}

/// Finds the tangential displacement `dxi` of a contact in this step and its duration, and starts
/// new contacts. Returns whether the discs have moved.
template <class Law, int DIM>
[[gnu::always_inline]] inline bool follow(const Step &step, const typename Law::Coefficients &c,
                                          const double *d, double r, double r0, bool &touch,
                                          double *h, FrictionContact &contact, Along<DIM> &dxi) {
  using Is = Kept<DIM>;
  const double *const before = h + Is::VECTOR;
  if (!touch) {
    touch = true;
    for (int n = 0; n < ALONG<DIM>; n++) h[Is::XI + n] = 0.0;
    begin<Law, DIM>(c, h);
    return !step.setup;
  }
  bool moved = !step.setup;
  if (step.setup)
    for (int n = 0; n < DIM; n++) moved = moved || std::fabs(d[n] - before[n]) > step.rounding;
  if constexpr (DIM == 2)
    dxi[0] = displacement(d[0], d[1], before[0], before[1]);
  else
    dxi = displacement(d, before);
  if constexpr (Law::needs_time) contact.time = step.time;
  if (h[Is::STATUS] != NEAR) return moved;
  const double share =
      step.located ? share_in_contact(std::sqrt(square_of<DIM>(before)), r, r0) : 0.0;
  for (double &one : dxi) one *= share;
  if constexpr (Law::needs_time) contact.time *= share;
  begin<Law, DIM>(c, h);
  return moved;
}

/// What one step did to a contact in three dimensions.
struct VectorStep {
  Vector xi;                ///< elongation of the tangential spring afterwards
  double slip, dissipated;  ///< see FrictionStep; the slip is along the force
  bool sliding;
};

/// The law acts on lengths: of the trial elongation, in whose direction friction acts, and of the
/// displacement. Spring and displacement are turned to the normal at the end of the step.
template <class Law>
[[gnu::always_inline]] inline VectorStep vector_step(const typename Law::Coefficients &c,
                                                     FrictionContact s, const double *d,
                                                     const Vector &dxi, double *h) {
  const double *const before = h + Kept<3>::VECTOR;
  const Vector now = unit({d[0], d[1], d[2]});
  const Vector xi = turned({h[0], h[1], h[2]}, unit({before[0], before[1], before[2]}), now);
  Vector trial = turned(dxi, middle(d, before), now);
  for (int n = 0; n < 3; n++) trial[n] += xi[n];
  const double length = std::sqrt(dot(trial, trial));
  s.dxi = std::sqrt(dot(dxi, dxi));
  s.xi = length - s.dxi;
  const double left = Law::elongation(c, s, h + Kept<3>::LAW_STATE);
  if (!s.sliding) return {trial, 0.0, 0.0, false};
  const double slip = length - left, inverse = length > 0.0 ? 1.0 / length : 0.0;
  const double work = 0.5 * c.kt * (dot(xi, trial) * inverse + left) * slip;
  for (double &one : trial) one *= left * inverse;
  return {trial, slip, work, true};
}

/// A contact that did not move is left unchanged.
template <class Law, int DIM>
[[gnu::always_inline]] inline auto next(bool moved, const typename Law::Coefficients &c,
                                        FrictionContact &contact, const double *d,
                                        const Along<DIM> &dxi, double *h) {
  using Is = Kept<DIM>;
  if constexpr (Law::needs_sliding) contact.sliding = h[Is::STATUS] == SLIDES;
  if constexpr (DIM == 3) {
    if (!moved) return VectorStep{{h[0], h[1], h[2]}, 0.0, 0.0, contact.sliding};
    return vector_step<Law>(c, contact, d, dxi, h);
  } else {
    contact.xi = h[Is::XI];
    contact.dxi = dxi[0];
    if (!moved) return FrictionStep{h[Is::XI], c.kt * h[Is::XI], 0.0, 0.0, contact.sliding};
    return friction_step<Law>(c, contact, h + Is::LAW_STATE);
  }
}

template <class Law, int DIM, class Done>
[[gnu::always_inline]] inline void keep(const Done &s, const double *d, double *h) {
  using Is = Kept<DIM>;
  if constexpr (DIM == 3)
    for (int c = 0; c < 3; c++) h[Is::XI + c] = s.xi[c];
  else
    h[Is::XI] = s.xi;
  for (int c = 0; c < DIM; c++) h[Is::VECTOR + c] = d[c];
  if constexpr (Law::needs_sliding) h[Is::STATUS] = s.sliding ? SLIDES : STICKS;
}

}  // namespace LSM::friction_contact

#endif
