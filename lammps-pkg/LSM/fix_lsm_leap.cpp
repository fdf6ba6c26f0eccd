// SPDX-License-Identifier: GPL-2.0-or-later

#include "fix_lsm_leap.h"

#include "atom.h"
#include "comm.h"
#include "domain.h"
#include "error.h"
#include "files/text.h"
#include "fix_lsm_nve.h"
#include "fix_lsm_plates.h"
#include "force.h"
#include "group.h"
#include "lsm_energy.h"
#include "lsm_fixes.h"
#include "lsm_keyword_reader.h"
#include "lsm_scene.h"
#include "modify.h"
#include "pair_lsm_friction.h"
#include "update.h"

#include <cmath>

using namespace LAMMPS_NS;

FixLSMLeap::FixLSMLeap(LAMMPS *_lmp, int narg, char **arg) :
    LSMKeptFix(_lmp, narg, arg), dt(update->dt)
{
  has_output(nullptr, 6);

  if (narg < 4)
    error->all(FLERR, "Fix lsm/leap expects 'fix ID group lsm/leap plates-ID keyword value ...'");
  if (domain->dimension != 2)
    error->all(FLERR, "Fix lsm/leap needs dimension 2, found dimension {}", domain->dimension);
  plates_id = arg[3];
  LSMKeywordReader(lmp, "Fix lsm/leap", 4, narg, arg).read_all(keywords());
  reset_dt();
}

std::vector<LSM::Keyword> FixLSMLeap::keywords()
{
  using LSM::Must;
  return {{"fast", &fast, Must::positive},
          {"slip", &slip, Must::positive},
          {"calm", &calm, Must::not_negative},
          {"rest", &rest, Must::positive},
          {"viscosity", &viscosity, Must::not_negative},
          {"ramp", &ramp, Must::not_negative},
          {"grow", &grow, Must::not_negative},
          {"look", &between, Must::positive}};
}

FixLSMLeap::~FixLSMLeap()
{
  if (!update) return;    // LAMMPS ends
  // the other fixes may already be gone
  if (auto p = dynamic_cast<FixLSMPlates *>(modify->get_fix_by_id(plates_id))) p->loading = 1.0;
  for (auto *p : lsm_fixes<FixLSMNVE>(modify)) p->raise_viscosity(0.0);
  if (!force) return;
  for (auto *p : LSMScene::contact_styles(force)) {
    p->record_what &= ~LSMEnergySource::SLIP_RATE;
    if (auto *friction = dynamic_cast<PairLSMFriction *>(p)) friction->time_ratio = 1.0;
  }
}

void FixLSMLeap::init()
{
  plates = dynamic_cast<FixLSMPlates *>(modify->get_fix_by_id(plates_id));
  if (!plates)
    error->all(FLERR, Error::NOLASTLINE, "Fix lsm/leap {}: '{}' is not the ID of a fix lsm/plates",
               id, plates_id);
  if (plates->driving_velocity() == 0.0 && comm->me == 0)
    error->warning(FLERR,
                   "Fix lsm/leap {}: the plates of fix {} do not move, so there is nothing to leap "
                   "over: the blocks relax as without this fix",
                   id, plates_id);
  if (fabs(plates->driving_velocity()) > fast)
    error->all(
        FLERR, Error::NOLASTLINE,
        "Fix lsm/leap {}: fast is {}, but must be at least the driving velocity {} of fix {}", id,
        fast, fabs(plates->driving_velocity()), plates_id);
  if (leaps() && slip * fast < 2.0 * fabs(plates->driving_velocity()) && comm->me == 0)
    error->warning(FLERR,
                   "Fix lsm/leap {}: slip {} times fast {} is less than twice the driving "
                   "velocity {}: a fault that only follows its plates ends leaps, and events are "
                   "cut into pieces; use a larger fast, or no leaps",
                   id, slip, fast, fabs(plates->driving_velocity()));
  if (modify->get_fix_by_style("^lsm/leap").size() > 1)
    error->all(FLERR, Error::NOLASTLINE, "More than one fix lsm/leap");

  integrators = lsm_fixes<FixLSMNVE>(modify);
  if (integrators.empty())
    error->all(FLERR, Error::NOLASTLINE, "Fix lsm/leap {} needs a fix lsm/nve", id);

  contacts.clear();
  for (auto *p : LSMScene::contact_styles(force))
    if (auto *friction = dynamic_cast<PairLSMFriction *>(p)) {
      if (leaps()) friction->record_what |= LSMEnergySource::SLIP_RATE;
      contacts.push_back(friction);
    }
  if (contacts.empty())
    error->all(FLERR, Error::NOLASTLINE, "Fix lsm/leap {} needs a pair style lsm/friction", id);
  reset_dt();
}

void FixLSMLeap::reset_dt()
{
  if (begun && dt != update->dt)
    error->all(FLERR,
               "Fix lsm/leap {}: the time step changed from {} to {}, but must stay the same", id,
               dt, update->dt);
  dt = update->dt;
  nevery = MAX(1, static_cast<int>(std::lround(between / dt)));
}

void FixLSMLeap::setup(int /*vflag*/)
{
  begun = true;
  looked = update->ntimestep;
  for (auto *p : contacts) p->slip_moment = 0.0;

  // uniform shear between the plates: v grows from -fast to fast over the width
  loading_energy = 0.5 * group->mass(0) * fast * fast / 3.0;

  changes.push_back({update->ntimestep,
                     changes.empty() ? time_of_steps() : model_time(update->ntimestep),
                     factor * dt});
  if (!leaps()) state = EVENT;    // a restart may continue with another velocity
  set_factor(leaps() ? MIN(factor, fast / fabs(plates->driving_velocity())) : 1.0);
  plates->loading = factor;
  for (auto *p : contacts) p->time_ratio = factor;
  for (auto *p : integrators) p->raise_viscosity(state == SETTLE ? viscosity : 0.0);
}

bool FixLSMLeap::leaps() const
{
  const double velocity = fabs(plates->driving_velocity());
  return velocity > 0.0 && velocity < fast;
}

double FixLSMLeap::model_time(bigint step) const
{
  if (changes.empty()) return time_of_steps();
  auto last = changes.rbegin();
  while (last->step > step && std::next(last) != changes.rend()) ++last;
  return last->time + static_cast<double>(step - last->step) * last->rate;
}

std::string FixLSMLeap::settings()
{
  std::vector<std::string> words;
  for (const LSM::Keyword &one : keywords()) {
    words.emplace_back(one.name);
    words.push_back(LSM::text::number(*std::get<double *>(one.value)));
  }
  return utils::join_words(words, " ");
}

// the time of the steps, as if there were no leaps
double FixLSMLeap::time_of_steps() const
{
  return update->atime + static_cast<double>(update->ntimestep - update->atimestep) * dt;
}

void FixLSMLeap::set_factor(double value)
{
  if (value == factor) return;
  const bigint now = update->ntimestep;
  changes.push_back({now, model_time(now), value * dt});
  while (changes.size() > 2 && changes[1].step < now - kept) changes.pop_front();
  factor = plates->loading = value;
  for (auto *p : contacts) p->time_ratio = value;
}

// Without a faster velocity there is nothing to do. Otherwise the states follow each other:
// - event: the plates move at the driving velocity until nothing has slipped for a while
// - settle: viscosity is raised until the blocks are at rest
// - leap: the plates move fast until something slips
void FixLSMLeap::end_of_step()
{
  const double span = nevery * dt;
  if (!leaps()) {
    steps_time += span;
    return;
  }
  if (state == SETTLE) LSMMover::complete_steps(modify);
  // only the blocks count, as the motion of the plates is prescribed
  const double blocks = state == SETTLE ? LSMScene::kinetic(atom, plates->moved_bits()) : 0.0;
  double mine[2] = {0.0, blocks}, all[2];
  for (auto *p : contacts) {
    mine[0] += p->slip_moment;
    p->slip_moment = 0.0;
  }
  MPI_Allreduce(mine, all, 2, MPI_DOUBLE, MPI_SUM, world);
  // since the beginning of the run, if that was after the last check
  const double counted = static_cast<double>(update->ntimestep - looked) * dt;
  looked = update->ntimestep;
  const double slipping = all[0] / counted / (2.0 * fast * domain->prd[0]);
  const double most = fast / fabs(plates->driving_velocity());

  steps_time += span;
  if (state == LEAP) leap_time += span;
  since = slipping > slip ? 0.0 : since + span;

  const int before = state;
  if (since < calm) {
    if (state == LEAP) stops += 1.0;
    state = EVENT;
  } else if (state == EVENT || (state == SETTLE && all[1] > rest * loading_energy)) {
    state = SETTLE;
  } else {
    state = LEAP;
  }
  if (state != before)
    for (auto *p : integrators) p->raise_viscosity(state == SETTLE ? viscosity : 0.0);

  const double change = ramp > span ? (most - 1.0) * span / ramp : most;
  const double rise = grow > 0.0 ? MIN(change, factor * span / grow) : change;
  set_factor(state == LEAP ? MIN(most, factor + rise) : MAX(1.0, MIN(most, factor) - change));
}

// scalar = model time
// vector = factor of the driving velocity, state (0 event, 1 settle, 2 leap), time of the steps,
// part of it in leaps, model time beyond the time of the steps, leaps that ended
double FixLSMLeap::compute_scalar()
{
  return model_time(update->ntimestep);
}

double FixLSMLeap::compute_vector(int n)
{
  const double values[6] = {factor,
                            static_cast<double>(state),
                            steps_time,
                            leap_time,
                            model_time(update->ntimestep) - time_of_steps(),
                            stops};
  return values[n];
}

// earlier changes of the rate are kept, as events that are still open may have begun before them
template <class Self, class State> void FixLSMLeap::visit(Self &self, State &state)
{
  double now = self.model_time(self.update->ntimestep);
  state(now, self.state, self.factor, self.since, self.steps_time, self.leap_time, self.stops);
  state.list(self.changes);
}
