// SPDX-License-Identifier: GPL-2.0-or-later
/// \file slider_output.h
/// The files that a run writes as it goes: catalogue and PE series, either of which may be absent.
#ifndef SLIDER_OUTPUT_H
#define SLIDER_OUTPUT_H

#include <cstdint>
#include <limits>
#include <string>

#include "lsm_catalogue.h"
#include "lsm_output_claim.h"
#include "lsm_pe_series.h"
#include "slider_run.h"

namespace Slider {

class Outputs {
 public:
  /// Keeps other runs from writing the files, and checks that they can be written; writes none.
  /// \throws std::runtime_error naming file and option
  explicit Outputs(const RunOptions &options);

  /// Starts new files, with the sample of step 0.
  void create(double pe);
  /// Continues after the given step with a catalogue of so many events.
  /// \param late steps by which an event can be found after its end
  void resume(std::int64_t step, std::int64_t events, std::int64_t late);

  void event(const LSM::Event &event) {
    if (catalogue_.is_open()) catalogue_.write(event);
  }
  /// After a step; its sample is written if it is due.
  void sample(std::int64_t step, double pe) {
    if (series_.is_open() && step % stride_ == 0) series_.write(step, pe);
  }
  /// The first step after the given one whose sample is due.
  std::int64_t next_sample(std::int64_t step) const {
    return series_.is_open() ? (step / stride_ + 1) * stride_
                             : std::numeric_limits<std::int64_t>::max();
  }
  /// Everything so far is on disk.
  void flush();
  void close();

 private:
  std::string catalogue_path_, series_path_;
  std::int64_t stride_;
  LSM::OutputClaim claim_;  // let go of last
  LSM::CatalogueInfo catalogue_info_;
  LSM::PeSeriesInfo series_info_;
  LSM::CatalogueWriter catalogue_;
  LSM::PeSeriesWriter series_;
};

}  // namespace Slider

#endif
