// SPDX-License-Identifier: GPL-2.0-or-later
// Internal to compute lsm/events: records each step, and keeps what is recorded in restart files.
// The core processes the samples; this class connects it with LAMMPS.

#ifdef FIX_CLASS
// clang-format off
FixStyle(LSM_RECORD,FixLSMRecord);
// clang-format on
#else

#ifndef LMP_FIX_LSM_RECORD_H
#define LMP_FIX_LSM_RECORD_H

#include "events/block_sampler.h"
#include "events/event_stream.h"
#include "events/slip_recorder.h"
#include "fault/energy_ledger.h"
#include "lsm_block_gather.h"
#include "lsm_event_options.h"
#include "lsm_event_sources.h"
#include "lsm_fix_state.h"
#include "lsm_progress.h"
#include "lsm_run_guard.h"

#include <memory>
#include <string>
#include <vector>

namespace LAMMPS_NS {

class FixLSMRecord : public LSMKeptFix<FixLSMRecord> {
 public:
  FixLSMRecord(class LAMMPS *, int, char **);
  ~FixLSMRecord() override;
  int setmask() override
  {
    return FixConst::PRE_EXCHANGE | FixConst::END_OF_STEP | FixConst::POST_RUN;
  }
  void init() override;
  void setup(int) override;
  void pre_exchange() override;
  void end_of_step() override;
  void post_run() override;
  void reset_dt() override;
  void write_restart(FILE *) override;
  template <class Self, class State> static void visit(Self &self, State &state)
  {
    state.list(self.saved_state);
  }
  void grow_arrays(int) override;
  void copy_arrays(int, int, int) override;
  void set_arrays(int) override;
  int pack_exchange(int, double *) override;
  int unpack_exchange(int, double *) override;
  double memory_usage() override;

  const LSMEventOptions &asked() const { return options; }
  const LSMEventSources &scene() const { return sources; }
  /// What was picked in all samples so far, on all ranks.
  LSM::Picked picked();
  LSM::EnergyTerms energies() const;
  double residual(const LSM::EnergyTerms &now) const
  {
    return ledger.begun() ? ledger.residual(now) : 0.0;
  }

 private:
  LSMEventOptions options;
  LSM::EventSettings &settings;    // part of the options
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
  bool fault_begun = false;           // the state before the first interval is recorded
  std::vector<double> saved_state;    // in the last restart file, read or written

  // on rank 0 only

  std::unique_ptr<LSM::EventStream> stream;
  std::string failure;    // error on rank 0, which the others have to be told
  LSMProgress progress;

  // lower end and length of the box at the first run, along x and, where slip of a plane is
  // recorded, along z

  double begin[2] = {0.0, 0.0}, period[2] = {0.0, 0.0};

  // stored x of each particle, in three dimensions followed by z; null if the faces are not needed

  double *x_before = nullptr;
  int directions = 1;    // numbers of a particle
  bigint since = -1;     // step in which it was stored

  void record();
  void stop_for(const LSM::Watchdog::Alarm &);
  void refuse_gap() const;
  void write_rest();
  void set_memory();
  void open_files();
  std::vector<LSM::Output> restart_files() const;
  void pack_state();
  LSM::SavedStream unpack_state(const std::vector<double> &);
  void make_grid(const LSM::SavedStream *);
  void begin_fault();
  void begin_faces();
  void add_faces();
  std::vector<LSM::FaceDisplacement> faces() const;
  void check_box();
  void check_box_along(int k);
  void change_dt();
  void leave_out_jump();
  void start_gather();
  void finish_gather();
  void flush();
  template <class Task> void on_rank_0(Task &&);
  void stop_on_failure();
  double time_of(bigint step) const;
  double total_pe() const;
  std::vector<double> sum_on_0(LSM::SlipRecorder &) const;
};

}    // namespace LAMMPS_NS

#endif
#endif
