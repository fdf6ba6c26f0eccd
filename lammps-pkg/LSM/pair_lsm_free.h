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
#include "lsm_near_pairs.h"
#include "lsm_type_pairs.h"
#include "pair.h"

namespace LAMMPS_NS {
class LSMRestartFile;

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
  void write_restart_settings(FILE *) override;
  void read_restart_settings(FILE *) override;
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
  bool is_viscous() const;    ///< by its coefficients
  /// Contacts have the radii of particles again.
  void forget_radii() { own_radii = nullptr; }

 protected:
  LSMTypePairs<double> k;        // contact stiffness
  LSMTypePairs<double> delay;    // retardation time: viscosity over stiffness; 0 if there is none
  LSMTypePairs<int> on;          // 1 if the pair of types interacts at all
  LSMTypePairs<int> active;      // on, and not 'none' under hybrid, since the last init
  std::vector<double> maxrad;    // largest radius of each type
  int request_flags;             // for the request of the neighbor list
  int newton_pair = 0;
  LSMNearPairs near;
  bool screened = false;                         // the list holds pairs that must not interact
  const LSMContactRadii *own_radii = nullptr;    // a fix that gives contacts radii of their own

  class FixLSMVelocity *velocity = nullptr;    // null if no contact is viscous

  const double *contact_radii() const;
  /// Repulsion by the dashpot of a contact of length r, whose spring repels with `spring`. Sets
  /// `rate` to the rate of change of r.
  double dashpot(int i, int j, double r, double spring, double &rate) const;
  bool has_dashpots() const;
  bool is_for_table() const;

  void check_special() const;
  void find_largest_radii();
  void warn_of_missing_links() const;
  virtual void allocate();

  // coefficients of a friction law: the words of pair_coeff after the stiffness, and the values for
  // two types

  virtual void parse_law(int narg, char **arg);
  virtual void set_law(int, int) {}
  virtual void keep_law(LSMRestartFile &, int, int) {}
  virtual void print_law(FILE *, int, int) {}

 private:
  void coefficients_in(LSMRestartFile);
  void print_coeff(FILE *, int, int);
  template <class Recorder> void loop();
  template <class Recorder, int DIM> void loop();
};

}    // namespace LAMMPS_NS

#endif
#endif
