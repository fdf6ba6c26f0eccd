// SPDX-License-Identifier: GPL-2.0-or-later

#include "fix_lsm_record.h"

#include "atom.h"
#include "comm.h"
#include "domain.h"
#include "error.h"
#include "files/state.h"
#include "fix_lsm_leap.h"
#include "lsm_mover.h"
#include "lsm_ranks.h"
#include "lsm_scene.h"
#include "memory.h"
#include "modify.h"
#include "output.h"
#include "update.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <exception>
#include <set>

using namespace LAMMPS_NS;

// quit ends the program without destroying styles
static std::set<FixLSMRecord *> living;

// the arguments are the ID of the compute and its keywords
FixLSMRecord::FixLSMRecord(LAMMPS *_lmp, int narg, char **arg) :
    LSMKeptFix(_lmp, narg, arg), options(_lmp, MIN(narg, 4), narg, arg), settings(options.events),
    sources(_lmp, settings), gather(world),
    guard(_lmp, sources, options.watchdog, options.emergency_file)
{
  if (narg < 4) error->all(FLERR, "Fix LSM_RECORD is internal to compute lsm/events");
  settings.name = arg[3];
  nevery = 1;
  [[maybe_unused]] static const int asked = std::atexit([] {
    for (auto *one : living)
      if (one->update->whichflag == 0) one->write_rest();    // not after an error within a run
  });
  living.insert(this);
  if (!settings.records_slip()) return;
  directions = domain->dimension == 3 ? 2 : 1;
  create_attribute = 1;    // new particles have not moved
  grow_arrays(atom->nmax);
  atom->add_callback(Atom::GROW);
}

FixLSMRecord::~FixLSMRecord()
{
  living.erase(this);
  write_rest();
  sources.release();
  if (!x_before) return;
  if (modify->get_fix_by_id(id)) atom->delete_callback(id, Atom::GROW);
  memory->destroy(x_before);
}

// a run notices changes made before it in its setup
void FixLSMRecord::reset_dt()
{
  update->whichflag ? change_dt() : LSMScene::set_up_next_run(lmp);
}

// rank 0 has received all complete intervals at the end of the last run
void FixLSMRecord::write_rest()
{
  on_rank_0([this] {
    stream->write_rest(options.unfinished);
  });
}

void FixLSMRecord::init()
{
  LSMScene::require_plain_units(lmp, "Compute lsm/events");
  sources.check(this, options.ledger);
  sources.find(options.ledger);
  if (settings.records_slip() && domain->triclinic)
    error->all(FLERR, Error::NOLASTLINE,
               "Compute lsm/events {}: the box is triclinic, but must not be for {}", settings.name,
               settings.asked_by());
  if (settings.records_slip() && LSMScene::pairs_on_inner_level(update))
    error->all(FLERR, Error::NOLASTLINE,
               "Compute lsm/events {}: {} need one force of contacts a step; with run_style respa "
               "put pair on the outermost level",
               settings.name, settings.asked_by());
  const bool leaps = sources.leap() != nullptr;
  if (leaps) sources.leap()->keep(2 * bigint(options.block) + 2);    // one is sent, one is filled
  if (leaps && !settings.history_file.empty())
    error->all(
        FLERR, Error::NOLASTLINE,
        "Compute lsm/events {}: history does not work with fix lsm/leap, as all intervals of a "
        "slip history have the same length; leave it out",
        settings.name);
  if (opened && leaps != settings.explicit_times)
    error->all(FLERR, Error::NOLASTLINE,
               "Compute lsm/events {}: fix lsm/leap {} since the files of this compute were "
               "opened; uncompute it first, and use other files",
               settings.name, leaps ? "was defined" : "is gone");
  settings.explicit_times = leaps;

  // these stay as in the first run, as the headers of the files state them
  if (settings.records_slip() && !opened && update->whichflag != 0) sources.find_driving(settings);
  set_memory();
  sampler.resize(options.block);
}

void FixLSMRecord::set_memory()
{
  if (options.memory_time <= 0.0) return;
  if (update->dt <= 0.0)
    error->all(FLERR, Error::NOLASTLINE, "Compute lsm/events memory needs a time step > 0");
  settings.picker.lambda = LSM::lambda_from_memory_time(options.memory_time, update->dt);
}

// Files are opened at the first run, so that a mistake earlier in the input touches no older
// catalogue.
void FixLSMRecord::open_files()
{
  const bool from_restart = !saved_state.empty();
  clock = {update->atime, update->atimestep, update->dt};
  for (auto &one : sources.variables()) settings.parameters.push_back(std::move(one));
  const std::string problem = lsm_on_0(world, [this] {
    stream = std::make_unique<LSM::EventStream>(settings);
  });
  if (!problem.empty()) error->all(FLERR, "Compute lsm/events: {}", problem);
  std::unique_ptr<LSM::SavedStream> saved;
  if (from_restart) saved = std::make_unique<LSM::SavedStream>(unpack_state(saved_state));
  if (settings.records_slip()) make_grid(saved.get());
  if (saved)
    on_rank_0([&] {
      stream->set_state(*saved);
    });
  change_dt();
  on_rank_0([this, from_restart] {
    stream->begin_files(update->ntimestep, from_restart, sources.scene(), clock, restart_files());
  });
  stop_on_failure();
  opened = true;
}

// Names that contain a step or a processor are left out: they cannot coincide with other outputs.
std::vector<LSM::Output> FixLSMRecord::restart_files() const
{
  std::vector<LSM::Output> files = {{"emergency", options.emergency_file}};
  if (output->restart_flag_double) {
    files.push_back({"restart", output->restart2a});
    files.push_back({"restart", output->restart2b});
  }
  return files;
}

// with another time step, interval or number of bins than in the restart file, if there is one, the
// slip of open events until now is lost
void FixLSMRecord::make_grid(const LSM::SavedStream *saved)
{
  const bigint step = update->ntimestep;
  const double time = time_of(step);
  const bool plane = domain->dimension == 3;
  const double bins = domain->prd[0] / settings.bin_width *
      (plane ? std::max(1.0, domain->prd[2] / settings.bin_width) : 1.0);
  constexpr auto most = LSM::SlipHistoryInfo::most_bins;
  if (bins > static_cast<double>(most))
    error->all(FLERR, Error::NOLASTLINE,
               "Compute lsm/events: bin {} makes {:.0f} bins of a box of length {}{}, expected at "
               "most {}",
               settings.bin_width, bins, domain->prd[0],
               plane ? fmt::format(" and depth {}", domain->prd[2]) : "", most);
  LSM::FaultGrid grid = settings.grid(domain->boxlo[0], domain->prd[0], step, time, update->dt);
  grid.ring = domain->xperiodic;
  if (plane) {
    grid = settings.plane(grid, domain->boxlo[2], domain->prd[2]);
    grid.ring_dip = domain->zperiodic;
  }
  const bool had_slip = saved && saved->has_slip();
  fault_begun = had_slip && saved->continues_with(grid, settings.finds_ruptures());
  if (had_slip && !fault_begun && comm->me == 0)
    error->warning(FLERR,
                   "Compute lsm/events {}: the restart file holds the slip of another time step, "
                   "interval or number of bins, or is without ruptures; the slip of open events "
                   "until now is lost",
                   settings.name);
  fault.begin(fault_begun ? saved->continued(grid) : grid, settings.forward);
  if (fault_begun && comm->me == 0) fault.sums() = saved->open_sums;
  on_rank_0([this] {
    stream->set_grid(fault.grid());
  });
}

// performs a task on rank 0 with the stream, if there is one; an error is kept for
// stop_on_failure()
template <class Task> void FixLSMRecord::on_rank_0(Task &&task)
{
  if (!stream || !failure.empty()) return;
  try {
    task();
  } catch (LSM::EventStreamError &e) {
    failure = e.what();
  } catch (std::exception &e) {
    failure = fmt::format("Compute lsm/events: {}", e.what());
  }
}

// stops all ranks with the error of rank 0, so that none waits for it forever
void FixLSMRecord::stop_on_failure()
{
  lsm_share(failure, world);
  if (failure.empty()) return;
  const std::string what = failure;
  failure.clear();
  error->all(FLERR, Error::NOLASTLINE, "{}", what);
}

// at the beginning of each run: the state at this step is the first sample, unless the previous run
// or the restart had it
void FixLSMRecord::setup(int /*vflag*/)
{
  guard.begin_run();
  if (!opened) open_files();
  if (fault_begun && last_recorded != update->ntimestep) refuse_gap();
  check_box();
  change_dt();
  leave_out_jump();
  if (settings.records_slip() && !fault_begun) begin_fault();
  if (settings.records_slip() && since < 0) begin_faces();
  if (options.ledger && !ledger.begun()) ledger.begin(energies());
  if (last_recorded != update->ntimestep) record();
}

// the box must not change along the fault: positions are relative to it, and headers hold its
// length
void FixLSMRecord::check_box()
{
  check_box_along(0);
  if (domain->dimension == 3 && settings.records_slip()) check_box_along(1);
}

// k: 0 along x, 1 along z
void FixLSMRecord::check_box_along(int k)
{
  const int d = 2 * k;
  const char name = "xz"[k];
  const bool placed = settings.records_slip();
  if (placed)
    for (const auto &ifix : modify->get_fix_list())
      if (ifix->box_change & (k ? Fix::BOX_CHANGE_Z : Fix::BOX_CHANGE_X))
        error->all(FLERR, Error::NOLASTLINE,
                   "Compute lsm/events {}: fix {} changes the box along {}, which {} cannot follow",
                   settings.name, ifix->id, name, settings.asked_by());
  if (period[k] == 0.0) {
    begin[k] = domain->boxlo[d];
    period[k] = domain->prd[d];
  }
  if (begin[k] == domain->boxlo[d] && period[k] == domain->prd[d]) return;
  for (const auto &[key, file] : LSM::files_of(settings))
    if (placed || !file.empty())
      error->all(
          FLERR, Error::NOLASTLINE,
          "Compute lsm/events {}: the box along {} was {} to {} when it began and is {} to {} "
          "now, which {} cannot follow; uncompute it first, and define another with other files",
          settings.name, name, begin[k], begin[k] + period[k], domain->boxlo[d], domain->boxhi[d],
          placed ? "the places of events" : "the header of file " + file);
}

// adapts times and the picker, whose rate is per step, to another time step; headers state only one
// time step, so it must not change once the files are open
void FixLSMRecord::change_dt()
{
  if (update->dt == clock.dt) return;
  for (const auto &[key, file] : LSM::files_of(settings))
    if (opened && !file.empty())
      error->all(
          FLERR, Error::NOLASTLINE,
          "Compute lsm/events {}: the time step changed from {} to {}, but the header of file {} "
          "has one time step; continue from a restart file with other files",
          settings.name, clock.dt, update->dt, file);
  flush();
  const double ratio = clock.dt > 0.0 ? update->dt / clock.dt : 0.0;
  clock = {time_of(update->ntimestep), update->ntimestep, update->dt};
  set_memory();
  if (settings.records_slip()) make_grid(nullptr);
  if (settings.records_slip() && opened) begin_fault();
  on_rank_0([this, ratio] {
    stream->change_picker(settings.picker, ratio);
  });
}

double FixLSMRecord::time_of(bigint step) const
{
  return sources.leap() ? sources.leap()->model_time(step) : clock.at(step);
}

void FixLSMRecord::refuse_gap() const
{
  error->all(FLERR, Error::NOLASTLINE,
             "Compute lsm/events {}: the step was {} and is {} now, but {} follow the steps one by "
             "one; uncompute it first, and use other files",
             settings.name, last_recorded, update->ntimestep, settings.asked_by());
}

// a run without a set-up may begin at another step
void FixLSMRecord::end_of_step()
{
  if (fault_begun && update->ntimestep != last_recorded + 1) refuse_gap();
  record();
}

// before particles move to other ranks
void FixLSMRecord::pre_exchange()
{
  stop_for(guard.check_links());
}

// stops the run if there is reason to, after what is recorded has been written
void FixLSMRecord::stop_for(const LSM::Watchdog::Alarm &alarm)
{
  if (alarm.what.empty()) return;
  flush();
  guard.stop_run(alarm);
}

void FixLSMRecord::record()
{
  const bigint step = update->ntimestep;
  double friction = 0.0;
  if (settings.records_slip() && step != fault.grid().step0) {
    for (const auto *style : sources.styles()) friction += fault.add(style->contacts);
    if (fault.grid().ends_interval(step)) {
      add_faces();
      sampler.add_interval(fault.sums());
      fault.clear();
    }
  }
  if (settings.finds_ruptures()) sampler.add_friction(friction);
  sampler.add(step, sources.pe());
  last_recorded = step;
  if (sampler.full()) start_gather();
  if (guard.due(step))
    stop_for(guard.check_step(ledger, [this] {
      return energies();
    }));
}

// sends the filled block to rank 0, which processes it when the next block is full
void FixLSMRecord::start_gather()
{
  finish_gather();
  if (!sampler.empty()) gather.start(sampler.hand_over());
}

void FixLSMRecord::finish_gather()
{
  if (!gather.finish()) return;
  on_rank_0([this] {
    stream->add_block(gather.block(), [this](bigint step) {
      return time_of(step);
    });
  });
  if (comm->me == 0)
    progress.show(update, screen, options.progress, gather.block().first + gather.block().count - 1,
                  stream->drops().events);
  stop_on_failure();
}

void FixLSMRecord::flush()
{
  start_gather();
  finish_gather();
  on_rank_0([this] {
    stream->flush();
  });
  stop_on_failure();
}

void FixLSMRecord::post_run()
{
  flush();
  if (settings.records_slip() && opened) {
    LSM::SlipRecorder until_now = fault;
    until_now.add(faces());
    const std::vector<double> open_sums = sum_on_0(until_now);
    on_rank_0([&] {
      stream->end_run(update->ntimestep, open_sums);
    });
  }
  LSMMover::complete_steps(modify);
  ledger.end_run(update->ntimestep, ledger.begun() ? energies() : LSM::EnergyTerms());
}

// returns on rank 0 the sums of the incomplete interval over all ranks
std::vector<double> FixLSMRecord::sum_on_0(LSM::SlipRecorder &slip) const
{
  std::vector<double> all(slip.sums().size());
  MPI_Reduce(slip.sums().data(), all.data(), static_cast<int>(all.size()), MPI_DOUBLE, MPI_SUM, 0,
             world);
  return all;
}

void FixLSMRecord::add_faces()
{
  if (since == update->ntimestep) return;
  fault.add(faces());
  begin_faces();
}

// records the state before the first interval, for which only forces are needed
void FixLSMRecord::begin_fault()
{
  fault_begun = true;
  begin_faces();
  fault.clear();
  for (const auto *style : sources.styles()) fault.add_forces(style->contacts);
  const std::vector<double> sums = sum_on_0(fault);
  fault.clear();
  const double pe = total_pe();
  on_rank_0([&] {
    stream->begin_fault(pe, sums);
  });
  stop_on_failure();
}

// Commands between two runs (displace_atoms, delete_atoms, velocity, other coefficients) may change
// energies. This is neither an event nor a loss, so the picker and the ledger continue from the new
// energies.
void FixLSMRecord::leave_out_jump()
{
  const bigint step = update->ntimestep;
  const double size = MAX(domain->prd[0], domain->prd[1]);
  const double floor =
      1e-22 * static_cast<double>(atom->natoms) * size * size;    // rounding of positions
  double change = 0.0;

  if (last_recorded == step) {
    flush();
    const double pe = total_pe();
    double jump = 0.0;
    if (stream && stream->picker().state().step == step) jump = pe - stream->picker().state().pe;
    MPI_Bcast(&jump, 1, MPI_DOUBLE, 0, world);
    if (LSM::is_jump(jump, fabs(pe), floor)) {
      change = jump;
      on_rank_0([&] {
        stream->leave_out_jump(jump);
      });
    }
  }
  const double jump = ledger.leave_out_jump(step, floor, [this] {
    return energies();
  });
  if (jump != 0.0) change = jump;
  if (change != 0.0 && comm->me == 0)
    error->warning(FLERR,
                   "Compute lsm/events {}: the energy changed by {:.6g} between two runs; events "
                   "and ledger leave it out",
                   settings.name, change);
}

LSM::Picked FixLSMRecord::picked()
{
  flush();
  LSM::Picked all;
  if (stream) all = stream->picked();
  MPI_Bcast(&all, sizeof(all) / sizeof(double), MPI_DOUBLE, 0, world);
  return all;
}

double FixLSMRecord::total_pe() const
{
  return lsm_total(sources.pe(), world);
}

LSM::EnergyTerms FixLSMRecord::energies() const
{
  return ledger.with_earlier_works(sources.energies());
}

// state in restart files: numbers of this class, then those of the stream
namespace {
struct Own {
  static constexpr size_t NUMBERS = 9;
  bigint last_recorded = 0;
  LSM::EnergyLedger ledger;
  LSM::StepClock clock;
  template <class Self, class State> static void visit(Self &self, State &state)
  {
    state(self.last_recorded, self.ledger, self.clock);
  }
};
}    // namespace

void FixLSMRecord::write_restart(FILE *fp)
{
  if (opened) pack_state();
  LSMKeptFix::write_restart(fp);
}

void FixLSMRecord::pack_state()
{
  flush();
  if (settings.records_slip()) add_faces();
  const std::vector<double> open_sums = settings.records_slip() ? sum_on_0(fault)
                                                                : std::vector<double>();
  saved_state.clear();
  const Own own = {last_recorded, ledger.for_restart(energies()), clock};
  LSM::StateWriter to(saved_state);
  Own::visit(own, to);
  if (comm->me == 0) {
    const std::vector<double> rest = stream->state(open_sums);
    saved_state.insert(saved_state.end(), rest.begin(), rest.end());
  }
}

// restores what this class keeps itself, and returns the rest
LSM::SavedStream FixLSMRecord::unpack_state(const std::vector<double> &state)
{
  Own own;
  LSM::SavedStream saved;
  if (state.size() >= Own::NUMBERS) {
    LSM::StateReader from(state);
    Own::visit(own, from);
  }
  if (!saved.read(state, Own::NUMBERS))
    error->all(FLERR, Error::NOLASTLINE,
               "Compute lsm/events {}: the restart file holds no state of such a compute",
               settings.name);
  last_recorded = own.last_recorded;
  ledger = own.ledger;
  clock = own.clock;
  return saved;
}

// stores the positions of this rank's particles, from which displacements are measured later
void FixLSMRecord::begin_faces()
{
  for (int i = 0; i < atom->nlocal; i++) FixLSMRecord::set_arrays(i);
  since = update->ntimestep;
}

// displacements of the faces since begin_faces()
std::vector<LSM::FaceDisplacement> FixLSMRecord::faces() const
{
  std::vector<LSM::FaceDisplacement> faces;
  const auto steps = static_cast<double>(update->ntimestep - since);
  if (steps <= 0.0) return faces;
  const auto moved = [this](int i, int direction) {
    const int d = 2 * direction;
    const double more = atom->x[i][d] - x_before[directions * i + direction];
    return domain->periodicity[d] ? more - domain->prd[d] * std::round(more / domain->prd[d])
                                  : more;
  };
  for (int i = 0; i < atom->nlocal; i++) {
    const bool above = atom->mask[i] & sources.face(1);
    if (!above && !(atom->mask[i] & sources.face(0))) continue;
    const double d = moved(i, 0), e = directions == 2 ? moved(i, 1) : 0.0;
    faces.push_back({atom->x[i][0] - 0.5 * d, d, steps, above, atom->x[i][2] - 0.5 * e, e});
  }
  return faces;
}

void FixLSMRecord::grow_arrays(int nmax)
{
  memory->grow(x_before, directions * nmax, "lsm/events:x_before");
}

void FixLSMRecord::copy_arrays(int i, int j, int)
{
  for (int n = 0; n < directions; n++) x_before[directions * j + n] = x_before[directions * i + n];
}

void FixLSMRecord::set_arrays(int i)
{
  for (int n = 0; n < directions; n++) x_before[directions * i + n] = atom->x[i][2 * n];
}

int FixLSMRecord::pack_exchange(int i, double *buf)
{
  for (int n = 0; n < directions; n++) buf[n] = x_before[directions * i + n];
  return directions;
}

int FixLSMRecord::unpack_exchange(int i, double *buf)
{
  for (int n = 0; n < directions; n++) x_before[directions * i + n] = buf[n];
  return directions;
}

double FixLSMRecord::memory_usage()
{
  return x_before ? static_cast<double>(atom->nmax) * directions * sizeof(double) : 0.0;
}
