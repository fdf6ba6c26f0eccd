/* ----------------------------------------------------------------------
   SPDX-License-Identifier: GPL-2.0-or-later
------------------------------------------------------------------------- */

#include "lsm_scene.h"

#include "bond_hybrid.h"
#include "error.h"
#include "fix.h"
#include "force.h"
#include "modify.h"
#include "pair_lsm_free.h"
#include "update.h"

#include <algorithm>

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

  std::string foreign_forces(Force *force)
  {
    std::string names;
    auto add = [&](const std::string &kind, const std::string &style) {
      if (style == "zero" || style == "none" || utils::strmatch(style, "^lsm/")) return;
      names += (names.empty() ? "" : ", ") + kind + " " + style;
    };

    // a pattern that matches hybrid would give the hybrid style and not its parts

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

  bool is_rerun(const Update *update)
  {
    return update->whichflag == 1 && (update->ntimestep != update->firststep ||
                                      update->laststep != update->firststep + update->nsteps);
  }

  void refuse_changing_radii(LAMMPS *lmp, const std::string &who)
  {
    for (const auto &fix : lmp->modify->get_fix_list())
      if (fix->diam_flag)
        lmp->error->all(
            FLERR,
            "{}: fix {} changes the diameters of particles during a run, but radii and masses are "
            "read at its begin and with the neighbor lists; change them between two runs",
            who, fix->id);
  }

}    // namespace LSMScene
}    // namespace LAMMPS_NS
