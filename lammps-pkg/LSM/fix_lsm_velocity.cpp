// SPDX-License-Identifier: GPL-2.0-or-later

#include "fix_lsm_velocity.h"

#include "atom.h"
#include "bond_lsm_linked.h"
#include "comm.h"
#include "domain.h"
#include "error.h"
#include "fix_lsm_nve.h"
#include "force.h"
#include "lsm_fixes.h"
#include "lsm_link_kernel.h"
#include "lsm_mover.h"
#include "lsm_scene.h"
#include "modify.h"
#include "neighbor.h"
#include "pair_lsm_free.h"
#include "update.h"

#include <algorithm>
#include <cstring>

using namespace LAMMPS_NS;
using namespace FixConst;

static constexpr const char *ID = "LSM_VELOCITY";

static int size(const Domain *domain)
{
  return domain->dimension == 3 ? LSMLinkKernel::Motion<3>::SIZE : LSMLinkKernel::Motion<2>::SIZE;
}

FixLSMVelocity::FixLSMVelocity(LAMMPS *_lmp, int narg, char **arg) : LSMKeptFix(_lmp, narg, arg)
{
  has_output(&work_dashpots);
  create_attribute = 1;
  take_velocities();
}

FixLSMVelocity *FixLSMVelocity::of(LAMMPS *lmp)
{
  Modify *const modify = lmp->modify;
  Fix *any = modify->get_fix_by_id(ID);
  // arguments of fix STORE/ATOM: numbers per particle, not sent with new ghosts, but kept in restart
  // files
  if (!any)
    any = modify->add_fix(fmt::format("{} all LSM_VELOCITY {} 0 0 1", ID, size(lmp->domain)));
  auto *const one = dynamic_cast<FixLSMVelocity *>(any);
  if (!one)
    lmp->error->all(FLERR, Error::NOLASTLINE,
                    "Fix {} must be of style LSM_VELOCITY, which the package creates itself", ID);
  return one;
}

FixLSMVelocity *FixLSMVelocity::in_use(LAMMPS *lmp)
{
  auto *const one = dynamic_cast<FixLSMVelocity *>(lmp->modify->get_fix_by_id(ID));
  return one && one->used ? one : nullptr;
}

double FixLSMVelocity::rate(int i, int j, double r) const
{
  double sum = 0.0;
  for (int c = 0; c < domain->dimension; c++)
    sum += (atom->x[i][c] - atom->x[j][c]) * (astore[i][c] - astore[j][c]);
  return sum / r;
}

int FixLSMVelocity::setmask()
{
  return POST_INTEGRATE | PRE_FORCE | POST_FORCE | POST_RUN;
}

void FixLSMVelocity::init()
{
  const auto contacts = LSMScene::contact_styles(force);
  const auto *const links = dynamic_cast<BondLSMLinked *>(force->bond_match("lsm/linked"));
  used = (links && links->is_viscous()) ||
      std::any_of(contacts.begin(), contacts.end(), [](const PairLSMFree *of) {
           return of->is_viscous();
         });
  if (!used || update->whichflag != 1) return;
  for (const auto &leap : modify->get_fix_by_style("^lsm/leap"))
    error->all(FLERR, Error::NOLASTLINE,
               "Links and contacts with kelvin-voigt do not work with fix {} of style lsm/leap, "
               "whose blocks move faster than in model time",
               leap->id);
  all_may_move = false;
  for (const auto &other : modify->get_fix_list())
    if (!LSMScene::is_ours(other) &&
        (modify->get_fix_mask(other) & (INITIAL_INTEGRATE | POST_INTEGRATE | PRE_FORCE)))
      all_may_move = true;
  extrapolated = 0;
  for (const auto *mover : lsm_fixes<LSMMover>(modify)) extrapolated |= mover->moved_bits();
  if (lsm_fixes<FixLSMNVE>(modify).empty() && !LSMScene::is_rerun(lmp))
    error->all(FLERR, Error::NOLASTLINE,
               "Links and contacts with kelvin-voigt need fix lsm/nve, which extrapolates "
               "velocities to the time of the forces");
}

// If the velocities are still those of the end of the previous run, or of the restart file, the
// forces are to be those of that end to the last bit. If a command has changed the velocities,
// forces follow from them as they are, and so they do in each snapshot of rerun.
void FixLSMVelocity::setup_pre_force(int /*vflag*/)
{
  if (!used) return;
  if (LSMScene::is_rerun(lmp) || fingerprint() != known) take_velocities();
  send(true);
}

// particles moved by other fixes keep these velocities, as there are no better ones
void FixLSMVelocity::post_integrate()
{
  running = true;
  if (!used) return;
  for (int i : others) set_arrays(i);
}

void FixLSMVelocity::take_velocities()
{
  for (int i = 0; i < atom->nlocal; i++) set_arrays(i);
}

void FixLSMVelocity::pre_force(int /*vflag*/)
{
  if (used) send(all_may_move || neighbor->ago == 0);
}

// Brings velocities to ghosts, and takes the positions of `all` particles, or of those that the
// fixes which moved them have not set.
void FixLSMVelocity::send(bool all)
{
  power = 0.0;
  comm->forward_comm_array(domain->dimension, astore);
  const int nlocal = atom->nlocal, end = nlocal + atom->nghost;
  for (int i = all ? 0 : nlocal; i < end; i++) take_position(i);
  if (!all) {
    for (int i : others) take_position(i);
    return;
  }
  others.clear();
  for (int i = 0; i < nlocal; i++)
    if (!(atom->mask[i] & extrapolated)) others.push_back(i);
}

// only where Motion has positions
void FixLSMVelocity::take_position(int i)
{
  using Motion = LSMLinkKernel::Motion<2>;
  if (domain->dimension == 2) std::copy_n(atom->x[i], 2, astore[i] + Motion::POSITION);
}

void FixLSMVelocity::set(int i, const double *velocity)
{
  std::copy_n(velocity, domain->dimension, astore[i]);
  take_position(i);
}

// work: trapezoidal rule over the step
void FixLSMVelocity::setup(int /*vflag*/)
{
  power_before = power;
}

void FixLSMVelocity::post_force(int /*vflag*/)
{
  if (!used) return;
  work_dashpots += 0.5 * update->dt * (power_before + power);
  power_before = power;
}

void FixLSMVelocity::post_run()
{
  running = false;
  if (!used) return;
  LSMMover::complete_steps(modify);
  known = fingerprint();
}

// hashes ID and velocity of each particle and sums over particles, so that their order does not
// matter
std::uint64_t FixLSMVelocity::fingerprint() const
{
  std::uint64_t mine = 0;
  for (int i = 0; i < atom->nlocal; i++) {
    std::uint64_t mixed = static_cast<std::uint64_t>(atom->tag[i]);
    for (int c = 0; c < 3; c++) {
      std::uint64_t bits;
      memcpy(&bits, &atom->v[i][c], sizeof(bits));
      mixed = (mixed ^ bits) * 0x9e3779b97f4a7c15ULL;
      mixed ^= mixed >> 29;
    }
    mine += mixed;
  }
  return lsm_total(mine, world);
}

// what is kept are the velocities, three numbers in two dimensions, too
int FixLSMVelocity::pack_restart(int i, double *buf)
{
  buf[0] = 4.0;
  buf[3] = 0.0;
  std::copy_n(astore[i], domain->dimension, buf + 1);
  return 4;
}

void FixLSMVelocity::unpack_restart(int i, int nth)
{
  const double *from = atom->extra[i];
  while (nth-- > 0) from += static_cast<int>(*from);
  std::copy_n(from + 1, domain->dimension, astore[i]);
}

void FixLSMVelocity::set_arrays(int i)
{
  std::copy_n(atom->v[i], domain->dimension, astore[i]);
}

// In a run velocities are complete when a restart file is written; between two runs, or pieces of
// one, commands may have changed them.
void FixLSMVelocity::write_restart(FILE *fp)
{
  if (running) known = fingerprint();
  LSMKeptFix::write_restart(fp);
}
