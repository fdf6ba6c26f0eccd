// SPDX-License-Identifier: GPL-2.0-or-later
/// \file slider_laws.h
/// The friction laws of a block: those of lammps-pkg/core/laws under which a block at rest stays at
/// rest until its force exceeds a strength that is constant meanwhile. README.md explains why no
/// others.
#ifndef SLIDER_LAWS_H
#define SLIDER_LAWS_H

#include <array>

#include "laws/coulomb.h"
#include "laws/slip_weakening.h"
#include "laws/velocity_weakening.h"
#include "lsm_names.h"

namespace Slider {

enum class Law {
  velocity_weakening,  ///< Eq. 6
  coulomb,             ///< static and dynamic friction (ours)
  slip_weakening       ///< falls linearly with the slip since the block last rested (ours)
};
constexpr std::array<LSM::Named<Law>, 3> names_of(Law) {
  return {{{Law::velocity_weakening, LSM::VelocityWeakening::name},
           {Law::coulomb, LSM::CoulombStatic::name},
           {Law::slip_weakening, LSM::SlipWeakening::name}}};
}

/// A law with its coefficients. Each block has the static strength mu.
struct Friction {
  Law law = Law::velocity_weakening;
  double dynamic = 1.0;  ///< dynamic strength over the static one (not of Eq. 6)
  double dc = 1.0;       ///< slip over which it is reached, of slip_weakening

  /// Whether the place where a block last rested is needed.
  bool needs_rest() const { return law == Law::slip_weakening; }
};

}  // namespace Slider

#endif
