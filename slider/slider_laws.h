// SPDX-License-Identifier: GPL-2.0-or-later
/// \file slider_laws.h
/// The friction laws a block can have: those of lammps-pkg/core/laws under which a block at rest
/// stays at rest until its force exceeds a strength that does not change meanwhile. README.md says
/// why no other.
#ifndef SLIDER_LAWS_H
#define SLIDER_LAWS_H

#include <string>

#include "laws/coulomb.h"
#include "laws/slip_weakening.h"
#include "laws/velocity_weakening.h"

namespace Slider {

enum class Law {
  velocity_weakening,  ///< Eq. 6
  coulomb,             ///< static and dynamic friction (ours)
  slip_weakening       ///< falls linearly with the slip since the block last rested (ours)
};
constexpr Law all_laws[] = {Law::velocity_weakening, Law::coulomb, Law::slip_weakening};

inline const char *to_string(Law law) {
  switch (law) {
    case Law::velocity_weakening:
      return LSM::VelocityWeakening::name;
    case Law::coulomb:
      return LSM::CoulombStatic::name;
    case Law::slip_weakening:
      return LSM::SlipWeakening::name;
  }
  return "unknown";
}
inline bool from_string(const std::string &name, Law &law) {
  for (Law candidate : all_laws)
    if (name == to_string(candidate)) {
      law = candidate;
      return true;
    }
  return false;
}

/// A law with its coefficients. Each block has the static strength mu.
struct Friction {
  Law law = Law::velocity_weakening;
  double dynamic = 1.0;  ///< dynamic strength over the static one (not of Eq. 6)
  double dc = 1.0;       ///< slip over which it is reached, of slip_weakening

  /// Whether the place where a block last rested is needed.
  bool needs_rest() const { return law == Law::slip_weakening; }
  /// Friction of a block that moves, or starts to, after the given slip.
  double force(double mu, double v, double slip) const {
    switch (law) {
      case Law::velocity_weakening:
        return LSM::VelocityWeakening::friction(mu, v);
      case Law::coulomb:
        return LSM::CoulombStatic::friction(mu, dynamic * mu, true);
      case Law::slip_weakening:
        return LSM::SlipWeakening::strength(mu, dynamic * mu, dc, slip);
    }
    return mu;
  }
};

}  // namespace Slider

#endif
