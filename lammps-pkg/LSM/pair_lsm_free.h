// SPDX-License-Identifier: GPL-2.0-or-later
// Lattice Solid Model: repulsion of unlinked particles, Eq. (2)

#ifdef PAIR_CLASS
// clang-format off
PairStyle(lsm/free,PairLSMFree);
// clang-format on
#else

#ifndef LMP_PAIR_LSM_FREE_H
#define LMP_PAIR_LSM_FREE_H

#include "lsm_energy.h"
#include "lsm_mover.h"
#include "lsm_near_pairs.h"
#include "pair.h"

namespace LAMMPS_NS {

class PairLSMFree : public Pair, public LSMEnergySource {
 public:
  PairLSMFree(class LAMMPS *);
  ~PairLSMFree() override;
  void compute(int, int) override;
  void settings(int, char **) override;
  void coeff(int, char **) override;
  void init_style() override;
  double init_one(int, int) override;
  void write_restart(FILE *) override;
  void read_restart(FILE *) override;
  void write_data(FILE *) override;
  void write_data_all(FILE *) override;
  double single(int, int, int, int, double, double, double, double &) override;
  void *extract(const char *, int &) override;

  /// Stiffness of the contacts of two types, 0 if they never touch.
  double stiffness(int itype, int jtype) const
  {
    return active[itype][jtype] ? k[itype][jtype] : 0.0;
  }

  /// Viscosity of these contacts: stiffness times retardation time.
  double viscosity(int itype, int jtype) const
  {
    return stiffness(itype, jtype) * delay[itype][jtype];
  }

  // virtual functions of Pair in LAMMPS 4Feb2025, which 4Jul2026 has no more: no 'override', and no warning of that

#if defined(__GNUC__)
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wsuggest-override"
#endif
#if defined(__clang__)
#pragma clang diagnostic ignored "-Winconsistent-missing-override"
#endif
  double atom2cut(int);
  double radii2cut(double, double);
#if defined(__GNUC__)
#pragma GCC diagnostic pop
#endif

 protected:
  double **k;        // contact stiffness
  double **delay;    // retardation time: viscosity over stiffness; 0 if there is none
  int **on;          // 1 if the pair of types interacts at all
  int **active;      // on, and not 'none' under hybrid, since the last init
  double *maxrad;    // largest radius of each type
  int newton_pair;
  LSMNearPairs near;
  LSMTravel travel;
  bool screened;    // lists hold pairs that must not interact
  int own_radii;    // index of the radii of the contacts, where fix lsm/traction has made them others, or -1

  class FixLSMVelocity *velocity;    // of this run, null if no contact is viscous in it

  const double *contact_radii() const;
  /// Returns whether other pairs are kept than before.
  bool find_near(double reach, const int *const *touch);
  /// Called before others are chosen, which may read what is known of those that are kept.
  virtual void note_contacts() {}
  /// Repulsion by the dashpot of a contact, along del from j to i of length r; the spring repels with `spring`. rate: of r.
  double dashpot(int i, int j, double delx, double dely, double delz, double r, double spring,
                 double &rate) const;
  bool any_delay() const;

  bool left_out(int entry, int itype, int jtype) const;
  void check_special() const;
  void warn_of_missing_links() const;
  virtual void allocate();
  virtual int request_flags() const;
  bool parse_off(int narg, char **arg, int ilo, int ihi, int jlo, int jhi);
  virtual void write_coeff(FILE *, int, int);
  virtual void read_coeff(FILE *, int, int);
  virtual void print_coeff(FILE *, int, int);
  void print_delay(FILE *, int, int);

 private:
  template <class Recorder> void loop();
  template <class Recorder, bool DIM3> void loop();
};

}    // namespace LAMMPS_NS

#endif
#endif
