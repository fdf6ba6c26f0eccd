// SPDX-License-Identifier: GPL-2.0-or-later
// Forces and energy of links in rows, Eq. (1), with the widest vectors of
// the machine and the same digits on each

#ifndef LMP_LSM_LINK_KERNEL_H
#define LMP_LSM_LINK_KERNEL_H

#include "friction/force_laws.h"
#include "lsm_link_rows.h"

#include <vector>

/// Compiles a function for AVX2. To be called only if has_avx2().
#if defined(__x86_64__) && defined(__GNUC__)
#define LSM_AVX2 __attribute__((target("avx2")))
#else
#define LSM_AVX2
#endif

namespace LAMMPS_NS {
namespace LSMLinkKernel {

  /// What dashpots read of a particle. In two dimensions velocity and position lie side by side:
  /// one access to memory instead of two. In three only velocities are kept, as the neighbors of a
  /// lattice follow on each other in any array.
  template <int DIM> struct Motion {
    static constexpr bool HAS_POSITION = DIM == 2;
    static constexpr int SIZE = DIM == 2 ? 4 : 3, POSITION = 2;    ///< velocities come first
  };

  // The laws of links, for the single loop over links, which handles several side by side. A Number
  // is a SIMD vector, see linear_spring.h.

  /// Linear spring.
  struct Elastic {
    static constexpr bool breaks = false, viscous = false;
    double stiffness;
    /// Attraction by the spring, which stores half of its product with the stretch.
    template <class Number> [[gnu::always_inline]] Number force(const Number &stretch) const
    {
      return LSM::Spring::force(stiffness, stretch);
    }
  };

  /// Linear spring that breaks beyond `ratio` times its rest length.
  struct Breakable : Elastic {
    static constexpr bool breaks = true;
    double ratio;
    template <class Number>
    [[gnu::always_inline]] auto is_broken(const Number &r, const Number &rest) const
    {
      return LSM::link_is_broken(r, rest, ratio);
    }
  };

  /// A dashpot parallel to the spring.
  template <class Spring> struct KelvinVoigt : Spring {
    static constexpr bool viscous = true;
    double viscosity;
    double *lost;            // the power dissipated by the dashpots is added
    const double *motion;    // the Motion of each particle
    /// Attraction by the dashpot.
    template <class Number> [[gnu::always_inline]] Number drag(const Number &rate) const
    {
      return LSM::Dashpot::force(viscosity, rate);
    }
  };

  using LSMLinkRows::Found;

  /// Windows of rows, from the first to the one before the last.
  struct Windows {
    int first, last;
  };

  /// Adds the forces of links to f and returns their elastic energy. Links that break give neither,
  /// and are added to `broken`.
  /// \param windows     those to work on
  /// \param first_only  no force on the partner: its owner adds it. Half of the energy is returned.
  /// Rows have to be mixed
  /// \param x           positions. With dashpots rows have to have the stride of Motion
  /// \param avx2        use these instructions, which the processor has to have; the same digits
  /// either way
  template <int DIM, class Law>
  double forces(const LSMLinkRows::Rows &, Windows, const Law &, bool first_only, const double *x,
                double *f, std::vector<Found> &broken, bool avx2);

  /// Whether the processor has AVX2.
  bool has_avx2();

}    // namespace LSMLinkKernel
}    // namespace LAMMPS_NS

#endif
