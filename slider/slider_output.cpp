// SPDX-License-Identifier: GPL-2.0-or-later
#include "slider_output.h"

#include <algorithm>

namespace Slider {

Outputs::Outputs(const RunOptions &o)
    : catalogue_path_(o.catalogue), series_path_(o.series), stride_(o.series_stride) {
  // Before anything is read: another run may have written these files.
  claim_.claim(outputs_of(o));
  check_replaced(o);
  probe(o.series);
  probe(o.checkpoint);
  catalogue_info_.model = "block-slider";
  catalogue_info_.parameters = o.header;
  catalogue_info_.slip_moment = true;
  catalogue_info_.x_centroid = o.x_centroid;
  catalogue_info_.rupture_length = o.rupture_length;
  series_info_.model = "block-slider";
  series_info_.dt = o.parameters.dt;
  series_info_.stride = o.series_stride;
  series_info_.parameters = o.header;
  // The series has keys of its own for these.
  auto &keys = series_info_.parameters;
  keys.erase(std::remove_if(keys.begin(), keys.end(),
                            [](const auto &x) { return x.first == "dt" || x.first == "stride"; }),
             keys.end());
}

void Outputs::create(double pe) {
  if (!catalogue_path_.empty()) catalogue_.create(catalogue_path_, catalogue_info_);
  if (series_path_.empty()) return;
  series_.create(series_path_, series_info_);
  series_.write(0, pe);
}

void Outputs::resume(std::int64_t step, std::int64_t events, std::int64_t late) {
  // No file is truncated before both are found to fit.
  if (!catalogue_path_.empty())
    catalogue_.find_cut(catalogue_path_, catalogue_info_, step - late, {}, events);
  if (!series_path_.empty()) series_.find_cut(series_path_, series_info_, step);
  if (!catalogue_path_.empty()) catalogue_.cut();
  if (!series_path_.empty()) series_.cut();
}

void Outputs::flush() {
  if (series_.is_open()) series_.flush();
  // After a power failure there must be no checkpoint without the files it relies on.
  for (const std::string &path : {catalogue_path_, series_path_})
    if (LSM::text_io::holds_data(path)) LSM::text_io::sync(path);
}

void Outputs::close() {
  if (series_.is_open()) series_.close();
  if (catalogue_.is_open()) catalogue_.close();
}

}  // namespace Slider
