// SPDX-License-Identifier: GPL-2.0-or-later

#include "pair_lsm_friction.h"

#include "atom.h"
#include "comm.h"
#include "domain.h"
#include "error.h"
#include "fix_dummy.h"
#include "fix_lsm_history.h"
#include "fix_lsm_velocity.h"
#include "force.h"
#include "group.h"
#include "math_extra.h"
#include "memory.h"
#include "modify.h"
#include "neigh_list.h"
#include "neighbor.h"
#include "update.h"

#include "friction/friction_contact.h"
#include "friction/friction_laws.h"
#include "lsm_contact_recorder.h"
#include "lsm_friction_loop.h"
#include "lsm_keyword_reader.h"
#include "lsm_restart_file.h"
#include "lsm_scene.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <iterator>
#include <limits>

using namespace LAMMPS_NS;
using namespace LSM::friction_contact;

double PairLSMFriction::near_reach() const
{
  return locate_onset ? NEAR_REACH : 0.0;
}

int PairLSMFriction::size_history() const
{
  return law_state() + table.law->state_size;
}

// where the state of the law begins in the history of a contact
int PairLSMFriction::law_state() const
{
  return domain->dimension == 3 ? Kept<3>::LAW_STATE : Kept<2>::LAW_STATE;
}

PairLSMFriction::PairLSMFriction(LAMMPS *_lmp) :
    PairLSMFree(_lmp), table(_lmp), own(_lmp, table), running(table.law)
{
  centroidstressflag = CENTROID_NOTAVAIL;
  nondefault_history_transfer = 1;
  request_flags |= NeighConst::REQ_HISTORY;

  // a contact lost in the step in which the list is built keeps its history until its release is
  // counted
  beyond_contact = 1;
  single_extra = domain->dimension == 3 ? 5 : 2;
  svector = of_single;

  // a second one would take the contact history of the first
  if (modify->get_fix_by_id("NEIGH_HISTORY_LSM_DUMMY") ||
      modify->get_fix_by_id("NEIGH_HISTORY_LSM"))
    error->all(
        FLERR,
        "Pair style lsm/friction can be used once only, also under pair_style hybrid; give several "
        "pair_coeff commands to one");

  // placeholder so that the order of fixes is that of the input script
  fix_dummy = dynamic_cast<FixDummy *>(modify->add_fix("NEIGH_HISTORY_LSM_DUMMY all DUMMY"));
}

PairLSMFriction::~PairLSMFriction()
{
  modify->delete_fix(fix_history ? "NEIGH_HISTORY_LSM" : "NEIGH_HISTORY_LSM_DUMMY");
}

void PairLSMFriction::tally(const LSMContacts::Pair &pair, double energy, const Vector &force,
                            const Vector &del)
{
  ev_tally_xyz(pair.i, pair.j, atom->nlocal, newton_pair, energy, 0.0, force[0], force[1], force[2],
               del[0], del[1], del[2]);
}

// By how much positions in a box are rounded when particles cross its border.
static double rounding(const Domain *domain)
{
  double farthest = 0.0;
  for (int c = 0; c < domain->dimension; c++)
    farthest = MAX(farthest, MAX(fabs(domain->boxlo[c]), fabs(domain->boxhi[c])));
  return 16.0 * std::numeric_limits<double>::epsilon() * farthest;
}

template <class Law, class Recorder> void PairLSMFriction::run_loop()
{
  const Step step = {update->setupflag != 0, rounding(domain), update->dt * time_ratio,
                     locate_onset != 0};
  const LSMFriction::Scene scene = {near,
                                    *this,
                                    *this,
                                    atom->x[0],
                                    atom->f[0],
                                    atom->nlocal,
                                    newton_pair != 0,
                                    step,
                                    near_reach(),
                                    by_particle ? own.stiffness() : k,
                                    by_particle ? own.coefficients() : &table[0],
                                    by_particle ? own.retardation() : delay,
                                    has_dashpots() ? velocity->now(0) : nullptr,
                                    has_dashpots() ? &velocity->power : nullptr};
  if (domain->dimension == 3)
    LSMFriction::Loop<Law, Recorder, 3>(scene).run();
  else
    LSMFriction::Loop<Law, Recorder, 2>(scene).run();
}

void PairLSMFriction::compute(int eflag, int vflag)
{
  static constexpr void (PairLSMFriction::*loops[][3])() = {
#define LSM_FRICTION_LAW(law)                               \
  {&PairLSMFriction::run_loop<LSM::law, LSMRecordNothing>,  \
   &PairLSMFriction::run_loop<LSM::law, LSMRecordEnergies>, \
   &PairLSMFriction::run_loop<LSM::law, LSMRecordAndTally>},
#include "friction/friction_laws.h"
#undef LSM_FRICTION_LAW
  };
  ev_init(eflag, vflag);
  if (screened) check_special();
  near.update(*list, contact_radii(), fix_history);
  if (by_particle) own.follow(near, on, k, delay);
  constexpr int groups = 8 * sizeof(int);
  if (std::count(group->dynamic, group->dynamic + groups, 1)) near.find_sides();
  (this->*loops[running - &LSMLawTable::all()[0]][evflag ? 2 : record_what ? 1 : 0])();
}

void PairLSMFriction::load_contacts(const int *faces, const double *shear, const double *shear_z)
{
  if (by_particle) own.read();
  double **x = atom->x;
  const double *radius = contact_radii();
  const int dimension = domain->dimension;
  for (int ii = 0; ii < list->inum; ii++) {
    const int i = list->ilist[ii];
    for (int jj = 0; jj < list->numneigh[i]; jj++) {
      const int j = list->firstneigh[i][jj] & NEIGHMASK;
      double del[3];
      MathExtra::sub3(x[i], x[j], del);
      const double r0 = radius[i] + radius[j];
      const int itype = atom->type[i], jtype = atom->type[j];
      const int of_i = atom->mask[i], of_j = atom->mask[j];
      if (!((of_i & faces[0]) && (of_j & faces[1])) && !((of_i & faces[1]) && (of_j & faces[0])))
        continue;
      if (dimension == 2) del[2] = 0.0;
      const double rsq = MathExtra::lensq3(del);
      if (!active[itype][jtype] || rsq >= r0 * r0) continue;
      const std::vector<double> values = by_particle ? own.values(i, j)
                                                     : table.values(itype, jtype);
      double *const h = &fix_history->firstvalue[i][size_history() * jj];
      int &touch = fix_history->firstflag[i][jj];
      double &status = h[dimension == 3 ? Kept<3>::STATUS : Kept<2>::STATUS];
      if (!touch || status == NEAR) {
        touch = 1;
        std::fill_n(h, size_history(), 0.0);
        std::copy_n(del, dimension, h + (dimension == 3 ? Kept<3>::VECTOR : Kept<2>::VECTOR));
        status = STICKS;
        table.law->begin(values.data(), h + law_state());
      }
      if (dimension == 3) {
        const double up = del[1] > 0.0 ? 1.0 : -1.0;
        double more[] = {up * shear[i] / values[0], 0.0, up * shear_z[i] / values[0]};
        const double along = MathExtra::dot3(more, del) / rsq;
        for (int c = 0; c < 3; c++) h[c] += more[c] - along * del[c];
      } else
        h[Kept<2>::XI] -= shear[i] / values[0];
    }
  }
}

void PairLSMFriction::allocate()
{
  PairLSMFree::allocate();
  table.create();
}

// another law has other coefficients, and cannot continue with the contacts of the previous one
void PairLSMFriction::choose(const LSMLaw *wanted)
{
  if (wanted == table.law) return;
  if (fix_history || restored)
    error->all(FLERR,
               "Pair style lsm/friction has contacts of the law {}{}, and cannot go on with the "
               "law {}; give 'pair_style none' and 'run 0' first to forget them",
               table.law->name, restored ? " from a restart file" : "", wanted->name);
  table.law = running = wanted;
  if (!allocated) return;
  table.create();
  for (int i = 1; i <= atom->ntypes; i++)
    for (int j = i; j <= atom->ntypes; j++) setflag[i][j] = on[i][j] = 0;
}

void PairLSMFriction::settings(int narg, char **arg)
{
  const LSMLaw *wanted = &LSMLawTable::all()[0];
  int words = 0;
  while (words < narg && strcmp(arg[words], "onset") != 0) words++;
  if (words > 0) wanted = LSMLawTable::find(arg[0]);
  if (!wanted)
    error->all(FLERR, lsm_place(lmp, arg[0]),
               "Pair style lsm/friction expects [LAW [COEFFICIENTS]] [onset located|step] with one "
               "of the laws {}, got '{}'",
               LSMLawTable::names(), arg[0]);
  int at_end = 0;
  const LSM::Keywords keywords = {{"onset", LSM::Words{&at_end, {"located", "step"}}}};
  LSMKeywordReader(lmp, "Pair style lsm/friction", words, narg, arg).read_all(keywords);
  locate_onset = !at_end;
  choose(wanted);
  common.assign(arg + MIN(words, 1), arg + words);
  if (common.empty()) return;
  const bool value = utils::is_double(common[0]) || utils::strmatch(common[0], "^d_");
  if (value == table.law->named)
    error->all(FLERR, lsm_place(lmp, arg[1]),
               "Pair style lsm/friction {} expects {} or onset located|step, got '{}'",
               table.law->name, table.law->named ? "pairs NAME VALUE" : "numbers, d_PROPERTY",
               common[0]);
  char kt[] = "1.0", *only_kt[] = {kt};
  parse_law(1, only_kt);    // reports errors in the coefficients of pair_style right away
}

// parses kt and the coefficients of the law, which may be those of pair_style
void PairLSMFriction::parse_law(int narg, char **arg)
{
  std::vector<char *> words(arg, arg + MAX(narg, 0));
  if (narg == 1)
    for (std::string &word : common) words.push_back(word.data());
  table.parse(static_cast<int>(words.size()), words.data());
}

void PairLSMFriction::init_style()
{
  // forces at displaced positions would slide contacts
  if (!modify->get_fix_by_style("^numdiff").empty())
    error->all(
        FLERR, Error::NOLASTLINE,
        "Pair style lsm/friction does not work with fix numdiff, as friction depends on the path");

  running = table.law;    // see init_one()
  PairLSMFree::init_style();

  if (force->newton_pair && comm->style == Comm::TILED)
    error->all(FLERR, Error::NOLASTLINE,
               "Pair style lsm/friction with newton on does not work with comm_style tiled; use "
               "newton off");
  if (table.law->needs_time && LSMScene::pairs_on_inner_level(update))
    error->all(FLERR, Error::NOLASTLINE,
               "Pair style lsm/friction: law {} needs the time of a step; with run_style respa put "
               "pair on the outermost level",
               table.law->name);
  if (update->whichflag) check_periods();
  if (update->whichflag && locate_onset && neighbor->skin == 0.0 && comm->me == 0)
    error->warning(FLERR,
                   "Pair style lsm/friction: with 'neighbor 0.0' no pair is listed before it "
                   "touches, so 'onset located' acts as 'onset step'; give a skin > 0");

  // the same name whichever styles were defined before, so that a restart finds the history
  const std::string id_history = "NEIGH_HISTORY_LSM";
  if (!fix_history) {
    fix_history = dynamic_cast<FixLSMHistory *>(
        modify->replace_fix("NEIGH_HISTORY_LSM_DUMMY",
                            fmt::format("{} all LSM_HISTORY {} {}", id_history, size_history(),
                                        table.law->state_size ? table.law->name : ""),
                            1));
    fix_history->pair = this;
    fix_history->gather_states = [this] {
      return near.write_states(*fix_history);
    };
  } else {
    fix_history = dynamic_cast<FixLSMHistory *>(modify->get_fix_by_id(id_history));
    if (!fix_history)
      error->all(FLERR, Error::NOLASTLINE,
                 "Could not find the contact history of pair lsm/friction");
  }
  near.keep_states(size_history(), near_reach());
  by_particle = own.init(on);
  near.own_coefficients(by_particle);
}

// the history of a pair is found by the IDs of its particles
void PairLSMFriction::check_periods() const
{
  double reach = 0.0;
  for (int i = 1; i <= atom->ntypes; i++)
    for (int j = i; j <= atom->ntypes; j++)
      if (on[i][j]) reach = MAX(reach, maxrad[i] + maxrad[j] + neighbor->skin);
  for (int c = 0; c < domain->dimension; c++)
    if (domain->periodicity[c] && domain->prd[c] < 2.0 * reach)
      error->all(FLERR, Error::NOLASTLINE,
                 "Pair style lsm/friction: the period of the box in {} is {:.6g}, but must be at "
                 "least {:.6g} (twice the largest contact distance with the neighbor skin), as a "
                 "pair would meet itself on both sides",
                 std::string("xyz").substr(c, 1), domain->prd[c], 2.0 * reach);
}

double PairLSMFriction::init_one(int i, int j)
{
  const double cut = PairLSMFree::init_one(i, j);

  table.mirror(i, j);
  if (!on[i][j]) return cut;
  table.check(i, j);
  own.outdate();

  // takes the next law of this name that fits; within a run it does not go back
  while (!table.fits(*running, i, j)) {
    if (running == &LSMLawTable::all().back() || strcmp((++running)->name, table.law->name) != 0)
      error->all(FLERR, Error::NOLASTLINE,
                 "Pair lsm/friction: the law {} cannot be run with the coefficients of types {} {}",
                 table.law->name, i, j);
  }
  return cut;
}

// the history of a pair as seen from the other particle: vectors change their sign
void PairLSMFriction::transfer_history(double *source, double *target, int, int)
{
  const int from = domain->dimension == 3 ? 0 : Kept<2>::VECTOR;
  const int to = domain->dimension == 3 ? Kept<3>::STATUS : Kept<2>::STATUS;
  for (int n = 0; n < size_history(); n++) target[n] = n >= from && n < to ? -source[n] : source[n];
}

void PairLSMFriction::write_restart_settings(FILE *fp)
{
  PairLSMFree::write_restart_settings(fp);
  std::string name = table.law->name;
  LSMRestartFile(lmp, fp, false).list(name);
}

void PairLSMFriction::read_restart_settings(FILE *fp)
{
  PairLSMFree::read_restart_settings(fp);
  restored = true;
  std::string name;
  LSMRestartFile(lmp, fp, true).list(name);
  table.law = running = LSMLawTable::find(name);
  if (!running)
    error->all(
        FLERR,
        "Pair style lsm/friction: the restart file has contacts of the law {}, expected one of {}",
        name, LSMLawTable::names());
}

// normal force and energy of both springs; svector = elongation of the tangential spring and the
// tangential force on i along (-ny,nx); in three dimensions length of the elongation, force along
// it, and components of this force
double PairLSMFriction::single(int i, int j, int itype, int jtype, double rsq, double factor_coul,
                               double factor_lj, double &fforce)
{
  double energy = PairLSMFree::single(i, j, itype, jtype, rsq, factor_coul, factor_lj, fforce);
  std::fill_n(svector, single_extra, 0.0);
  // pair_write asks for types, with particles that need not be of these types or in the list
  const int *const type = atom->type;
  if (fforce == 0.0 || is_for_table() || !list || list->inum == 0 || type[i] != itype ||
      type[j] != jtype)
    return energy;
  const int place = near.place_of(i, j);
  if (place < 0 || !near.is_touching(place)) return energy;

  const double kt = table[0][MIN(itype, jtype)][MAX(itype, jtype)];
  const double *const h = near.state(place);
  svector[0] = single_extra > 2 ? MathExtra::len3(h) : h[Kept<2>::XI];
  svector[1] = -kt * svector[0];
  for (int n = 2; n < single_extra; n++) svector[n] = -kt * h[n - 2];
  return energy + LSM::Spring::energy(kt, svector[0]);
}

void *PairLSMFriction::extract(const char *str, int &dim)
{
  dim = 2;
  double **const found = table.find_coefficient(str);
  return found ? (void *) found : PairLSMFree::extract(str, dim);
}
