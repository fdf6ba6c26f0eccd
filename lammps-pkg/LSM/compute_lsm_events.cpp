// SPDX-License-Identifier: GPL-2.0-or-later

#include "compute_lsm_events.h"

#include "atom.h"
#include "comm.h"
#include "domain.h"
#include "error.h"
#include "files/state.h"
#include "fix_lsm_leap.h"
#include "fix_lsm_record.h"
#include "lsm_keyword_reader.h"
#include "lsm_mover.h"
#include "lsm_ranks.h"
#include "lsm_scene.h"
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
static std::set<ComputeLSMEvents *> living;

// entries of the global vector, followed by those of the ledger
enum { EVENTS, LAST_SIZE, RATE, IN_EVENT, PE, PE_LINK, PE_CONTACT, PE_TANGENTIAL, NVECTOR };
static constexpr int NLEDGER = 9;
// if ruptures are recorded, these follow, whether there is a ledger or not
enum { RUPTURES, LAST_WORK, OPEN, NRUPTURES };

ComputeLSMEvents::ComputeLSMEvents(LAMMPS *_lmp, int narg, char **arg) :
    Compute(_lmp, narg, arg), options(_lmp, 3, narg, arg), settings(options.events),
    sources(_lmp, settings), gather(world),
    guard(_lmp, sources, options.watchdog, options.emergency_file, [this] {
      flush();
    })
{
  if (igroup) error->all(FLERR, lsm_place(lmp, arg[1]), "Compute lsm/events must use group all");
  scalar_flag = 1;
  vector_flag = 1;
  extscalar = 0;
  extvector = 0;
  size_vector = NVECTOR + (options.ledger || settings.finds_ruptures() ? NLEDGER : 0) +
      (settings.finds_ruptures() ? NRUPTURES : 0);
  settings.name = id;

  if (modify->get_fix_by_id(id_of_fix()))
    error->all(FLERR, "Compute lsm/events {} needs the fix ID {}, which is in use", id,
               id_of_fix());
  recorder = dynamic_cast<FixLSMRecord *>(modify->add_fix(
      id_of_fix() + (settings.records_slip() ? " all LSM_RECORD faces" : " all LSM_RECORD")));
  recorder->owner = this;
  [[maybe_unused]] static const int asked = std::atexit([] {
    for (auto *one : living)
      if (one->update->whichflag == 0) one->write_rest();    // not after an error within a run
  });
  living.insert(this);
  vector = new double[size_vector];    // allocated last, as the destructor does not run if the
                                       // constructor throws
}

ComputeLSMEvents::~ComputeLSMEvents()
{
  living.erase(this);
  write_rest();
  sources.release();
  if (recorder && modify && modify->get_fix_by_id(id_of_fix())) modify->delete_fix(id_of_fix());
  delete[] vector;
}

// rank 0 has received all complete intervals at the end of the last run
void ComputeLSMEvents::write_rest()
{
  on_rank_0([this] {
    stream->write_rest(options.unfinished);
  });
}

void ComputeLSMEvents::init()
{
  if (modify->get_compute_by_style("lsm/events").size() > 1 && comm->me == 0)
    error->warning(FLERR, "More than one compute lsm/events");

  if (modify->get_fix_by_id(id_of_fix()) != recorder)
    error->all(FLERR, Error::NOLASTLINE,
               "Compute lsm/events {}: its fix {} is gone; use uncompute to end recording", id,
               id_of_fix());
  LSMScene::require_plain_units(lmp, "Compute lsm/events");
  sources.check(recorder, options.ledger);
  sources.find(options.ledger);
  if (settings.records_slip() && domain->triclinic)
    error->all(FLERR, Error::NOLASTLINE,
               "Compute lsm/events {}: the box is triclinic, but must not be for {}", id,
               settings.asked_by());
  if (settings.records_slip() && LSMScene::pairs_on_inner_level(update))
    error->all(FLERR, Error::NOLASTLINE,
               "Compute lsm/events {}: {} need one force of contacts a step; with run_style respa "
               "put pair on the outermost level",
               id, settings.asked_by());
  const bool leaps = sources.leap() != nullptr;
  if (leaps) sources.leap()->keep(2 * bigint(options.block) + 2);    // one is sent, one is filled
  if (leaps && !settings.history_file.empty())
    error->all(
        FLERR, Error::NOLASTLINE,
        "Compute lsm/events {}: history does not work with fix lsm/leap, as all intervals of a "
        "slip history have the same length; leave it out",
        id);
  if (opened && leaps != settings.explicit_times)
    error->all(FLERR, Error::NOLASTLINE,
               "Compute lsm/events {}: fix lsm/leap {} since the files of this compute were "
               "opened; uncompute it first, and use other files",
               id, leaps ? "was defined" : "is gone");
  settings.explicit_times = leaps;

  // these stay as in the first run, as the headers of the files state them
  if (settings.records_slip() && !opened && update->whichflag != 0) sources.find_driving(settings);
  set_memory();
  sampler.resize(options.block);
}

void ComputeLSMEvents::set_memory()
{
  if (options.memory_time <= 0.0) return;
  if (update->dt <= 0.0)
    error->all(FLERR, Error::NOLASTLINE, "Compute lsm/events memory needs a time step > 0");
  settings.picker.lambda = LSM::lambda_from_memory_time(options.memory_time, update->dt);
}

// Files are opened at the first run, so that a mistake earlier in the input touches no older
// catalogue.
void ComputeLSMEvents::open_files()
{
  const bool from_restart = !recorder->saved_state.empty();
  clock = {update->atime, update->atimestep, update->dt};
  for (auto &one : sources.variables()) settings.parameters.push_back(std::move(one));
  const std::string problem = lsm_on_0(world, [this] {
    stream = std::make_unique<LSM::EventStream>(settings);
  });
  if (!problem.empty()) error->all(FLERR, "Compute lsm/events: {}", problem);
  std::unique_ptr<LSM::SavedStream> saved;
  if (from_restart) saved = std::make_unique<LSM::SavedStream>(unpack_state(recorder->saved_state));
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
std::vector<LSM::Output> ComputeLSMEvents::restart_files() const
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
void ComputeLSMEvents::make_grid(const LSM::SavedStream *saved)
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
                   id);
  fault.begin(fault_begun ? saved->continued(grid) : grid, settings.forward);
  if (fault_begun && comm->me == 0) fault.sums() = saved->open_sums;
  on_rank_0([this] {
    stream->set_grid(fault.grid());
  });
}

// performs a task on rank 0 with the stream, if there is one; an error is kept for
// stop_on_failure()
template <class Task> void ComputeLSMEvents::on_rank_0(Task &&task)
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
void ComputeLSMEvents::stop_on_failure()
{
  lsm_share(failure, world);
  if (failure.empty()) return;
  const std::string what = failure;
  failure.clear();
  error->all(FLERR, Error::NOLASTLINE, "{}", what);
}

// called at the beginning of each run: the state at this step is the first sample, unless the
// previous run or the restart had it
void ComputeLSMEvents::setup_record()
{
  guard.begin_run();
  if (!opened) open_files();
  if (fault_begun && last_recorded != update->ntimestep) refuse_gap();
  check_box();
  change_dt();
  leave_out_jump();
  if (settings.records_slip() && !fault_begun) begin_fault();
  if (settings.records_slip() && recorder->faces_since() < 0) recorder->begin_faces();
  if (options.ledger && !ledger.begun()) ledger.begin(energies());
  if (last_recorded != update->ntimestep) record();
}

// the box must not change along the fault: positions are relative to it, and headers hold its
// length
void ComputeLSMEvents::check_box()
{
  check_box_along(0);
  if (domain->dimension == 3 && settings.records_slip()) check_box_along(1);
}

// k: 0 along x, 1 along z
void ComputeLSMEvents::check_box_along(int k)
{
  const int d = 2 * k;
  const char name = "xz"[k];
  const bool placed = settings.records_slip();
  if (placed)
    for (const auto &ifix : modify->get_fix_list())
      if (ifix->box_change & (k ? Fix::BOX_CHANGE_Z : Fix::BOX_CHANGE_X))
        error->all(FLERR, Error::NOLASTLINE,
                   "Compute lsm/events {}: fix {} changes the box along {}, which {} cannot follow",
                   id, ifix->id, name, settings.asked_by());
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
          id, name, begin[k], begin[k] + period[k], domain->boxlo[d], domain->boxhi[d],
          placed ? "the places of events" : "the header of file " + file);
}

// adapts times and the picker, whose rate is per step, to another time step; headers state only one
// time step, so it must not change once the files are open
void ComputeLSMEvents::change_dt()
{
  if (update->dt == clock.dt) return;
  for (const auto &[key, file] : LSM::files_of(settings))
    if (opened && !file.empty())
      error->all(
          FLERR, Error::NOLASTLINE,
          "Compute lsm/events {}: the time step changed from {} to {}, but the header of file {} "
          "has one time step; continue from a restart file with other files",
          id, clock.dt, update->dt, file);
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

double ComputeLSMEvents::time_of(bigint step) const
{
  return sources.leap() ? sources.leap()->model_time(step) : clock.at(step);
}

void ComputeLSMEvents::refuse_gap() const
{
  error->all(FLERR, Error::NOLASTLINE,
             "Compute lsm/events {}: the step was {} and is {} now, but {} follow the steps one by "
             "one; uncompute it first, and use other files",
             id, last_recorded, update->ntimestep, settings.asked_by());
}

// a run without a set-up may begin at another step
void ComputeLSMEvents::end_step()
{
  if (fault_begun && update->ntimestep != last_recorded + 1) refuse_gap();
  record();
}

void ComputeLSMEvents::record()
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
    guard.check_step(ledger, [this] {
      return energies();
    });
}

// sends the filled block to rank 0, which processes it when the next block is full
void ComputeLSMEvents::start_gather()
{
  finish_gather();
  if (!sampler.empty()) gather.start(sampler.hand_over());
}

void ComputeLSMEvents::finish_gather()
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

void ComputeLSMEvents::flush()
{
  start_gather();
  finish_gather();
  on_rank_0([this] {
    stream->flush();
  });
  stop_on_failure();
}

void ComputeLSMEvents::end_run()
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
std::vector<double> ComputeLSMEvents::sum_on_0(LSM::SlipRecorder &slip) const
{
  std::vector<double> all(slip.sums().size());
  MPI_Reduce(slip.sums().data(), all.data(), static_cast<int>(all.size()), MPI_DOUBLE, MPI_SUM, 0,
             world);
  return all;
}

// displacements of the faces since add_faces()
std::vector<LSM::FaceDisplacement> ComputeLSMEvents::faces() const
{
  return recorder->faces(sources.face(0), sources.face(1));
}

void ComputeLSMEvents::add_faces()
{
  if (recorder->faces_since() == update->ntimestep) return;
  fault.add(faces());
  recorder->begin_faces();
}

// records the state before the first interval, for which only forces are needed
void ComputeLSMEvents::begin_fault()
{
  fault_begun = true;
  recorder->begin_faces();
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
void ComputeLSMEvents::leave_out_jump()
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
                   id, change);
}

double ComputeLSMEvents::total_pe() const
{
  return lsm_total(sources.pe(), world);
}

LSM::EnergyTerms ComputeLSMEvents::energies() const
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

std::vector<double> ComputeLSMEvents::pack_state()
{
  if (!opened) return recorder->saved_state;
  flush();
  if (settings.records_slip()) add_faces();
  const std::vector<double> open_sums = settings.records_slip() ? sum_on_0(fault)
                                                                : std::vector<double>();
  std::vector<double> state;
  const Own own = {last_recorded, ledger.for_restart(energies()), clock};
  LSM::StateWriter to(state);
  Own::visit(own, to);
  if (comm->me == 0) {
    const std::vector<double> rest = stream->state(open_sums);
    state.insert(state.end(), rest.begin(), rest.end());
  }
  return state;
}

// restores what this class keeps itself, and returns the rest
LSM::SavedStream ComputeLSMEvents::unpack_state(const std::vector<double> &state)
{
  Own own;
  LSM::SavedStream saved;
  if (state.size() >= Own::NUMBERS) {
    LSM::StateReader from(state);
    Own::visit(own, from);
  }
  if (!saved.read(state, Own::NUMBERS))
    error->all(FLERR, Error::NOLASTLINE,
               "Compute lsm/events {}: the restart file holds no state of such a compute", id);
  last_recorded = own.last_recorded;
  ledger = own.ledger;
  clock = own.clock;
  return saved;
}

double ComputeLSMEvents::compute_scalar()
{
  invoked_scalar = update->ntimestep;
  flush();
  double events = stream ? static_cast<double>(stream->drops().events) : 0.0;
  MPI_Bcast(&events, 1, MPI_DOUBLE, 0, world);
  scalar = events;
  return scalar;
}

void ComputeLSMEvents::compute_vector()
{
  invoked_vector = update->ntimestep;
  flush();
  double picked[4 + NRUPTURES] = {};
  double *const ruptures = picked + 4;
  if (stream) {
    picked[EVENTS] = static_cast<double>(stream->drops().events);
    picked[LAST_SIZE] = stream->drops().last_size;
    picked[RATE] = stream->picker().rate();
    picked[IN_EVENT] = stream->picker().in_event() ? 1.0 : 0.0;
    ruptures[RUPTURES] = static_cast<double>(stream->ruptures().events);
    ruptures[LAST_WORK] = stream->ruptures().last_size;
    ruptures[OPEN] = static_cast<double>(stream->open_ruptures());
  }
  MPI_Bcast(picked, 4 + NRUPTURES, MPI_DOUBLE, 0, world);
  std::copy_n(picked, 4, vector);
  std::fill(vector + NVECTOR, vector + size_vector, 0.0);
  if (settings.finds_ruptures())
    std::copy_n(ruptures, static_cast<int>(NRUPTURES), vector + NVECTOR + NLEDGER);

  double mine[3];
  sources.pe_by_kind(mine);
  MPI_Allreduce(mine, &vector[PE_LINK], 3, MPI_DOUBLE, MPI_SUM, world);
  vector[PE] =
      vector[PE_LINK] + vector[PE_CONTACT] + (settings.tangential ? vector[PE_TANGENTIAL] : 0.0);
  if (!options.ledger) return;
  const LSM::EnergyTerms now = energies();
  const double of_ledger[NLEDGER] = {now.kinetic,
                                     now.plates,
                                     now.friction,
                                     now.viscosity,
                                     ledger.begun() ? ledger.residual(now) : 0.0,
                                     now.broken,
                                     now.outside,
                                     now.absorbed,
                                     now.within};
  std::copy_n(of_ledger, NLEDGER, vector + NVECTOR);
}
