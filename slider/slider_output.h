// SPDX-License-Identifier: GPL-2.0-or-later
/// \file slider_output.h
/// The files that a run writes as it goes: catalogue and PE series, either of which may be absent.
#ifndef SLIDER_OUTPUT_H
#define SLIDER_OUTPUT_H

#include <cstdint>
#include <limits>
#include <string>

#include "files/catalogue.h"
#include "files/output_claim.h"
#include "files/pe_series.h"
#include "slider_run.h"

namespace Slider {

class Outputs {
 public:
  /// Locks the files and checks that they can be written, without writing them.
  /// \throws std::runtime_error naming file and option
  explicit Outputs(const RunOptions &options) : o_(options) {
    // The files are locked before they are read, as another run may still be writing them.
    claim_ = LSM::claim_outputs(outputs_of(o_));
    check_replaced(o_);
    probe(o_.series);
    probe(o_.checkpoint);
    catalogue_info_.model = series_info_.model = "block-slider";
    catalogue_info_.parameters = o_.header;
    catalogue_info_.columns = {"slip_moment"};
    if (o_.x_centroid) catalogue_info_.columns.emplace_back("x_centroid");
    if (o_.rupture_length) catalogue_info_.columns.emplace_back("rupture_length");
    series_info_.dt = o_.parameters.dt;
    series_info_.stride = o_.series_stride;
    // The header of a series has a key of its own for the time step.
    series_info_.parameters = LSM::files::without(o_.header, {"dt"});
  }

  /// Starts new files, with the sample of step 0.
  void create(double pe) {
    if (!o_.catalogue.empty()) catalogue_.create(o_.catalogue, catalogue_info_);
    if (o_.series.empty()) return;
    series_.create(o_.series, series_info_);
    series_.write(0, pe);
  }
  /// Continues the files after the given step.
  /// \param events number of events in the catalogue until then
  void resume(std::int64_t step, std::int64_t events) {
    // No file is truncated before both have been found to belong to this run.
    if (!o_.catalogue.empty()) catalogue_.find_cut(o_.catalogue, catalogue_info_, events);
    if (!o_.series.empty()) series_.find_cut(o_.series, series_info_, step);
    if (!o_.catalogue.empty()) catalogue_.cut_with_new_header();
    if (!o_.series.empty()) series_.cut_with_new_header();
  }

  template <class Kind>
  void event(const Kind &event) {
    if (catalogue_.is_open()) catalogue_.write(event);
  }
  /// Writes the sample of a step if it is due.
  void sample(std::int64_t step, double pe) {
    if (series_.is_open() && step % o_.series_stride == 0) series_.write(step, pe);
  }
  /// The first step after the given one whose sample is due.
  std::int64_t next_sample(std::int64_t step) const {
    return series_.is_open() ? (step / o_.series_stride + 1) * o_.series_stride
                             : std::numeric_limits<std::int64_t>::max();
  }
  /// Forces everything so far to the disk: after a power failure there must be no checkpoint
  /// without the data that it relies on.
  void flush() {
    series_.flush();
    for (const std::string &path : {o_.catalogue, o_.series})
      if (LSM::files::holds_data(path)) LSM::files::sync(path);
  }
  void close() {
    series_.close();
    catalogue_.close();
  }

 private:
  const RunOptions &o_;
  LSM::OutputClaim claim_;  // before the writers, as it must be released after they are closed
  LSM::CatalogueInfo catalogue_info_;
  LSM::PeSeriesInfo series_info_;
  LSM::CatalogueWriter catalogue_;
  LSM::PeSeriesWriter series_;
};

}  // namespace Slider

#endif
