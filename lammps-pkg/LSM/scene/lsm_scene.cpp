// SPDX-License-Identifier: GPL-2.0-or-later

#include "lsm_scene.h"

#include "atom.h"
#include "bond_hybrid.h"
#include "bond_lsm_linked.h"
#include "domain.h"
#include "error.h"
#include "force.h"
#include "input.h"
#include "lsm_keyword_reader.h"
#include "math_extra.h"
#include "neigh_list.h"
#include "numerics/sum.h"
#include "pair_lsm_free.h"
#include "respa.h"
#include "update.h"

#include <algorithm>
#include <cmath>
#include <cstring>

namespace LAMMPS_NS {
namespace LSMScene {

  /// All sub-styles whose name matches; the pair style itself if it is no hybrid one.
  static std::vector<Pair *> sub_styles(Force *force, const std::string &pattern)
  {
    std::vector<Pair *> all;
    if (!force->pair) return all;
    for (int n = 1;; n++) {
      Pair *const one = force->pair_match(pattern, 0, n);
      if (!one || std::find(all.begin(), all.end(), one) != all.end()) return all;
      all.push_back(one);
    }
  }

  std::vector<PairLSMFree *> contact_styles(Force *force)
  {
    std::vector<PairLSMFree *> all;
    for (Pair *one : sub_styles(force, "^lsm/"))
      if (auto contacts = dynamic_cast<PairLSMFree *>(one)) all.push_back(contacts);
    return all;
  }

  bool is_ours(const Fix *fix)
  {
    return utils::strmatch(fix->style, "^lsm/") || utils::strmatch(fix->style, "^LSM_");
  }

  // neither of the package nor a contact history, such as that of lsm/friction
  static bool is_foreign(const Fix *fix)
  {
    return !is_ours(fix) && !utils::strmatch(fix->style, "^NEIGH_HISTORY");
  }

  bool has_only_ours(Modify *modify)
  {
    const auto &fixes = modify->get_fix_list();
    return std::none_of(fixes.begin(), fixes.end(), is_foreign);
  }

  bool may_rely_on_skin(Modify *modify)
  {
    const auto &fixes = modify->get_fix_list();
    return std::any_of(fixes.begin(), fixes.end(), [modify](Fix *fix) {
      return is_foreign(fix) &&
          ((modify->get_fix_mask(fix) & ~FixConst::END_OF_STEP) != 0 ||
           utils::strmatch(fix->style, "^ave/grid"));
    });
  }

  void for_each_spring(LAMMPS *lmp, double reach_factor,
                       const std::function<void(const Spring &)> &act)
  {
    Atom *const atom = lmp->atom;
    Force *const force = lmp->force;
    double **x = atom->x;

    auto add = [&](int i, int j, bool newton, double k, double kt, double viscosity) {
      Spring s{i,
               j,
               newton || j < atom->nlocal,
               k,
               kt,
               viscosity,
               {x[i][0] - x[j][0], x[i][1] - x[j][1], x[i][2] - x[j][2]}};
      const double r = sqrt(s.n[0] * s.n[0] + s.n[1] * s.n[1] + s.n[2] * s.n[2]);
      if (r == 0.0) return;
      for (double &c : s.n) c /= r;
      act(s);
    };

    if (auto links = dynamic_cast<BondLSMLinked *>(force->bond_match("lsm/linked")))
      links->for_each_current([&](const BondLSMLinked::CurrentLink &link) {
        add(link.i, link.j, force->newton_bond, link.stiffness, 0.0, link.viscosity);
      });
    for (PairLSMFree *contacts : contact_styles(force)) {
      if (!contacts->list) continue;
      int d = 0;
      const auto k = (double **) contacts->extract("k", d);
      const auto on = (int **) contacts->extract("on", d);
      const auto kt = (double **) contacts->extract("kt", d);
      const NeighList *list = contacts->list;
      for (int ii = 0; ii < list->inum; ii++) {
        const int i = list->ilist[ii];
        for (int jj = 0; jj < list->numneigh[i]; jj++) {
          const int j = list->firstneigh[i][jj] & NEIGHMASK;
          const double reach = reach_factor * (atom->radius[i] + atom->radius[j]);
          if (MathExtra::distsq3(x[i], x[j]) > reach * reach) continue;
          const int it = atom->type[i], jt = atom->type[j];
          if (on[it][jt])
            add(i, j, force->newton_pair, k[it][jt], kt ? kt[it][jt] : 0.0,
                contacts->viscosity(it, jt));
        }
      }
    }
  }

  double kinetic(const Atom *atom, int group_bits)
  {
    double **v = atom->v;
    LSM::NeumaierSum sum;
    for (int i = 0; i < atom->nlocal; i++) {
      if (atom->mask[i] & group_bits) continue;
      const double m = atom->rmass ? atom->rmass[i] : atom->mass[atom->type[i]];
      sum.add(m * (v[i][0] * v[i][0] + v[i][1] * v[i][1] + v[i][2] * v[i][2]));
    }
    return 0.5 * sum.value();
  }

  std::string foreign_forces(Force *force)
  {
    std::string names;
    auto add = [&](const std::string &kind, const std::string &style) {
      if (style == "zero" || style == "none" || utils::strmatch(style, "^lsm/")) return;
      names += (names.empty() ? "" : ", ") + kind + " " + style;
    };

    // a pattern that matches 'hybrid' would return the hybrid style instead of its parts
    for (const char *pattern : {"^[^h]", "^h[^y]"})
      for (Pair *one : sub_styles(force, pattern)) add("pair", force->pair_match_ptr(one));
    if (force->bond) {
      if (auto hybrid = dynamic_cast<BondHybrid *>(force->bond))
        for (int n = 0; n < hybrid->nstyles; n++) add("bond", hybrid->keywords[n]);
      else
        add("bond", force->bond_style);
    }
    if (force->angle) add("angle", force->angle_style);
    if (force->dihedral) add("dihedral", force->dihedral_style);
    if (force->improper) add("improper", force->improper_style);
    if (force->kspace) add("kspace", force->kspace_style);
    return names;
  }

  bool is_command(const LAMMPS *lmp, const char *name)
  {
    return lmp->input->command && strcmp(lmp->input->command, name) == 0;
  }

  bool is_rerun(const LAMMPS *lmp)
  {
    return lmp->update->whichflag == 1 && is_command(lmp, "rerun");
  }

  void set_up_next_run(LAMMPS *lmp)
  {
    if (lmp->update->whichflag != 1 || is_rerun(lmp)) lmp->update->first_update = 0;
  }

  void require_plane(LAMMPS *lmp, const std::string &who)
  {
    if (lmp->domain->dimension != 2)
      lmp->error->all(FLERR, Error::NOLASTLINE, "{} needs a 2-dimensional simulation (dimension 2)",
                      who);
    require_verlet(lmp, who);
  }

  void require_verlet(LAMMPS *lmp, const std::string &who)
  {
    if (utils::strmatch(lmp->update->integrate_style, "^respa"))
      lmp->error->all(FLERR, Error::NOLASTLINE, "{} does not work with run_style respa", who);
  }

  void require_plain_units(LAMMPS *lmp, const std::string &who)
  {
    if (lmp->force->ftm2v != 1.0 || lmp->force->mvv2e != 1.0)
      lmp->error->all(FLERR, Error::NOLASTLINE,
                      "{} does not work with units {}; use lj, si, cgs, micro or nano", who,
                      lmp->update->unit_style);
  }

  bool pairs_on_inner_level(const Update *update)
  {
    const auto respa = dynamic_cast<const Respa *>(update->integrate);
    return respa && respa->level_pair < respa->nlevels - 1;
  }

  void refuse_changing_radii(LAMMPS *lmp, const std::string &who)
  {
    for (const auto &fix : lmp->modify->get_fix_list())
      if (fix->diam_flag)
        lmp->error->all(
            FLERR, Error::NOLASTLINE,
            "{}: fix {} changes the diameters of particles during a run, but radii and masses are "
            "read at its beginning and when neighbor lists are built; change them between two runs",
            who, fix->id);
  }

  double take_retardation(LAMMPS *lmp, const std::string &who, int &narg, char **arg)
  {
    int at = 0;
    while (at < narg && strcmp(arg[at], "kelvin-voigt") != 0) at++;
    double time = 0.0;
    LSMKeywordReader(lmp, who, at, narg, arg)
        .read_all({{"kelvin-voigt", &time, LSM::Must::not_negative}});
    narg = at;
    return time;
  }

}    // namespace LSMScene
}    // namespace LAMMPS_NS
