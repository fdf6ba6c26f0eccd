// SPDX-License-Identifier: GPL-2.0-or-later
/// \file friction/friction_contact.h
/// What is remembered of two discs that touch, or nearly touch, from one step to the next.
#ifndef LSM_FRICTION_CONTACT_H
#define LSM_FRICTION_CONTACT_H

#include <cmath>

#include "friction/force_laws.h"

namespace LSM::friction_contact {

/// Indices of the numbers that are kept for a contact: elongation of the tangential spring along
/// the tangent (-ny, nx), the vector from j to i in the step before, the status, and the state of
/// the law, if it has one. The first four are always kept, so that a restart may switch static
/// friction or the onset on or off. All but the vector, which changes its sign, are the same seen
/// from i and from j.
enum { XI, DX, DY, STATUS, LAW_STATE };
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

/// Keeps the vector of a pair without contact as long as the pair is near.
inline void keep_near(bool near, double delx, double dely, bool &touch, double *h) {
  touch = near;
  h[XI] = 0.0;
  h[DX] = near ? delx : 0.0;
  h[DY] = near ? dely : 0.0;
  h[STATUS] = near ? NEAR : STICKS;
}

template <class Law>
[[gnu::always_inline]] inline void begin(const typename Law::Coefficients &c, double *h) {
  h[STATUS] = STICKS;
  Law::begin(c, h + LAW_STATE);
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

/// Finds the tangential displacement of a contact in this step and its duration, and starts new
/// contacts. Returns whether the discs have moved.
template <class Law>
[[gnu::always_inline]] inline bool follow(const Step &step, const typename Law::Coefficients &c,
                                          double delx, double dely, double r, double r0,
                                          bool &touch, double *h, FrictionContact &contact) {
  if (!touch) {
    touch = true;
    h[XI] = 0.0;
    begin<Law>(c, h);
    return !step.setup;
  }
  bool moved = !step.setup;
  if (step.setup)
    moved = std::fabs(delx - h[DX]) > step.rounding || std::fabs(dely - h[DY]) > step.rounding;
  contact.dxi = displacement(delx, dely, h[DX], h[DY]);
  if constexpr (Law::needs_time) contact.time = step.time;
  if (h[STATUS] != NEAR) return moved;
  const double before = std::sqrt(h[DX] * h[DX] + h[DY] * h[DY]);
  const double share = step.located ? share_in_contact(before, r, r0) : 0.0;
  contact.dxi *= share;
  if constexpr (Law::needs_time) contact.time *= share;
  begin<Law>(c, h);
  return moved;
}

/// A contact that did not move is left unchanged.
template <class Law>
[[gnu::always_inline]] inline FrictionStep next(bool moved, const typename Law::Coefficients &c,
                                                FrictionContact &contact, double *h) {
  contact.xi = h[XI];
  if constexpr (Law::needs_sliding) contact.sliding = h[STATUS] == SLIDES;
  if (!moved) return {h[XI], c.kt * h[XI], 0.0, 0.0, contact.sliding};
  return friction_step<Law>(c, contact, h + LAW_STATE);
}

template <class Law>
[[gnu::always_inline]] inline void keep(const FrictionStep &s, double delx, double dely,
                                        double *h) {
  h[XI] = s.xi;
  h[DX] = delx;
  h[DY] = dely;
  if constexpr (Law::needs_sliding) h[STATUS] = s.sliding ? SLIDES : STICKS;
}

}  // namespace LSM::friction_contact

#endif
