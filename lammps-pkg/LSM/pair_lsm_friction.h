// SPDX-License-Identifier: GPL-2.0-or-later
// Lattice Solid Model: repulsion and friction of unlinked particles,
// Eqs. (2) and (3), two dimensions; the laws of friction are in core/friction

#ifdef PAIR_CLASS
// clang-format off
PairStyle(lsm/friction,PairLSMFriction);
// clang-format on
#else

#ifndef LMP_PAIR_LSM_FRICTION_H
#define LMP_PAIR_LSM_FRICTION_H

#include "lsm_law_table.h"
#include "pair_lsm_free.h"

#include <vector>

namespace LAMMPS_NS {

class PairLSMFriction : public PairLSMFree {
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
  /// Starts the contacts in the list with a shear force of the upper particle on the lower one,
  /// given for each particle of this rank. To be called before forces are evaluated in a setup.
  void load_contacts(const double *shear);
  /// Writes the contacts of the last evaluation into the history. To be called before the history
  /// is read.
  void note_contacts() override;
  void note_added(int i, int jj) override;

 protected:
  void allocate() override;
  void parse_law(int narg, char **arg) override;
  void set_law(int i, int j) override { table.set(i, j); }
  void keep_law(LSMRestartFile &file, int i, int j) override { table.keep(file, i, j); }
  void print_law(FILE *fp, int i, int j) override { table.print(fp, i, j); }

 private:
  // The data of a pair that is kept, until other pairs are chosen. In LAMMPS' arrays they would be
  // scattered over a dozen cache lines. The histories of all pairs are copied from there and back.

  struct Site {
    int i, j;
    int types;      // index of the coefficients of their types
    int across;     // see across_fault()
    double r0;      // sum of the radii
    double size;    // effective size of the contact
  };
  std::vector<Site> sites;
  std::vector<double> histories;
  bigint sites_build = -1;    // number of the neighbor list build that the sites are from
  int kept_before = 0;        // the sites from this one on were collected in this step
  bool noted = true;          // the history is up to date with the sites

  LSMLawTable table;
  std::vector<std::string> common;    // coefficients after kt where pair_coeff has none
  const LSMLaw *running;              // first law of the name that fits all coefficients
  bool restored = false;              // law and coefficients come from a restart file
  int locate_onset = 1;               // 1 if the onset of a contact within a step is located
  double of_single[2] = {};           // target of svector: nothing to free if the constructor stops
  class FixDummy *fix_dummy = nullptr;
  class FixLSMHistory *fix_history = nullptr;

  template <class Law, class Recorder> class Loop;
  template <class Law, class Recorder> void run_loop();
  void choose(const LSMLaw *);
  void collect_sites(int first);
  int entry_of(int place) const;    // in the neighbor list
  void check_periods() const;
  int size_history() const;
  double near_reach() const;
};

}    // namespace LAMMPS_NS

#endif
#endif
