/* ----------------------------------------------------------------------
   SPDX-License-Identifier: GPL-2.0-or-later
------------------------------------------------------------------------- */

#include "compute_lsm_events.h"

#include "atom.h"
#include "bond_lsm_linked.h"
#include "comm.h"
#include "domain.h"
#include "error.h"
#include "fix_lsm_leap.h"
#include "fix_lsm_nve.h"
#include "fix_lsm_plates.h"
#include "fix_lsm_record.h"
#include "force.h"
#include "modify.h"
#include "pair_lsm_free.h"
#include "platform.h"
#include "update.h"
#include "utils.h"
#include "write_restart.h"

#include "lsm_scene.h"
#include "lsm_sum.h"
#include "lsm_text_io.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <exception>
#include <filesystem>

#include <unistd.h>

using namespace LAMMPS_NS;

// entries of the global vector

enum {
  EVENTS,
  LAST_SIZE,
  RATE,
  IN_EVENT,
  PE,
  PE_LINK,
  PE_CONTACT,
  PE_TANGENTIAL,
  NVECTOR,
  KINETIC = NVECTOR,
  WORK_PLATES,
  WORK_FRICTION,
  WORK_VISCOSITY,
  RESIDUAL,
  WORK_BROKEN,
  NLEDGER
};

/* ---------------------------------------------------------------------- */

ComputeLSMEvents::ComputeLSMEvents(LAMMPS *_lmp, int narg, char **arg) :
    Compute(_lmp, narg, arg), emergency_file("lsm_emergency.restart"), ruptures(false),
    series_binary(true), series_stride(1), memory_time(0.0), block(100), tangential(true),
    location(false), bin_width(1.0), bin_fraction(0.05), slipping(5.0), driving(0.0), forward(1.0),
    interval(10), gap(1), pause(3.0), modulus(0.0), quiet(100), ledger(false),
    ledger_tolerance(0.0), strain_limit(0.5), check_every(1000), resume(false), overwrite(false),
    progress(true), links(nullptr), recorder(nullptr), plates(nullptr), leap(nullptr),
    first_filling(0), first_sending(0), count_filling(0), count_sending(0),
    request(MPI_REQUEST_NULL), pending(false), went_on(false), fault_begun(false), shown_at(0.0),
    started_at(0.0), ledger_started(false), ledger_start(0.0), friction_before(0.0),
    broken_before(0.0), anchor_time(0.0), anchor_dt(0.0), anchor_step(0), last_recorded(-1),
    opened(false), check_now(false), widest(0.0), residual_at_end(0.0), ended_at(-1)
{
  if (igroup) error->all(FLERR, "Compute lsm/events must use group all");
  scalar_flag = 1;
  vector_flag = 1;
  extscalar = 0;
  extvector = 0;

  int iarg = 3;
  auto need = [&](int n) {
    if (iarg + n >= narg)
      error->all(FLERR, "Compute lsm/events keyword {} needs {} value{}", arg[iarg], n,
                 n > 1 ? "s" : "");
  };
  auto number = [&](int n) { return utils::numeric(FLERR, arg[iarg + n], false, lmp); };
  auto positive = [&](int n) {
    const double value = number(n);
    if (!(value > 0.0))
      error->all(FLERR, "Compute lsm/events {} is {}, but must be > 0", arg[iarg], arg[iarg + n]);
    return value;
  };
  auto count = [&](int n) {
    const int value = utils::inumeric(FLERR, arg[iarg + n], false, lmp);
    if (value < 1)
      error->all(FLERR, "Compute lsm/events {} is {}, but must be at least 1", arg[iarg],
                 arg[iarg + n]);
    return value;
  };
  auto no_less_than_zero = [&](int n) {
    const double value = number(n);
    if (!(value >= 0.0))
      error->all(FLERR, "Compute lsm/events {} is {}, but must be >= 0", arg[iarg], arg[iarg + n]);
    return value;
  };
  const char *only_ruptures = nullptr;
  auto yesno = [&](int n) { return utils::logical(FLERR, arg[iarg + n], false, lmp) != 0; };

  while (iarg < narg) {
    const std::string key = arg[iarg];
    need(1);
    int used = 2;
    for (const char *one :
         {"history", "slipping", "driving", "interval", "gap", "pause", "modulus", "quiet"})
      if (key == one) only_ruptures = one;
    if (key == "events") {
      const std::string kind = arg[iarg + 1];
      if (kind != "pe" && kind != "ruptures")
        error->all(FLERR, "Compute lsm/events events is '{}', but must be pe or ruptures", kind);
      ruptures = kind == "ruptures";
    } else if (key == "history") {
      history_file = arg[iarg + 1];
    } else if (key == "slipping") {
      slipping = no_less_than_zero(1);
    } else if (key == "driving") {
      driving = positive(1);
    } else if (key == "interval") {
      interval = count(1);
    } else if (key == "gap") {
      const double value = no_less_than_zero(1);
      gap = static_cast<int>(MIN(value, 1e6));
      if (gap != value)
        error->all(FLERR, "Compute lsm/events gap is {}, but must be a number of bins",
                   arg[iarg + 1]);
    } else if (key == "pause") {
      pause = no_less_than_zero(1);
    } else if (key == "modulus") {
      modulus = positive(1);
    } else if (key == "quiet") {
      quiet = count(1);
    } else if (key == "catalogue") {
      catalogue_file = arg[iarg + 1];
    } else if (key == "series") {
      need(2);
      series_file = arg[iarg + 1];
      const std::string form = arg[iarg + 2];
      if (form != "binary" && form != "text")
        error->all(FLERR, "Compute lsm/events series format is '{}', but must be binary or text",
                   form);
      series_binary = form == "binary";
      used = 3;
    } else if (key == "stride") {
      series_stride = count(1);
    } else if (key == "picker") {
      if (!LSM::from_string(arg[iarg + 1], picker_settings.reading))
        error->all(FLERR,
                   "Compute lsm/events picker is '{}', but must be exponential, average or literal",
                   arg[iarg + 1]);
    } else if (key == "lambda") {
      picker_settings.lambda = number(1);
      if (!(picker_settings.lambda >= 0.0 && picker_settings.lambda < 1.0))
        error->all(FLERR, "Compute lsm/events lambda is {}, but must be at least 0 and less than 1",
                   arg[iarg + 1]);
    } else if (key == "memory") {
      memory_time = positive(1);
    } else if (key == "minsize") {
      picker_settings.min_size = number(1);
      if (!(picker_settings.min_size >= 0.0))
        error->all(FLERR, "Compute lsm/events minsize is {}, but must be >= 0", arg[iarg + 1]);
    } else if (key == "nonpositive") {
      picker_settings.keep_nonpositive = yesno(1);
    } else if (key == "block") {
      block = count(1);
    } else if (key == "tangential") {
      tangential = yesno(1);
    } else if (key == "location") {
      location = yesno(1);
    } else if (key == "bin") {
      bin_width = positive(1);
    } else if (key == "fraction") {
      bin_fraction = number(1);
      if (!(bin_fraction >= 0.0 && bin_fraction < 1.0))
        error->all(FLERR,
                   "Compute lsm/events fraction is {}, but must be at least 0 and less than 1",
                   arg[iarg + 1]);
    } else if (key == "ledger") {
      ledger = yesno(1);
    } else if (key == "tolerance") {
      ledger_tolerance = positive(1);
      ledger = true;
    } else if (key == "strainlimit") {
      strain_limit = positive(1);
    } else if (key == "check") {
      check_every = count(1);
    } else if (key == "emergency") {
      emergency_file = arg[iarg + 1];
    } else if (key == "resume") {
      resume = yesno(1);
    } else if (key == "overwrite") {
      overwrite = yesno(1);
    } else if (key == "progress") {
      progress = yesno(1);
    } else if (key == "parameter") {
      need(2);
      parameters.emplace_back(arg[iarg + 1], arg[iarg + 2]);
      used = 3;
    } else
      error->all(
          FLERR,
          "Unknown compute lsm/events keyword '{}'; accepted are events, catalogue, series, "
          "stride, "
          "picker, lambda, memory, minsize, nonpositive, block, tangential, location, bin, "
          "fraction, history, slipping, driving, interval, gap, pause, modulus, quiet, ledger, "
          "tolerance, strainlimit, check, emergency, resume, overwrite, progress and parameter",
          key);
    iarg += used;
  }

  if (only_ruptures && !ruptures)
    error->all(FLERR, "Compute lsm/events keyword {} needs events ruptures", only_ruptures);
  if (ruptures && location)
    error->all(
        FLERR,
        "Compute lsm/events location yes needs events pe; ruptures have columns of their own");

  size_vector = ledger ? NLEDGER : NVECTOR;
  vector = new double[size_vector];

  recorder =
      dynamic_cast<FixLSMRecord *>(modify->add_fix(std::string(id) + "_record all LSM_RECORD"));
  if (!recorder) error->all(FLERR, "Compute lsm/events could not create fix LSM_RECORD");
  recorder->owner = this;
}

/* ---------------------------------------------------------------------- */

ComputeLSMEvents::~ComputeLSMEvents()
{
  // an error between two steps leaves a block on its way, on all ranks; its buffers go with this object

  if (pending) MPI_Wait(&request, MPI_STATUS_IGNORE);

  // the styles and fixes below may be gone by now, so they are found again

  if (force) {
    if (auto p = dynamic_cast<LSMEnergySource *>(force->bond))
      p->record_what = LSMEnergySource::NONE;
    if (auto p = dynamic_cast<LSMEnergySource *>(force->pair))
      p->record_what = LSMEnergySource::NONE;
  }
  if (recorder && modify) {
    for (const auto &ifix : modify->get_fix_by_style("^lsm/nve"))
      if (auto p = dynamic_cast<FixLSMNVE *>(ifix)) p->record_work = false;
    const std::string id_fix = std::string(id) + "_record";
    if (modify->get_fix_by_id(id_fix)) modify->delete_fix(id_fix);
  }
  delete[] vector;
}

/* ---------------------------------------------------------------------- */

void ComputeLSMEvents::init()
{
  int same = 0;
  for (const auto &other : modify->get_compute_by_style("lsm/events"))
    if (auto p = dynamic_cast<ComputeLSMEvents *>(other)) same += p->ruptures == ruptures;
  if (same > 1 && comm->me == 0)
    error->warning(FLERR, "More than one compute lsm/events with the same kind of events");

  links = dynamic_cast<BondLSMLinked *>(force->bond_match("lsm/linked"));
  const auto contacts = LSMScene::contact_styles(force);
  if (!links && contacts.empty())
    error->all(FLERR, "Compute lsm/events needs bond style lsm/linked or pair style lsm/free or "
                      "lsm/friction");
  if (location && !force->pair_match("lsm/friction", 1))
    error->all(FLERR, "Compute lsm/events location yes needs pair style lsm/friction");
  if (location && !(domain->xperiodic))
    error->all(FLERR, "Compute lsm/events location yes needs a box that is periodic in x");
  if (ruptures && !force->pair_match("lsm/friction", 1))
    error->all(FLERR, "Compute lsm/events events ruptures needs pair style lsm/friction");
  if (ruptures && !(domain->xperiodic))
    error->all(FLERR, "Compute lsm/events events ruptures needs a box that is periodic in x");

  check_surroundings();

  const int what = LSMEnergySource::ENERGY | (location ? LSMEnergySource::SLIP : 0) |
                   (ruptures ? LSMEnergySource::CONTACTS : 0);
  sources.clear();
  if (links) sources.push_back(links);
  sources.insert(sources.end(), contacts.begin(), contacts.end());
  for (auto *source : sources) {
    source->record_what |= what;
    source->slip_bin = bin_width;
  }

  plates = nullptr;
  leap = nullptr;
  integrators.clear();
  for (const auto &ifix : modify->get_fix_list()) {
    if (auto p = dynamic_cast<FixLSMPlates *>(ifix)) plates = p;
    if (auto p = dynamic_cast<FixLSMLeap *>(ifix)) leap = p;
    if (auto p = dynamic_cast<FixLSMNVE *>(ifix)) {
      integrators.push_back(p);
      if (ledger) p->record_work = true;
    }
  }

  if (ruptures && leap)
    error->all(FLERR,
               "Compute lsm/events {}: events ruptures does not work with fix lsm/leap, as "
               "intervals of ruptures are"
               " as long as others; use events pe",
               id);
  if (ruptures) find_driving();
  set_memory();
  filling.resize(block);
  sending.resize(block);
  if (comm->me == 0) received.resize(static_cast<size_t>(block) * comm->nprocs);
}

/* ----------------------------------------------------------------------
   what the slip of the fault is measured against: velocity and direction of the plates, stiffness of the links
   the first run decides, as the headers of the files hold it
------------------------------------------------------------------------- */

void ComputeLSMEvents::find_driving()
{
  if (opened || update->whichflag == 0) return;
  if (plates && plates->driving() < 0.0) forward = -1.0;
  if (driving == 0.0 && plates) driving = fabs(plates->driving());
  if (driving == 0.0)
    error->all(FLERR, "Compute lsm/events events ruptures needs {}, or the keyword driving",
               plates ? "a velocity of fix lsm/plates that is not 0" : "fix lsm/plates");
  if (modulus > 0.0) return;
  if (!links)
    error->all(
        FLERR,
        "Compute lsm/events events ruptures needs bond style lsm/linked, or the keyword modulus");
  int dim;
  const auto *stiffness = static_cast<const double *>(links->extract("k", dim));
  modulus = 0.25 * sqrt(3.0) * stiffness[1];    // of the regular lattice of equal discs
}

/* ---------------------------------------------------------------------- */

void ComputeLSMEvents::make_grid()
{
  const double length = domain->prd[0];
  grid.bins = MAX(1, static_cast<int>(length / bin_width * (1.0 + 1e-12)));
  grid.x0 = domain->boxlo[0];
  grid.width = length / grid.bins;
  grid.step0 = update->ntimestep;
  grid.interval = interval;
  grid.time0 = anchor_time + static_cast<double>(update->ntimestep - anchor_step) * anchor_dt;
  grid.dt = update->dt;
  sums = LSM::FaultSums(grid);
  fault_begun = false;
  if (comm->me == 0) finder = std::make_unique<LSM::RuptureFinder>(grid, rupture_settings());
}

LSM::RuptureSettings ComputeLSMEvents::rupture_settings() const
{
  LSM::RuptureSettings settings;
  settings.velocity = slipping * driving;
  settings.gap = gap;
  settings.memory = MAX(1, static_cast<int64_t>(std::llround(pause / (interval * update->dt))));
  settings.modulus = modulus;
  return settings;
}

/// Numbers of events of the kind that is written.
const LSM::PickerState &ComputeLSMEvents::counts() const
{
  return ruptures ? rupture_counts : picker->state();
}

/* ---------------------------------------------------------------------- */

void ComputeLSMEvents::check_surroundings()
{
  if (modify->get_fix_by_id(std::string(id) + "_record") != recorder)
    error->all(FLERR,
               "Compute lsm/events {}: its fix {}_record is gone; use uncompute to end recording",
               id, id);
  if (update->whichflag == 0) return;
  if (update->whichflag == 2)
    error->all(FLERR, "Compute lsm/events does not work with minimize: it records the steps of a "
                      "run; uncompute it before");
  if (LSMScene::is_rerun(update))
    error->all(FLERR, "Compute lsm/events does not work with rerun: it records the steps of a run; "
                      "use thermo keyword pe "
                      "for the energies of snapshots");

  // the strain of links is looked at before particles move to other ranks

  for (const auto &ifix : modify->get_fix_list()) {
    if (ifix == recorder) break;
    if (ifix->pre_exchange_migrate)
      error->all(FLERR,
                 "Compute lsm/events {} must be defined before fix {}, which moves particles to "
                 "other ranks",
                 id, ifix->id);
  }
  if (ledger)
    for (const char *adds_or_takes : {"^pour", "^deposit", "^evaporate"})
      for (const auto &other : modify->get_fix_by_style(adds_or_takes))
        error->all(
            FLERR,
            "Compute lsm/events {}: the energy ledger does not know the particles that fix {} "
            "adds or takes away; use ledger no and no tolerance",
            id, other->id);
  const std::string foreign = LSMScene::foreign_forces(force);
  if (!foreign.empty() && comm->me == 0)
    error->warning(FLERR,
                   "Compute lsm/events {}: PE, events and ledger do not hold the energy of {}", id,
                   foreign);
}

/* ---------------------------------------------------------------------- */

void ComputeLSMEvents::set_memory()
{
  if (memory_time <= 0.0) return;
  if (update->dt <= 0.0) error->all(FLERR, "Compute lsm/events memory needs a time step > 0");
  picker_settings.lambda = LSM::lambda_from_memory_time(memory_time, update->dt);
}

/* ---------------------------------------------------------------------- */

double ComputeLSMEvents::time_of(bigint step) const
{
  if (leap) return leap->model_time(step);
  return anchor_time + static_cast<double>(step - anchor_step) * anchor_dt;
}

/* ---------------------------------------------------------------------- */

static LSM::text_io::Parameters without(LSM::text_io::Parameters all,
                                        const std::vector<std::string> &keys)
{
  all.erase(std::remove_if(all.begin(), all.end(),
                           [&keys](const auto &p) {
                             return std::find(keys.begin(), keys.end(), p.first) != keys.end();
                           }),
            all.end());
  return all;
}

LSM::CatalogueInfo ComputeLSMEvents::header(bool of_ruptures) const
{
  using LSM::text_io::number;
  LSM::CatalogueInfo info;
  info.model = "lsm";
  auto add = [&](const std::string &key, const std::string &value) {
    for (const auto &p : parameters)
      if (p.first == key) return;
    info.parameters.emplace_back(key, value);
  };
  add("program", std::string("LAMMPS ") + lmp->version + " package LSM 1");
  add("particles", std::to_string(atom->natoms));
  add("links", std::to_string(atom->nbonds));
  add("length", number(domain->prd[0]));
  add("dt", number(update->dt));
  for (size_t n = 0; n < integrators.size(); n++)
    add(n ? "viscosity_" + std::to_string(n + 1) : "viscosity", integrators[n]->viscosity());
  if (leap) add("leap", leap->settings());
  if (!of_ruptures) {
    add("picker", LSM::to_string(picker_settings.reading));
    add("lambda", number(picker_settings.lambda));
  }
  add("min_size", number(picker_settings.min_size));
  add("tangential_energy", tangential ? "yes" : "no");
  if (location) {
    add("slip_bin", number(bin_width));
    add("rupture_fraction", number(bin_fraction));
  }
  if (of_ruptures) {
    add("events", "ruptures");
    add("driving", number(driving));
    add("slipping", number(slipping));
    add("slip_velocity", number(slipping * driving));
    add("slip_bin", number(grid.width));
    add("interval", std::to_string(interval));
    add("gap", std::to_string(gap));
    add("pause", number(pause));
    add("modulus", number(modulus));
  }
  add("ranks", std::to_string(comm->nprocs));
  info.parameters.insert(info.parameters.end(), parameters.begin(), parameters.end());
  info.slip_moment = info.x_centroid = info.rupture_length = location || of_ruptures;
  info.x_hypocentre = info.x_begin = info.mean_slip = info.stress_drop = of_ruptures;
  return info;
}

/* ----------------------------------------------------------------------
   of the series, which is the same whatever the events are
------------------------------------------------------------------------- */

LSM::PeSeriesInfo ComputeLSMEvents::series_header() const
{
  LSM::PeSeriesInfo info;
  info.model = "lsm";
  info.dt = update->dt;
  // the numbers that times are computed from, so that a reader gets the times of the catalogue
  info.step0 = anchor_step;
  info.time0 = anchor_time;
  info.stride = series_stride;
  info.parameters = without(header(false).parameters, {"dt"});
  return info;
}

LSM::SlipHistoryInfo ComputeLSMEvents::history_header() const
{
  LSM::SlipHistoryInfo info;
  info.grid = grid;
  info.ruptures = rupture_settings();
  info.driving = driving;
  info.quiet = quiet;
  info.parameters = without(header(true).parameters, {"dt", "slip_velocity", "interval", "gap",
                                                      "modulus", "driving", "slip_bin", "events"});
  return info;
}

/* ----------------------------------------------------------------------
   Files are opened at the first run, so that a mistake earlier in the input touches no older catalogue.
------------------------------------------------------------------------- */

void ComputeLSMEvents::open_files(bigint step)
{
  const bool from_restart = !recorder->restart_state.empty();
  if (comm->me == 0) {
    picker = std::make_unique<LSM::EventPicker>(picker_settings);
    shown_at = started_at = platform::walltime();
  }
  anchor_time = update->atime;
  anchor_step = update->atimestep;
  anchor_dt = update->dt;
  if (ruptures) make_grid();
  if (from_restart) unpack_state(recorder->restart_state);
  change_dt();
  if (comm->me == 0) begin_files(step, from_restart);
  stop_on_failure();
  opened = true;
}

/* ----------------------------------------------------------------------
   on rank 0; what is in the way is found before the first file is touched
------------------------------------------------------------------------- */

void ComputeLSMEvents::begin_files(bigint step, bool from_restart)
{
  std::error_code code;
  for (const auto &[file, key] :
       {std::pair<const std::string &, const char *>{catalogue_file, "catalogue"},
        {series_file, "series"},
        {history_file, "history"}}) {
    if (file.empty()) continue;
    const bool continued = resume && std::filesystem::exists(file, code);
    if (continued && !from_restart)
      failure = fmt::format(
          "Compute lsm/events resume yes: file {} exists, but the restart file holds no "
          "picker state of compute {}; read a restart written while it was active",
          file, id);
    else if (continued && ruptures && !went_on && file != series_file)
      failure = fmt::format(
          "Compute lsm/events resume yes: file {} exists, but the restart file holds no "
          "ruptures of compute {} with these bins and intervals; give another name, or replace it "
          "with overwrite yes and resume no",
          file, id);
    else if (!continued && !overwrite && LSM::text_io::holds_data(file))
      failure = fmt::format(
          "Compute lsm/events {}: file {} exists; give another name, or replace it with "
          "overwrite yes{}",
          key, file, from_restart ? ", or go on with it with resume yes" : "");
    else
      failure = LSM::text_io::why_not_writable(file);
    if (!failure.empty()) return;
  }

  const std::vector<std::string> free_to_change = {"program", "ranks", "links"};
  const auto goes_on = [&](const std::string &file) {
    return resume && !file.empty() && std::filesystem::exists(file, code);
  };
  const bool catalogue_goes_on = goes_on(catalogue_file), series_goes_on = goes_on(series_file);
  try {
    if (!catalogue_file.empty()) {
      catalogue = std::make_unique<LSM::CatalogueWriter>();
      // an event that ended at the restart step is only known one step later, and comes again
      // a rupture is known to have ended when its pause is over
      const bigint known =
          ruptures ? grid.step0 + (finder->intervals() - rupture_settings().memory) * grid.interval
                   : step - 1;
      if (catalogue_goes_on)
        catalogue->find_cut(catalogue_file, header(ruptures), known, free_to_change,
                            counts().events);
    }
    LSM::PeSeriesInfo info;
    if (!series_file.empty()) {
      info = series_header();
      series = std::make_unique<LSM::PeSeriesWriter>();
      if (series_goes_on) series->find_cut(series_file, info, series_binary, step, free_to_change);
    }
    if (!history_file.empty()) {
      history = std::make_unique<LSM::SlipHistoryWriter>();
      if (goes_on(history_file))
        history->resume(history_file, history_header(), saved_history, free_to_change);
    }

    // all fit

    if (catalogue)
      catalogue_goes_on ? (void) catalogue->cut()
                        : catalogue->create(catalogue_file, header(ruptures));
    if (series)
      series_goes_on ? (void) series->cut() : series->create(series_file, info, series_binary);
    if (history && !history->is_open() && went_on)
      history->create(history_file, history_header(),
                      grid.step0 + finder->intervals() * grid.interval, finder->pe(),
                      finder->stress());
  } catch (std::exception &e) {
    failure = fmt::format("Compute lsm/events: {}", e.what());
  }
}

/* ----------------------------------------------------------------------
   all ranks stop with what went wrong on rank 0, so that none waits for it
------------------------------------------------------------------------- */

void ComputeLSMEvents::stop_on_failure()
{
  int length = static_cast<int>(failure.size());
  MPI_Bcast(&length, 1, MPI_INT, 0, world);
  if (length == 0) return;
  failure.resize(length);
  MPI_Bcast(&failure[0], length, MPI_CHAR, 0, world);
  const std::string what = failure;
  failure.clear();
  error->all(FLERR, "{}", what);
}

/* ---------------------------------------------------------------------- */

double ComputeLSMEvents::local_pe() const
{
  double pe = 0.0;
  for (const auto *source : sources) {
    pe += source->pe_link + source->pe_contact;
    if (tangential) pe += source->pe_tangential;
  }
  return pe;
}

/* ----------------------------------------------------------------------
   called at the begin of each run: the state at this step is the first sample, unless the run before
   or the restart had it
------------------------------------------------------------------------- */

void ComputeLSMEvents::setup_record()
{
  double mine = 0.0;
  for (int i = 0; i < atom->nlocal; i++) mine = MAX(mine, 2.0 * atom->radius[i]);
  MPI_Allreduce(&mine, &widest, 1, MPI_DOUBLE, MPI_MAX, world);
  check_now = false;
  if (!opened) open_files(update->ntimestep);
  change_dt();
  leave_out_jump();
  if (ruptures && !fault_begun) begin_fault();
  if (ledger && !ledger_started) {
    ledger_start = 0.0;
    ledger_start = residual();
    ledger_started = true;
  }
  if (last_recorded != update->ntimestep) record();
}

/* ----------------------------------------------------------------------
   looks whether the time step is another one: times go on from here, and the picker's rate is one per step
   headers of files hold one time step, so it must not change once they are open
------------------------------------------------------------------------- */

void ComputeLSMEvents::change_dt()
{
  if (update->dt == anchor_dt) return;
  const std::string &file = !catalogue_file.empty() ? catalogue_file
                            : !series_file.empty()  ? series_file
                                                    : history_file;
  if (opened && !file.empty())
    error->all(FLERR,
               "Compute lsm/events {}: the time step changed from {} to {}, but the header of file "
               "{} holds one time "
               "step; go on from a restart file with other files",
               id, anchor_dt, update->dt, file);
  flush();
  const double ratio = anchor_dt > 0.0 ? update->dt / anchor_dt : 0.0;
  anchor_time = time_of(update->ntimestep);
  anchor_step = update->ntimestep;
  anchor_dt = update->dt;
  set_memory();
  if (ruptures) make_grid();
  if (ruptures && opened) begin_fault();
  if (!picker) return;
  LSM::PickerState state = picker->state();
  state.rate *= ratio;
  picker = std::make_unique<LSM::EventPicker>(picker_settings);
  picker->set_state(state);
}

/* ---------------------------------------------------------------------- */

void ComputeLSMEvents::record()
{
  const bigint step = update->ntimestep;
  if (count_filling == 0) first_filling = step;
  filling[count_filling] = local_pe();
  if (location)
    for (const auto *source : sources)
      for (const LSMSlip &s : source->slip) {
        slip_filling.push_back(s);
        slip_steps.push_back(count_filling);
      }
  if (ruptures) record_contacts(step);
  count_filling++;
  last_recorded = step;
  if (count_filling == block) start_gather();
  if (check_now || step % check_every == 0) check_health();
}

/* ----------------------------------------------------------------------
   the state before the first interval: only the forces count
------------------------------------------------------------------------- */

void ComputeLSMEvents::begin_fault()
{
  fault_begun = true;
  sums.clear();
  for (const auto *source : sources)
    for (const LSMContact &c : source->contacts)
      sums.add(c.x, 0.0, 0.0, forward * c.force, c.share);
  std::vector<double> all(sums.values().size());
  MPI_Reduce(sums.values().data(), all.data(), static_cast<int>(all.size()), MPI_DOUBLE, MPI_SUM, 0,
             world);
  sums.clear();
  const double pe = total(local_pe());
  if (comm->me == 0) {
    const LSM::FaultRow row = LSM::fault_row(grid, all.data(), 1);
    finder->begin(pe, row);
    try {
      if (history) history->create(history_file, history_header(), grid.step0, pe, row.stress);
    } catch (std::exception &e) {
      failure = fmt::format("Compute lsm/events: {}", e.what());
    }
  }
  stop_on_failure();
}

/* ----------------------------------------------------------------------
   adds the contacts of this step to the sums of the interval
------------------------------------------------------------------------- */

void ComputeLSMEvents::record_contacts(bigint step)
{
  if (step == grid.step0) return;
  for (const auto *source : sources)
    for (const LSMContact &c : source->contacts)
      sums.add(c.x, forward * c.slip, c.work, forward * c.force, c.share);
  if (!ends_interval(step)) return;
  sums_filling.insert(sums_filling.end(), sums.values().begin(), sums.values().end());
  sums.clear();
}

/* ----------------------------------------------------------------------
   hands the filled block to rank 0 and goes on; rank 0 looks at it when the next block is full
------------------------------------------------------------------------- */

void ComputeLSMEvents::start_gather()
{
  finish_gather();
  if (count_filling == 0) return;
  std::swap(filling, sending);
  first_sending = first_filling;
  count_sending = count_filling;
  count_filling = 0;
  MPI_Igather(sending.data(), count_sending, MPI_DOUBLE, received.data(), count_sending, MPI_DOUBLE,
              0, world, &request);
  pending = true;

  if (ruptures && !sums_filling.empty()) {
    sums_sent.resize(comm->me == 0 ? sums_filling.size() : 0);
    MPI_Reduce(sums_filling.data(), sums_sent.data(), static_cast<int>(sums_filling.size()),
               MPI_DOUBLE, MPI_SUM, 0, world);
    sums_filling.clear();
  }
  if (location) {
    std::vector<double> mine;
    mine.reserve(3 * slip_filling.size());
    for (size_t n = 0; n < slip_filling.size(); n++) {
      mine.push_back(slip_steps[n]);
      mine.push_back(slip_filling[n].bin);
      mine.push_back(slip_filling[n].moment);
    }
    slip_filling.clear();
    slip_steps.clear();
    const int n = static_cast<int>(mine.size());
    std::vector<int> slip_counts(comm->nprocs, 0), offsets(comm->nprocs, 0);
    MPI_Gather(&n, 1, MPI_INT, slip_counts.data(), 1, MPI_INT, 0, world);
    int sum = 0;
    for (int p = 0; p < comm->nprocs; p++) {
      offsets[p] = sum;
      sum += slip_counts[p];
    }
    slip_sent.resize(comm->me == 0 ? sum : 0);
    MPI_Gatherv(mine.data(), n, MPI_DOUBLE, slip_sent.data(), slip_counts.data(), offsets.data(),
                MPI_DOUBLE, 0, world);
  }
}

/* ---------------------------------------------------------------------- */

void ComputeLSMEvents::finish_gather()
{
  if (!pending) return;
  MPI_Wait(&request, MPI_STATUS_IGNORE);
  pending = false;
  if (comm->me == 0) take_block();
  stop_on_failure();
}

/* ---------------------------------------------------------------------- */

void ComputeLSMEvents::take_block()
{
  // slip of the block by step, in the order of the ranks

  std::vector<std::vector<double>> slip_of(location ? count_sending : 0);
  for (size_t n = 0; n + 2 < slip_sent.size() && location; n += 3) {
    auto &one = slip_of[static_cast<size_t>(slip_sent[n])];
    one.push_back(slip_sent[n + 1]);
    one.push_back(slip_sent[n + 2]);
  }

  const double *values = sums_sent.data();
  for (int s = 0; s < count_sending && failure.empty(); s++) {
    LSM::NeumaierSum sum;
    for (int p = 0; p < comm->nprocs; p++)
      sum.add(received[static_cast<size_t>(p) * count_sending + s]);
    const double *slip = location ? slip_of[s].data() : nullptr;
    const int nslip = location ? static_cast<int>(slip_of[s].size() / 2) : 0;
    take_sample(first_sending + s, sum.value(), slip, nslip);
    if (!ruptures || !failure.empty() || !ends_interval(first_sending + s)) continue;
    take_interval(first_sending + s, sum.value(), values);
    values += LSM::FaultSums::fields * grid.bins;
  }
  if (progress) show_progress(first_sending + count_sending - 1);
}

/* ---------------------------------------------------------------------- */

void ComputeLSMEvents::take_sample(bigint step, double pe, const double *slip, int nslip)
{
  try {
    if (!std::isfinite(pe)) {
      if (series) series->flush();
      failure = fmt::format(
          "Potential energy is not finite at step {}; the catalogue ends with the last event "
          "before it. Use a smaller time step or start from an earlier restart",
          step);
      return;
    }
    if (series && step % series_stride == 0) series->write(step, pe);

    LSM::Event event;
    const bool was_open = picker->in_event();
    const bool ended = picker->push(step, time_of(step), pe, event);
    if (ended && location) locate(event);
    if (ended && catalogue && !ruptures) catalogue->write(event);
    if (location) {
      if (was_open && !picker->in_event()) event_slip.clear();
      if (picker->in_event())
        for (int n = 0; n < nslip; n++)
          event_slip[static_cast<int>(slip[2 * n])] += slip[2 * n + 1];
    }
  } catch (std::exception &e) {
    failure = fmt::format("Compute lsm/events: {}", e.what());
  }
}

/* ---------------------------------------------------------------------- */

void ComputeLSMEvents::take_interval(bigint step, double pe, const double *values)
{
  try {
    const LSM::FaultRow row = LSM::fault_row(grid, values, grid.interval);
    finder->add(pe, row, [this](const LSM::Event &event) { finish_rupture(event); });
    if (history) history->add(step, pe, row, finder->active());
  } catch (std::exception &e) {
    failure = fmt::format("Compute lsm/events: {}", e.what());
  }
}

/* ---------------------------------------------------------------------- */

void ComputeLSMEvents::finish_rupture(LSM::Event event)
{
  if (!(event.size > 0.0)) {
    if (!picker_settings.keep_nonpositive) {
      rupture_counts.dropped_nonpositive++;
      return;
    }
  } else if (event.size < picker_settings.min_size) {
    rupture_counts.dropped_small++;
    return;
  }
  event.id = ++rupture_counts.events;
  rupture_counts.last_size = event.size;
  if (catalogue) catalogue->write(event);
}

/* ----------------------------------------------------------------------
   slip moment, centroid and rupture length of an event from the slip of the bins along the fault
   centroid: direction of the mean of the bins on the circle that the period makes
------------------------------------------------------------------------- */

void ComputeLSMEvents::locate(LSM::Event &event)
{
  const double length = domain->prd[0];
  double largest = 0.0, sum = 0.0, c = 0.0, s = 0.0;
  for (const auto &bin : event_slip) {
    const double angle = 2.0 * M_PI * (bin.first + 0.5) * bin_width / length;
    largest = MAX(largest, bin.second);
    sum += bin.second;
    c += bin.second * cos(angle);
    s += bin.second * sin(angle);
  }
  int ruptured = 0;
  for (const auto &bin : event_slip)
    if (bin.second > bin_fraction * largest) ruptured++;
  double along = atan2(s, c) / (2.0 * M_PI);
  if (along < 0.0) along += 1.0;
  event.slip_moment = sum;
  event.x_centroid = domain->boxlo[0] + along * length;
  event.rupture_length = MIN(ruptured * bin_width, length);
}

/* ---------------------------------------------------------------------- */

void ComputeLSMEvents::flush()
{
  start_gather();
  finish_gather();
  try {
    if (series) series->flush();
  } catch (std::exception &e) {
    failure = fmt::format("Compute lsm/events: {}", e.what());
  }
  stop_on_failure();
}

/* ---------------------------------------------------------------------- */

void ComputeLSMEvents::end_run()
{
  flush();
  for (auto *p : integrators) p->complete_step();
  if (ledger_started) residual_at_end = residual();
  ended_at = update->ntimestep;
}

/* ----------------------------------------------------------------------
   Commands between two runs (displace_atoms, delete_atoms, velocity, other coefficients) change energies at
   once. That is no event and no loss of the model: both go on from the energies that are found.
------------------------------------------------------------------------- */

void ComputeLSMEvents::leave_out_jump()
{
  const bigint step = update->ntimestep;
  const double size = MAX(domain->prd[0], domain->prd[1]);
  const double floor =
      1e-22 * static_cast<double>(atom->natoms) * size * size;    // positions rounded otherwise
  double change = 0.0;

  if (last_recorded == step) {
    flush();
    const double pe = total(local_pe());
    double jump = 0.0;
    if (picker && picker->state().step == step) jump = pe - picker->state().pe;
    MPI_Bcast(&jump, 1, MPI_DOUBLE, 0, world);
    if (fabs(jump) > MAX(1e-9 * fabs(pe), floor)) {
      change = jump;
      if (picker) {
        LSM::PickerState state = picker->state();
        state.pe += jump;
        state.pe_start += jump;
        picker->set_state(state);
      }
    }
  }
  if (ledger_started && ended_at == step) {
    const double jump = residual() - residual_at_end;
    const double scale = friction_work() + viscous_work() + kinetic() + fabs(total(local_pe()));
    if (fabs(jump) > MAX(1e-9 * scale, floor)) {
      change = jump;
      ledger_start += jump;
    }
  }
  if (change != 0.0 && comm->me == 0)
    error->warning(FLERR,
                   "Compute lsm/events {}: the energy changed by {:.6g} between two runs; events "
                   "and ledger leave "
                   "it out",
                   id, change);
}

/* ---------------------------------------------------------------------- */

double ComputeLSMEvents::total(double mine) const
{
  double all;
  MPI_Allreduce(&mine, &all, 1, MPI_DOUBLE, MPI_SUM, world);
  return all;
}

/* ----------------------------------------------------------------------
   plates: only their motion across the fault, as the energy of the driven motion is no part of the balance
------------------------------------------------------------------------- */

double ComputeLSMEvents::kinetic() const
{
  const int skip = plates ? plates->plate_bits() : 0;
  double **v = atom->v;
  LSM::NeumaierSum sum;
  for (int i = 0; i < atom->nlocal; i++) {
    if (atom->mask[i] & skip) continue;
    const double m = atom->rmass ? atom->rmass[i] : atom->mass[atom->type[i]];
    sum.add(m * (v[i][0] * v[i][0] + v[i][1] * v[i][1] + v[i][2] * v[i][2]));
  }
  return 0.5 * total(sum.value()) + (plates ? plates->kinetic() : 0.0);
}

double ComputeLSMEvents::friction_work() const
{
  double mine = 0.0;
  for (const auto *source : sources) mine += source->work_friction;
  return friction_before + total(mine);
}

double ComputeLSMEvents::broken_work() const
{
  return broken_before + (links ? total(links->work_broken) : 0.0);
}

double ComputeLSMEvents::viscous_work() const
{
  double mine = 0.0;
  for (const auto *p : integrators) mine += p->work_viscosity;
  return total(mine);
}

/* ----------------------------------------------------------------------
   kinetic + potential + losses - work of the plates, minus its value at the start
   the tangential springs belong to the balance even if they are not counted as potential energy
------------------------------------------------------------------------- */

double ComputeLSMEvents::residual() const
{
  double mine = 0.0;
  for (const auto *s : sources) mine += s->pe_link + s->pe_contact + s->pe_tangential;
  double e = kinetic() + total(mine) + friction_work() + viscous_work() + broken_work();
  if (plates) e -= plates->work();
  return e - ledger_start;
}

/* ----------------------------------------------------------------------
   Before neighbor lists are built: a link torn beyond the ghosts would stop LAMMPS with 'Bond atoms missing'.
   In the middle of a step there is no energy to check and nothing worth a restart file, so what can wait is
   checked when the step is complete.
------------------------------------------------------------------------- */

void ComputeLSMEvents::look_early()
{
  if (!links) return;
  double mine = links->max_strain(), all;
  if (!std::isfinite(mine)) mine = 1e300;
  MPI_Allreduce(&mine, &all, 1, MPI_DOUBLE, MPI_MAX, world);
  check_now = all > strain_limit;
  if (!check_now || (1.0 + all) * widest <= comm->get_comm_cutoff()) return;
  flush();
  error->all(FLERR,
             "Run stopped at step {}: {}. The catalogue ends with the last event before it; use a "
             "smaller time step or start from an earlier restart",
             update->ntimestep,
             all >= 1e300 ? "positions are not finite"
                          : fmt::format("a link is strained by {:.4g}, above strainlimit {:.4g}",
                                        all, strain_limit));
}

/* ----------------------------------------------------------------------
   at the end of a step; stops a run that went bad: everything recorded so far is written, then a restart file
------------------------------------------------------------------------- */

void ComputeLSMEvents::check_health()
{
  check_now = false;
  double mine[2] = {0.0, 0.0}, all[2];
  if (!std::isfinite(local_pe())) mine[0] = 1.0;
  if (links) {
    const double strain = links->max_strain();
    mine[1] = std::isfinite(strain) ? strain : 1e300;
  }
  MPI_Allreduce(mine, all, 2, MPI_DOUBLE, MPI_MAX, world);

  std::string what;
  if (all[0] > 0.0 || all[1] >= 1e300)
    what = "the potential energy is not finite";
  else if (all[1] > strain_limit)
    what =
        fmt::format("a link is strained by {:.4g}, above strainlimit {:.4g}", all[1], strain_limit);
  else if (ledger_tolerance > 0.0) {
    for (auto *p : integrators) p->complete_step();
    const double off = residual();
    const double scale = friction_work() + viscous_work() + kinetic() + fabs(total(local_pe()));
    if (fabs(off) > ledger_tolerance * scale)
      what = fmt::format("the energy ledger is out of balance by {:.4g} of {:.4g}, above tolerance "
                         "{:.4g}",
                         off, scale, ledger_tolerance);
  }
  if (what.empty()) return;

  // a restart file of such a state would be of no use, and would replace an older one

  if (all[0] > 0.0 || all[1] >= 1e300) {
    flush();
    error->all(
        FLERR,
        "Run stopped at step {}: {}. The catalogue ends with the last event before it; use a "
        "smaller time step or start from an earlier restart",
        update->ntimestep, what);
  }

  flush();
  for (auto *p : integrators) p->complete_step();
  auto writer = WriteRestart(lmp);
  writer.multiproc_options(0, 0, nullptr);
  writer.write(emergency_file);
  error->all(FLERR,
             "Run stopped at step {}: {}. Wrote restart file {}; use a smaller time step or start "
             "from an earlier restart",
             update->ntimestep, what, emergency_file);
}

/* ----------------------------------------------------------------------
   one line on a terminal, rewritten every few seconds; nothing in a pipe
------------------------------------------------------------------------- */

void ComputeLSMEvents::show_progress(bigint step)
{
  const double now = platform::walltime();
  if (now - shown_at < 5.0) return;
  shown_at = now;
  if (!isatty(STDERR_FILENO)) return;
  const double done = static_cast<double>(step - update->firststep);
  const double left = static_cast<double>(update->laststep - step);
  const double seconds = done > 0.0 ? (now - started_at) * left / done : 0.0;
  fprintf(stderr, "\rstep " BIGINT_FORMAT " of " BIGINT_FORMAT ", %lld events, %.0f s left   ",
          step, update->laststep, static_cast<long long>(counts().events), seconds);
}

/* ---------------------------------------------------------------------- */

std::vector<double> ComputeLSMEvents::pack_state()
{
  if (!opened) return recorder->restart_state;
  flush();
  const double friction = friction_work(), broken = broken_work();
  const std::vector<double> rupture_state = ruptures ? pack_ruptures() : std::vector<double>();
  std::vector<double> state;
  state = {ruptures ? 4.0 : 3.0,
           static_cast<double>(last_recorded),
           ledger_started ? 1.0 : 0.0,
           ledger_start,
           friction,
           broken,
           anchor_time,
           static_cast<double>(anchor_step),
           anchor_dt};
  if (comm->me == 0) {
    std::vector<double> bytes(sizeof(LSM::PickerState) / sizeof(double));
    memcpy(bytes.data(), &picker->state(), sizeof(LSM::PickerState));
    state.insert(state.end(), bytes.begin(), bytes.end());
    state.insert(state.end(), rupture_state.begin(), rupture_state.end());
    for (const auto &bin : event_slip) {
      state.push_back(bin.first);
      state.push_back(bin.second);
    }
  }
  return state;
}

void ComputeLSMEvents::unpack_state(const std::vector<double> &state)
{
  constexpr size_t fixed = 9, words = sizeof(LSM::PickerState) / sizeof(double);
  if (state.size() < fixed + words || (state[0] != 3.0 && state[0] != 4.0))
    error->all(FLERR, "Compute lsm/events {}: the restart file holds a state of another version",
               id);
  last_recorded = static_cast<bigint>(state[1]);
  ledger_started = state[2] != 0.0;
  ledger_start = state[3];
  friction_before = state[4];
  broken_before = state[5];
  anchor_time = state[6];
  anchor_step = static_cast<bigint>(state[7]);
  anchor_dt = state[8];
  if (ruptures && state[0] == 4.0) unpack_ruptures(state, fixed + words);
  if (comm->me == 0) {
    LSM::PickerState picker_state;
    memcpy(static_cast<void *>(&picker_state), &state[fixed], sizeof(picker_state));
    picker->set_state(picker_state);
    for (size_t n = fixed + words; n + 1 < state.size() && state[0] == 3.0; n += 2)
      event_slip[static_cast<int>(state[n])] = state[n + 1];
  }
}

/* ----------------------------------------------------------------------
   ruptures in the state, on rank 0: times of the intervals, then lists behind their lengths
------------------------------------------------------------------------- */

std::vector<double> ComputeLSMEvents::pack_ruptures()
{
  std::vector<double> open_sums(sums.values().size());
  MPI_Reduce(sums.values().data(), open_sums.data(), static_cast<int>(open_sums.size()), MPI_DOUBLE,
             MPI_SUM, 0, world);
  if (comm->me != 0) return {};
  std::vector<double> state = {static_cast<double>(grid.step0),
                               grid.time0,
                               grid.dt,
                               static_cast<double>(grid.interval),
                               static_cast<double>(grid.bins),
                               static_cast<double>(rupture_counts.events),
                               static_cast<double>(rupture_counts.dropped_nonpositive),
                               static_cast<double>(rupture_counts.dropped_small),
                               rupture_counts.last_size};
  const std::vector<double> written = history && history->is_open() ? history->state()
                                                                    : std::vector<double>();
  for (const auto &list : {open_sums, finder->state(), written}) {
    state.push_back(static_cast<double>(list.size()));
    state.insert(state.end(), list.begin(), list.end());
  }
  return state;
}

/* ----------------------------------------------------------------------
   another time step, interval or number of bins: the numbers of the ruptures go on, what was open is lost
------------------------------------------------------------------------- */

void ComputeLSMEvents::unpack_ruptures(const std::vector<double> &state, size_t at)
{
  constexpr size_t fixed = 9;
  std::vector<std::vector<double>> lists;
  if (at + fixed <= state.size()) {
    for (size_t n = at + fixed; n < state.size(); n += lists.back().size()) {
      const auto length = static_cast<size_t>(state[n++]);
      if (length > state.size() - n) break;
      lists.emplace_back(state.begin() + n, state.begin() + n + length);
    }
  }
  if (lists.size() != 3)
    error->all(FLERR, "Compute lsm/events {}: the restart file holds a state of another version",
               id);
  const double *const saved = &state[at];
  rupture_counts.events = static_cast<int64_t>(saved[5]);
  rupture_counts.dropped_nonpositive = static_cast<int64_t>(saved[6]);
  rupture_counts.dropped_small = static_cast<int64_t>(saved[7]);
  rupture_counts.last_size = saved[8];
  fault_begun = went_on =
      saved[2] == update->dt && saved[3] == grid.interval && saved[4] == grid.bins;
  if (!went_on) {
    if (comm->me == 0)
      error->warning(FLERR,
                     "Compute lsm/events {}: the restart file holds ruptures of another time step, "
                     "interval or "
                     "number of bins; those that were open are lost",
                     id);
    return;
  }
  grid.step0 = static_cast<bigint>(saved[0]);
  grid.time0 = saved[1];
  sums = LSM::FaultSums(grid);
  if (comm->me != 0) return;
  sums.values() = lists[0];
  saved_history = lists[2];
  try {
    finder = std::make_unique<LSM::RuptureFinder>(grid, rupture_settings());
    finder->set_state(lists[1]);
  } catch (std::exception &e) {
    failure = fmt::format("Compute lsm/events {}: {}", id, e.what());
  }
}

/* ---------------------------------------------------------------------- */

double ComputeLSMEvents::compute_scalar()
{
  invoked_scalar = update->ntimestep;
  flush();
  double events = picker ? static_cast<double>(counts().events) : 0.0;
  MPI_Bcast(&events, 1, MPI_DOUBLE, 0, world);
  scalar = events;
  return scalar;
}

/* ---------------------------------------------------------------------- */

void ComputeLSMEvents::compute_vector()
{
  invoked_vector = update->ntimestep;
  flush();
  double picked[4] = {0.0, 0.0, 0.0, 0.0};
  if (picker) {
    picked[EVENTS] = static_cast<double>(counts().events);
    picked[LAST_SIZE] = counts().last_size;
    picked[RATE] = picker->rate();
    picked[IN_EVENT] = ruptures             ? static_cast<double>(finder->open())
                       : picker->in_event() ? 1.0
                                            : 0.0;
  }
  MPI_Bcast(picked, 4, MPI_DOUBLE, 0, world);
  for (int n = 0; n < 4; n++) vector[n] = picked[n];

  double mine[3] = {0.0, 0.0, 0.0};
  for (const auto *s : sources) {
    mine[0] += s->pe_link;
    mine[1] += s->pe_contact;
    mine[2] += s->pe_tangential;
  }
  MPI_Allreduce(mine, &vector[PE_LINK], 3, MPI_DOUBLE, MPI_SUM, world);
  vector[PE] = vector[PE_LINK] + vector[PE_CONTACT] + (tangential ? vector[PE_TANGENTIAL] : 0.0);
  if (!ledger) return;
  vector[KINETIC] = kinetic();
  vector[WORK_PLATES] = plates ? plates->work() : 0.0;
  vector[WORK_FRICTION] = friction_work();
  vector[WORK_VISCOSITY] = viscous_work();
  vector[RESIDUAL] = ledger_started ? residual() : 0.0;
  vector[WORK_BROKEN] = broken_work();
}

/* ---------------------------------------------------------------------- */

double ComputeLSMEvents::memory_usage()
{
  return static_cast<double>(filling.capacity() + sending.capacity() + received.capacity()) *
         sizeof(double);
}
