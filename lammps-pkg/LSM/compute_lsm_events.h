// SPDX-License-Identifier: GPL-2.0-or-later
// Lattice Solid Model: potential energy at every step, slip events picked from its drops, ruptures
// and slip of the fault, energy ledger. The core processes the samples; this class connects it with
// LAMMPS.

#ifdef COMPUTE_CLASS
// clang-format off
ComputeStyle(lsm/events,ComputeLSMEvents);
// clang-format on
#else

#ifndef LMP_COMPUTE_LSM_EVENTS_H
#define LMP_COMPUTE_LSM_EVENTS_H

#include "compute.h"
#include "events/block_sampler.h"
#include "events/event_stream.h"
#include "events/slip_recorder.h"
#include "fault/energy_ledger.h"
#include "lsm_block_gather.h"
#include "lsm_event_options.h"
#include "lsm_event_sources.h"
#include "lsm_progress.h"
#include "lsm_run_guard.h"

#include <memory>

namespace LAMMPS_NS {

class ComputeLSMEvents : public Compute {
 public:
  ComputeLSMEvents(class LAMMPS *, int, char **);
  ~ComputeLSMEvents() override;
  void init() override;
  double compute_scalar() override;
  void compute_vector() override;

  // called by fix LSM_RECORD

  void setup_record();
  void end_step();
  void change_dt();
  void flush();
  void end_run();
  void check_links() { guard.check_links(); }
  std::vector<double> pack_state();

 private:
  LSMEventOptions options;
  LSM::EventSettings &settings;    // part of the options

  class FixLSMRecord *recorder = nullptr;
  LSMEventSources sources;

  // on all ranks

  LSM::BlockSampler sampler;
  LSMBlockGather gather;
  LSM::SlipRecorder fault;
  LSM::EnergyLedger ledger;
  LSMRunGuard guard;
  LSM::StepClock clock;
  bigint last_recorded = -1;
  bool opened = false;
  bool fault_begun = false;    // the state before the first interval is recorded

  // on rank 0 only

  std::unique_ptr<LSM::EventStream> stream;
  std::string failure;    // error on rank 0, which the others have to be told
  LSMProgress progress;

  // lower end and length of the box at the first run, along x and, where slip of a plane is
  // recorded, along z

  double begin[2] = {0.0, 0.0}, period[2] = {0.0, 0.0};

  std::string id_of_fix() const { return std::string(id) + "_record"; }
  void record();
  void refuse_gap() const;
  void write_rest();
  void set_memory();
  void open_files();
  std::vector<LSM::Output> restart_files() const;
  LSM::SavedStream unpack_state(const std::vector<double> &);
  void make_grid(const LSM::SavedStream *);
  void begin_fault();
  void add_faces();
  void check_box();
  void check_box_along(int k);
  void leave_out_jump();
  void start_gather();
  void finish_gather();
  template <class Task> void on_rank_0(Task &&);
  void stop_on_failure();
  double time_of(bigint step) const;
  double total_pe() const;
  LSM::EnergyTerms energies() const;
  std::vector<double> sum_on_0(LSM::SlipRecorder &) const;
  std::vector<LSM::FaceDisplacement> faces() const;
};

}    // namespace LAMMPS_NS

#endif
#endif
