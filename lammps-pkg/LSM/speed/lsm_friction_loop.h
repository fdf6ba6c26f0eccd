// SPDX-License-Identifier: GPL-2.0-or-later
// The loop over contacts with friction

#ifndef LMP_LSM_FRICTION_LOOP_H
#define LMP_LSM_FRICTION_LOOP_H

#include "friction/friction_law.h"
#include "lsm_contact_recorder.h"
#include "lsm_friction_host.h"
#include "lsm_link_kernel.h"
#include "lsm_type_pairs.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <type_traits>

namespace LAMMPS_NS {
namespace LSMFriction {
  /// What the loop reads and writes.
  struct Scene {
    LSMContacts &contacts;
    Host &host;
    LSMEnergySource &energies;
    const double *x;    ///< positions
    double *f;          ///< forces, to which those of contacts are added
    int nlocal;         ///< particles of this rank
    bool newton;        ///< a force on ghosts, too, which their ranks receive
    friction::Step step;
    double reach;                     ///< up to this distance, in sums of radii, pairs without
                                      ///< contact have a state
    const LSMTypePairs<double> &k;    ///< normal stiffness
    const LSMTypePairs<double> *coefficients;    ///< by parameter of the law
    const LSMTypePairs<double> &delay;           ///< retardation time of dashpots
    const double *motion;                        ///< for these, Motion; null if there are none
    double *power;                               ///< what they dissipate is added
  };

  /// The loop over the pairs that touch, compiled for each law, recorder and number of dimensions.
  /// The setup of a run evaluates the forces of a step that was done: the state of the contacts
  /// stays, so that a run in pieces equals one run, and a contact that slides goes on sliding. Only
  /// where a command moved particles since, by more than they are rounded when they cross a border
  /// of the box, their contacts follow.
  template <class Law, class Recorder, int DIM> class Loop {
   public:
    explicit Loop(const Scene &of) :
        scene(of), contacts(of.contacts), states(of.contacts.state(0)), x(of.x), f(of.f),
        nlocal(of.nlocal), reach_sq(of.reach * of.reach), step(of.step),
        side_by_side(DIM == 2 && Law::state_size == 0 && !Recorder::tallies && !step.setup),
        recorder(of.energies, step.setup)
    {
    }

    [[gnu::always_inline]] void run()
    {
      const int count = contacts.size();
      for (int first = 0; first < count; first += LANES) {
        if constexpr (DIM == 2)
          if (side_by_side) continue_all(first, count);
        for (int n = first; n < std::min(first + LANES, count); n++) {
          const int place = contacts[n], lane = n - first;
          const bool before = contacts.is_touching(place);
          double *const h = states + static_cast<size_t>(place) * size;
          if constexpr (DIM == 2)
            if (side_by_side && before && block.rsq[lane] < block.r0[lane] * block.r0[lane]) {
              const Site &site = contacts.pair(place);
              const bool both = is_both(site);
              const Push push = block.push(lane);
              if constexpr (Recorder::records) record(site, false, push, both);
              if (scene.motion) power += (both ? 1.0 : 0.5) * block.power[lane];
              friction::keep<Law, DIM>(push.step, contacts.vector(place), h);
              add_forces(site, push, both);
              continue;
            }
          if (!side_by_side && n + AHEAD < count) fetch_forces(contacts.pair(contacts[n + AHEAD]));
          bool touch = before;
          if (!before && place < contacts.kept_before()) {
            const double *const d = contacts.vector_before(place), r0 = contacts.pair(place).r0;
            friction::keep_near<DIM>(friction::square_of<DIM>(d) <= reach_sq * r0 * r0, d, touch,
                                     h);
          } else if (!before)
            touch = h[Is::STATUS] == friction::NEAR;
          evaluate(place, touch, h);
          const bool after = touch && h[Is::STATUS] != friction::NEAR;
          if (after != before) contacts.set_touching(place, after);
        }
      }
      recorder.finish();
      if (scene.motion) *scene.power += power;
    }

   private:
    using Site = LSMContacts::Pair;
    using Is = friction::Kept<DIM>;
    static constexpr int LANES = 32, AHEAD = 8, size = Is::LAW_STATE + Law::state_size;
    const Scene &scene;
    LSMContacts &contacts;
    double *const states;
    const double *const x;
    double *const f;
    const int nlocal;
    const double reach_sq;
    const friction::Step step;
    const bool side_by_side;
    Recorder recorder;
    double power = 0.0;    // this rank's share of what dashpots dissipate

    struct Geometry {
      double rsq, r, n[DIM];

      explicit Geometry(const double *d) : rsq(friction::square_of<DIM>(d)), r(sqrt(rsq))
      {
        const double rinv = r > 0.0 ? 1.0 / r : 0.0;
        for (int c = 0; c < DIM; c++) n[c] = d[c] * rinv;
      }
    };

    // Repulsion by the dashpot of a contact whose spring repels with `spring`, and its power. d is
    // the vector, u the velocity of the first particle against the second.
    [[gnu::always_inline]] static double drag(const Geometry &g, const double *d, const double *u,
                                              double viscosity, double spring, double &lost)
    {
      double rate = d[0] * u[0] + d[1] * u[1];
      if constexpr (DIM == 3) rate += d[2] * u[2];
      rate = g.r > 0.0 ? rate / g.r : 0.0;
      const double force = LSM::contact_dashpot_force(viscosity, rate, spring);
      lost = -force * rate;
      return force;
    }

    using Done = std::conditional_t<DIM == 3, friction::VectorStep, LSM::FrictionStep>;
    struct Push {
      double f[DIM];                // on the first particle
      double normal, tangential;    // energies of the springs
      Done step;
    };
    [[gnu::always_inline]] static Push push_of(const Geometry &g, double stretch, double k,
                                               double kt, double fn, const Done &s)
    {
      const double normal = LSM::Spring::energy(k, stretch);
      if constexpr (DIM == 3) {
        Push push = {{}, normal, 0.5 * kt * friction::dot(s.xi, s.xi), s};
        for (int c = 0; c < 3; c++) push.f[c] = fn * g.n[c] - kt * s.xi[c];
        return push;
      } else
        return {{fn * g.n[0] + s.force * g.n[1], fn * g.n[1] - s.force * g.n[0]},
                normal,
                LSM::Spring::energy(kt, s.xi),
                s};
    }

    // Most contacts were there in the step before: those that follow each other are computed side
    // by side, in a loop that compilers turn into vectors, and take their turn afterwards. It gives
    // the same digits with each instruction set.
    struct alignas(64) Block {
      double delx[LANES], dely[LANES], h[Is::LAW_STATE][LANES];
      double r0[LANES], k[LANES], coefficients[std::size(Law::parameters)][LANES];
      double rsq[LANES], fx[LANES], fy[LANES], normal[LANES], tangential[LANES];
      double slip[LANES], dissipated[LANES];
      double viscosity[LANES], u[DIM][LANES], power[LANES];    // velocity of i against j

      Push push(int n) const
      {
        const bool slides = Law::needs_sliding && h[Is::STATUS][n] == friction::SLIDES;
        const LSM::FrictionStep s = {h[Is::XI][n], 0.0, slip[n], dissipated[n], slides};
        return {{fx[n], fy[n]}, normal[n], tangential[n], s};
      }
      template <bool VISCOUS> [[gnu::always_inline]] void solve(double time)
      {
        for (int n = 0; n < LANES; n++) {
          const double del[] = {delx[n], dely[n]};
          const Geometry g(del);
          const auto c = LSM::coefficients_of<Law>([this, n](std::size_t p) {
            return coefficients[p][n];
          });
          double fn = LSM::contact_normal_force(k[n], g.r, r0[n]);
          if constexpr (VISCOUS) {
            const double between[] = {u[0][n], u[1][n]};
            fn += drag(g, del, between, viscosity[n], fn, power[n]);
          }
          const LSM::FrictionContact contact{
              fn, h[Is::XI][n],
              friction::displacement(delx[n], dely[n], h[Is::VECTOR][n], h[Is::VECTOR + 1][n]),
              time, Law::needs_sliding && h[Is::STATUS][n] == friction::SLIDES};
          const Push done =
              push_of(g, g.r - r0[n], k[n], c.kt, contact.fn, LSM::friction_step<Law>(c, contact));
          rsq[n] = g.rsq;
          fx[n] = done.f[0];
          fy[n] = done.f[1];
          h[Is::XI][n] = done.step.xi;
          if constexpr (Law::needs_sliding)
            h[Is::STATUS][n] = done.step.sliding ? friction::SLIDES : friction::STICKS;
          if constexpr (!Recorder::records) continue;
          normal[n] = done.normal;
          tangential[n] = done.tangential;
          slip[n] = done.step.slip;
          dissipated[n] = done.step.dissipated;
        }
      }
      template <bool VISCOUS> LSM_AVX2 void solve_avx2(double time) { solve<VISCOUS>(time); }
    };
    struct NoBlock {};
    std::conditional_t<DIM == 2, Block, NoBlock> block;

    // Prefetches the forces of a contact's particles, which are far from each other in memory.
    void fetch_forces(const Site &site) const
    {
      for (const int i : {site.i, site.j}) __builtin_prefetch(f + 3 * static_cast<size_t>(i), 1);
    }

    [[gnu::always_inline]] void continue_all(int first, int count)
    {
      for (int lane = 0; lane < LANES; lane++) {
        const int place = contacts[std::min(first + lane, count - 1)];
        const Site &site = contacts.pair(place);
        fetch_forces(site);
        const double *const d = contacts.vector(place);
        const double *const h = states + static_cast<size_t>(place) * size;
        block.delx[lane] = d[0];
        block.dely[lane] = d[1];
        for (int c = 0; c < Is::LAW_STATE; c++) block.h[c][lane] = h[c];
        block.r0[lane] = site.r0;
        block.k[lane] = scene.k.at(site.types);
        for (std::size_t p = 0; p < std::size(Law::parameters); p++)
          block.coefficients[p][lane] = scene.coefficients[p].at(site.types);
        if (scene.motion) {
          block.viscosity[lane] = viscosity_of(site);
          double u[DIM];
          velocity_between(site, u);
          for (int c = 0; c < DIM; c++) block.u[c][lane] = u[c];
        }
      }
      scene.motion ? solve<true>() : solve<false>();
    }
    template <bool VISCOUS> void solve()
    {
      if (LSMLinkKernel::has_avx2())
        block.template solve_avx2<VISCOUS>(step.time);
      else
        block.template solve<VISCOUS>(step.time);
    }

    bool is_both(const Site &site) const { return scene.newton || site.j < nlocal; }

    double viscosity_of(const Site &site) const
    {
      return scene.k.at(site.types) * scene.delay.at(site.types);
    }
    void velocity_between(const Site &site, double (&u)[DIM]) const
    {
      constexpr std::size_t stride = LSMLinkKernel::Motion<DIM>::SIZE;
      for (int c = 0; c < DIM; c++)
        u[c] = scene.motion[stride * site.i + c] - scene.motion[stride * site.j + c];
    }

    [[gnu::always_inline]] double normal_force(const Site &site, const double *d, const Geometry &g,
                                               bool apart, bool both)
    {
      const double fn = LSM::contact_normal_force(scene.k.at(site.types), g.r, site.r0);
      if (!scene.motion || apart) return fn;
      double u[DIM], lost;
      velocity_between(site, u);
      const double more = drag(g, d, u, viscosity_of(site), fn, lost);
      power += (both ? 1.0 : 0.5) * lost;
      return fn + more;
    }

    [[gnu::always_inline]] void evaluate(int place, bool &touch, double *h)
    {
      const Site &site = contacts.pair(place);
      const double r0 = site.r0;
      const double *const d = contacts.vector(place);
      const Geometry g(d);
      const bool apart = g.rsq >= r0 * r0;
      if (apart && !touch && g.rsq > reach_sq * r0 * r0) return;
      if (apart && (!touch || h[Is::STATUS] == friction::NEAR)) {
        friction::keep_near<DIM>(g.rsq <= reach_sq * r0 * r0, d, touch, h);
        return;
      }
      const auto c = LSM::coefficients_of<Law>([this, &site](std::size_t p) {
        return scene.coefficients[p].at(site.types);
      });

      LSM::FrictionContact contact{0.0, 0.0, 0.0, 0.0, false};
      friction::Along<DIM> dxi{};
      const bool moved = friction::follow<Law, DIM>(step, c, d, g.r, r0, touch, h, contact, dxi);
      const bool both = is_both(site);
      contact.fn = normal_force(site, d, g, apart, both);
      const Push push = push_of(g, apart ? 0.0 : g.r - r0, scene.k.at(site.types), c.kt, contact.fn,
                                friction::next<Law, DIM>(moved || apart, c, contact, d, dxi, h));
      if constexpr (Recorder::records) record(site, apart, push, both);
      if (apart) {
        friction::keep_near<DIM>(g.rsq <= reach_sq * r0 * r0, d, touch, h);
        return;
      }
      friction::keep<Law, DIM>(push.step, d, h);
      add_forces(site, push, both);
      if constexpr (Recorder::tallies) {
        friction::Vector force{}, del{};
        std::copy_n(push.f, DIM, force.begin());
        std::copy_n(d, DIM, del.begin());
        scene.host.tally(site, push.normal + push.tangential, force, del);
      }
    }

    [[gnu::always_inline]] void add_forces(const Site &site, const Push &push, bool both)
    {
      double *const fi = f + 3 * static_cast<size_t>(site.i);
      double *const fj = f + 3 * static_cast<size_t>(site.j);
      for (int c = 0; c < DIM; c++) fi[c] += push.f[c];
      if (!both) return;
      for (int c = 0; c < DIM; c++) fj[c] -= push.f[c];
    }

    [[gnu::always_inline]] void record(const Site &site, bool apart, const Push &push, bool both)
    {
      const double share = both ? 1.0 : 0.5;
      const Done &s = push.step;
      recorder.springs(share, push.normal, push.tangential);
      recorder.dissipation(share, s.dissipated);
      recorder.slip(share, fabs(s.slip) * site.size);
      if (!recorder.wants_contacts()) return;
      if (site.across == 0) {
        recorder.within(share, s.dissipated);
        return;
      }
      const double *const xi = x + 3 * static_cast<size_t>(site.i);
      const double *const xj = x + 3 * static_cast<size_t>(site.j);
      const auto on_lower = [&](int c) {
        return -site.across * (apart ? 0.0 : push.f[c]);
      };
      LSM::FaultContact one = {0.5 * (xi[0] + xj[0]), s.dissipated, on_lower(0), share};
      if constexpr (DIM == 3) {
        one.z = 0.5 * (xi[2] + xj[2]);
        one.force_z = on_lower(2);
      }
      recorder.contact(one);
    }
  };

}    // namespace LSMFriction
}    // namespace LAMMPS_NS

#endif
