// SPDX-License-Identifier: GPL-2.0-or-later

#include "fix_lsm_break.h"

#include "atom.h"
#include "bond_lsm_linked.h"
#include "error.h"
#include "force.h"
#include "lsm_ranks.h"
#include "lsm_scene.h"
#include "update.h"

#include <algorithm>
#include <tuple>
#include <vector>

using namespace LAMMPS_NS;

FixLSMBreak::FixLSMBreak(LAMMPS *_lmp, int narg, char **arg) : LSMKeptFix(_lmp, narg, arg)
{
  if (narg != 3) error->all(FLERR, "Fix LSM_BREAK is internal to bond style lsm/linked");
  has_output(nullptr);
  force_reneighbor = 1;
  next_reneighbor = -1;
}

void FixLSMBreak::init()
{
  links = dynamic_cast<BondLSMLinked *>(force->bond_match("lsm/linked"));
  if (!links) error->all(FLERR, Error::NOLASTLINE, "Fix LSM_BREAK needs bond style lsm/linked");
  if (force->special_lj[1] != 0.0 || force->special_lj[2] != 1.0 || force->special_lj[3] != 1.0)
    error->all(FLERR, Error::NOLASTLINE,
               "Breakable links need 'special_bonds lj 0 1 1', so that a pair is in contact "
               "only when its link is broken");
  if (LSMScene::is_rerun(lmp))
    error->all(FLERR, Error::NOLASTLINE,
               "Bond style lsm/linked does not work with rerun where links can break: it "
               "would depend on the "
               "snapshots before; give bond_coeff without a breaking ratio");
}

// A link that broke in this force evaluation is removed from the topology at once, before a restart
// file can be written. The pair cannot have touched before the next forces are evaluated, as the
// link is longer than its rest length.
void FixLSMBreak::pre_reverse(int /*eflag*/, int /*vflag*/)
{
  if (lsm_total(static_cast<int>(links->broken.size()), world) == 0) return;

  const std::vector<tagint> broken = lsm_gather(links->broken, world);
  links->broken.clear();
  remove(broken);
  next_reneighbor = update->ntimestep + 1;
}

// IDs of both ends and type of each link; two ranks may report the same link, so duplicates are
// removed
using Link = std::tuple<tagint, tagint, int>;

static std::vector<Link> each_once(const std::vector<tagint> &broken)
{
  std::vector<Link> links;
  for (size_t n = 0; n + 2 < broken.size(); n += 3) {
    const auto [low, high] = std::minmax(broken[n], broken[n + 1]);
    links.emplace_back(low, high, static_cast<int>(broken[n + 2]));
  }
  std::sort(links.begin(), links.end());
  links.erase(std::unique(links.begin(), links.end()), links.end());
  return links;
}

void FixLSMBreak::remove(const std::vector<tagint> &broken)
{
  const std::vector<Link> unique = each_once(broken);

  // with newton_bond on, only one of the two ranks has the link; the pair stays out of contact if
  // it has another link
  bigint removed = 0;
  std::vector<int> mine(unique.size(), 0), remaining(unique.size(), 0);
  auto for_each_end = [&](const auto &act) {
    for (size_t n = 0; n < unique.size(); n++)
      for (int side = 0; side < 2; side++) {
        const auto [low, high, type] = unique[n];
        const tagint other = side ? low : high;
        const int i = atom->map(side ? high : low);
        if (i >= 0 && i < atom->nlocal) act(n, i, other);
      }
  };
  for_each_end([&](size_t n, int i, tagint other) {
    for (int m = 0; m < atom->num_bond[i]; m++)
      if (atom->bond_atom[i][m] == other && atom->bond_type[i][m] == std::get<2>(unique[n])) {
        const int last = --atom->num_bond[i];
        atom->bond_atom[i][m] = atom->bond_atom[i][last];
        atom->bond_type[i][m] = atom->bond_type[i][last];
        removed++;
        break;
      }
    for (int m = 0; m < atom->num_bond[i]; m++)
      if (atom->bond_atom[i][m] == other) mine[n]++;
  });
  MPI_Allreduce(mine.data(), remaining.data(), static_cast<int>(mine.size()), MPI_INT, MPI_SUM,
                world);

  // 1-2 neighbours are the first nspecial[0]; what follows moves up
  for_each_end([&](size_t n, int i, tagint other) {
    if (remaining[n]) return;
    tagint *special = atom->special[i];
    int *nspecial = atom->nspecial[i];
    tagint *at = std::find(special, special + nspecial[0], other);
    if (at == special + nspecial[0]) return;
    std::copy(at + 1, special + nspecial[2], at);
    for (int kind = 0; kind < 3; kind++) nspecial[kind]--;
  });
  const bigint ends = lsm_total(removed, world);
  const bigint links_removed = force->newton_bond ? ends : ends / 2;
  atom->nbonds -= links_removed;
  total += links_removed;
}
