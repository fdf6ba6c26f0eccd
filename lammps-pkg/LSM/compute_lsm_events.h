/* -*- c++ -*- ----------------------------------------------------------
   SPDX-License-Identifier: GPL-2.0-or-later
   Lattice Solid Model: potential energy at every step, slip events picked
   from its drops, catalogue and energy ledger
------------------------------------------------------------------------- */

#ifdef COMPUTE_CLASS
// clang-format off
ComputeStyle(lsm/events,ComputeLSMEvents);
// clang-format on
#else

#ifndef LMP_COMPUTE_LSM_EVENTS_H
#define LMP_COMPUTE_LSM_EVENTS_H

#include "compute.h"
#include "lsm_catalogue.h"
#include "lsm_energy.h"
#include "lsm_event_picker.h"
#include "lsm_pe_series.h"
#include "lsm_ruptures.h"
#include "lsm_slip_history.h"

#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace LAMMPS_NS {

class ComputeLSMEvents : public Compute {
 public:
  ComputeLSMEvents(class LAMMPS *, int, char **);
  ~ComputeLSMEvents() override;
  void init() override;
  double compute_scalar() override;
  void compute_vector() override;
  double memory_usage() override;

  // called by fix LSM_RECORD

  void setup_record();
  void record();
  void change_dt();
  void flush();
  void end_run();
  void look_early();
  std::vector<double> pack_state();

 private:
  // settings

  std::string catalogue_file, series_file, history_file, emergency_file;
  bool ruptures;    // events are ruptures, not drops of PE
  bool series_binary;
  int series_stride;
  LSM::PickerSettings picker_settings;
  double memory_time;    // > 0: lambda follows from it and the time step
  int block;             // steps collected before ranks talk to each other
  bool tangential;       // tangential springs count as potential energy
  bool location;         // slip moment, centroid and rupture length of each event
  double bin_width;
  double bin_fraction;    // bins with less than this part of the largest slip are not ruptured
  double
      slipping;    // bins whose slip velocity is above this multiple of the driving velocity slip
  double
      driving;    // velocity of one side of the fault relative to the other; 0: that of the plates
  double forward;    // direction of the upper side along x: 1 or -1
  int interval;      // steps over which the slip of a bin is taken together
  int gap;           // bins that may lie between two that are connected
  double pause;      // time over which slips are connected
  double modulus;    // shear modulus; 0: that of the links
  int quiet;         // intervals in one record of the history while nothing slips
  bool ledger;
  double ledger_tolerance;    // 0: not checked
  double strain_limit;
  int check_every;
  bool resume;
  bool overwrite;
  bool progress;
  std::vector<std::pair<std::string, std::string>> parameters;

  // sources

  class BondLSMLinked *links;
  class FixLSMRecord *recorder;
  std::vector<LSMEnergySource *> sources;
  class FixLSMPlates *plates;
  class FixLSMLeap *leap;    // null if steps and time are proportional
  std::vector<class FixLSMNVE *> integrators;

  // blocks of samples: one is filled while the other is on its way to rank 0

  std::vector<double> filling, sending, received;
  std::vector<LSMSlip> slip_filling;
  bigint first_filling, first_sending;
  int count_filling, count_sending;
  MPI_Request request;
  bool pending;
  std::vector<double> slip_sent;    // all slip of the block that is on its way, on rank 0
  std::vector<int> slip_steps;

  // slip of the fault: sums of the interval that is not complete, and those of the block

  LSM::FaultGrid grid;
  LSM::FaultSums sums;
  std::vector<double> sums_filling, sums_sent;
  bool went_on;                         // from ruptures of the restart file
  bool fault_begun;                     // its state before the first interval is known
  std::vector<double> saved_history;    // state of the slip history in the restart file

  // rank 0

  std::unique_ptr<LSM::RuptureFinder> finder;
  std::unique_ptr<LSM::SlipHistoryWriter> history;
  LSM::PickerState rupture_counts;    // only the numbers of events
  std::unique_ptr<LSM::EventPicker> picker;
  std::unique_ptr<LSM::CatalogueWriter> catalogue;
  std::unique_ptr<LSM::PeSeriesWriter> series;
  std::map<int, double> event_slip;    // moment of each bin since the open event commenced
  double shown_at, started_at;

  // ledger

  bool ledger_started;
  double ledger_start;
  double friction_before;    // work lost to friction before the last restart
  double broken_before;      // and with links that broke

  // time of a step counts from here, so that a restarted run gives the same numbers

  double anchor_time, anchor_dt;
  bigint anchor_step;

  bigint last_recorded;
  bool opened;
  bool check_now;         // something looked wrong within the step
  double widest;          // largest diameter
  std::string failure;    // what went wrong on rank 0, which the others have to hear of

  double residual_at_end;    // of the last run, which ended at step ended_at
  bigint ended_at;

  void check_surroundings();
  void leave_out_jump();
  void set_memory();
  double time_of(bigint step) const;
  LSM::CatalogueInfo header(bool of_ruptures) const;
  LSM::PeSeriesInfo series_header() const;
  LSM::SlipHistoryInfo history_header() const;
  LSM::RuptureSettings rupture_settings() const;
  const LSM::PickerState &counts() const;
  void open_files(bigint step);
  void begin_files(bigint step, bool from_restart);
  void stop_on_failure();
  void check_health();
  void unpack_state(const std::vector<double> &);
  void find_driving();
  void make_grid();
  std::vector<double> pack_ruptures();
  void unpack_ruptures(const std::vector<double> &, size_t);
  void begin_fault();
  void record_contacts(bigint step);
  bool ends_interval(bigint step) const
  {
    return step > grid.step0 && (step - grid.step0) % grid.interval == 0;
  }
  void take_interval(bigint step, double pe, const double *values);
  void finish_rupture(LSM::Event);
  void start_gather();
  void finish_gather();
  void take_block();
  void take_sample(bigint step, double pe, const double *slip, int nslip);
  void locate(LSM::Event &);
  double local_pe() const;
  double total(double mine) const;
  double kinetic() const;
  double friction_work() const;
  double viscous_work() const;
  double broken_work() const;
  double residual() const;
  void show_progress(bigint step);
};

}    // namespace LAMMPS_NS

#endif
#endif
