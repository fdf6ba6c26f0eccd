// SPDX-License-Identifier: GPL-2.0-or-later
// Queries about the scene, by which the styles of the package refuse combinations that they cannot
// handle

#ifndef LMP_LSM_SCENE_H
#define LMP_LSM_SCENE_H

#include <array>
#include <functional>
#include <string>
#include <vector>

namespace LAMMPS_NS {
class Atom;
class Fix;
class Force;
class LAMMPS;
class Modify;
class PairLSMFree;
class Update;

namespace LSMScene {

  /// Pair styles of the package, each by itself under pair_style hybrid.
  std::vector<PairLSMFree *> contact_styles(Force *);

  /// Whether a fix belongs to the package.
  bool is_ours(const Fix *);

  /// Whether all fixes belong to the package, or to LAMMPS' contact histories.
  bool has_only_ours(Modify *);

  /// Whether a fix that is not of the package may rely on particles moving by less than half the
  /// skin between two builds of neighbor lists. Those that only act at the end of steps do not, but
  /// for one that adds to the cells of a grid.
  bool may_rely_on_skin(Modify *);

  /// Whether contact forces are computed several times in a step, by run_style respa.
  bool pairs_on_inner_level(const Update *);

  /// A spring between particles i and j along the unit vector n, with stiffness k along it and kt
  /// across it, and the viscosity of a dashpot along it. Unless `both`, another rank or image adds
  /// what j feels.
  struct Spring {
    int i, j;
    bool both;
    double k, kt, viscosity;
    std::array<double, 3> n;
  };

  /// Passes on links and contacts of this rank as springs about the present positions; also pairs
  /// that are about to touch.
  void for_each_spring(LAMMPS *, double reach_factor, const std::function<void(const Spring &)> &);

  /// Kinetic energy of this rank's particles that are in none of the groups.
  double kinetic(const Atom *, int group_bits);

  /// Force styles in use that are not of the package, as "bond harmonic, pair lj/cut"; empty if
  /// there is none.
  std::string foreign_forces(Force *);

  /// Whether a command of the input is being performed.
  bool is_command(const LAMMPS *, const char *name);
  /// Whether the command rerun evaluates snapshots.
  bool is_rerun(const LAMMPS *);

  /// Has the next run set up anew, also with 'pre no', unless a run begins or goes on right now. To
  /// be called where what belongs to a run is replaced: in each init, which other commands call,
  /// too (write_restart, pair_write, minimize, ...), most of which exchange particles; where
  /// coefficients change; where fixes come and go.
  void set_up_next_run(LAMMPS *);

  /// Stops unless the simulation is 2-dimensional and steps are those of velocity Verlet; `who`
  /// begins the message.
  void require_plane(LAMMPS *, const std::string &who);
  /// The same without a condition for the dimension.
  void require_verlet(LAMMPS *, const std::string &who);

  /// Stops where energy is not force times distance, or force over mass no acceleration (units
  /// real, metal and others); `who` begins the message.
  void require_plain_units(LAMMPS *, const std::string &who);

  /// Stops if a fix changes particle radii during a run; `who` begins the message.
  void refuse_changing_radii(LAMMPS *, const std::string &who);

  /// The retardation time in the last two words of a line of coefficients, 'kelvin-voigt TIME',
  /// which are removed, or 0; `who` begins the message.
  double take_retardation(LAMMPS *, const std::string &who, int &narg, char **arg);

}    // namespace LSMScene
}    // namespace LAMMPS_NS

#endif
