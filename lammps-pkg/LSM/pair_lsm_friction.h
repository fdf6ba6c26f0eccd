// SPDX-License-Identifier: GPL-2.0-or-later
// Lattice Solid Model: repulsion and friction of unlinked particles,
// Eqs. (2) and (3); the laws of friction are in core/friction

#ifdef PAIR_CLASS
// clang-format off
PairStyle(lsm/friction,PairLSMFriction);
// clang-format on
#else

#ifndef LMP_PAIR_LSM_FRICTION_H
#define LMP_PAIR_LSM_FRICTION_H

#include "lsm_contact_coefficients.h"
#include "lsm_friction_host.h"
#include "lsm_law_table.h"
#include "pair_lsm_free.h"

namespace LAMMPS_NS {

class PairLSMFriction : public PairLSMFree, private LSMFriction::Host {
 public:
  PairLSMFriction(class LAMMPS *);
  ~PairLSMFriction() override;
  void compute(int, int) override;
  void settings(int, char **) override;
  void init_style() override;
  double init_one(int, int) override;
  void write_restart_settings(FILE *) override;
  void read_restart_settings(FILE *) override;
  double single(int, int, int, int, double, double, double, double &) override;
  void *extract(const char *, int &) override;
  void transfer_history(double *, double *, int, int) override;
  double time_ratio =
      1.0;    ///< model time over time of the steps, for laws that depend on time: fix lsm/leap
  /// Adds to the contacts between two faces, given by bits of their groups, a shear force of the
  /// upper particle on the lower one, along x and in three dimensions along z, given for each
  /// particle of this rank; starts those that are not there yet. To be called before forces are
  /// evaluated in a setup.
  void load_contacts(const int *faces, const double *shear, const double *shear_z);

 protected:
  void allocate() override;
  void parse_law(int narg, char **arg) override;
  void set_law(int i, int j) override { table.set(i, j); }
  void keep_law(LSMRestartFile &file, int i, int j) override { table.keep(file, i, j); }
  void print_law(FILE *fp, int i, int j) override { table.print(fp, i, j); }

 private:
  LSMLawTable table;
  LSMContactCoefficients own;    // used where particles have coefficients
  bool by_particle = false;
  std::vector<std::string> common;    // coefficients after kt where pair_coeff has none
  const LSMLaw *running;              // first law of the name that fits all coefficients
  bool restored = false;              // law and coefficients come from a restart file
  int locate_onset = 1;               // 1 if the onset of a contact within a step is located
  double of_single[5] = {};           // target of svector: nothing to free if the constructor stops
  class FixDummy *fix_dummy = nullptr;
  class FixLSMHistory *fix_history = nullptr;

  void tally(const LSMContacts::Pair &, double energy, const LSM::friction_contact::Vector &force,
             const LSM::friction_contact::Vector &del) override;
  template <class Law, class Recorder> void run_loop();
  int law_state() const;
  void choose(const LSMLaw *);
  void check_periods() const;
  int size_history() const;
  double near_reach() const;
};

}    // namespace LAMMPS_NS

#endif
#endif
