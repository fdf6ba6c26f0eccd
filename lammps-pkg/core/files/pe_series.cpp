// SPDX-License-Identifier: GPL-2.0-or-later
#include "files/pe_series.h"

#include <cmath>
#include <stdexcept>

namespace LSM {

double PeSeriesInfo::time(std::int64_t step) const {
  return time0 + (static_cast<double>(step) - static_cast<double>(step0)) * dt;
}

files::Parameters PeSeriesInfo::header() const {
  files::Parameters all = binary_io::numbers_of(*this);
  if (explicit_times) all.emplace_back("times", "own");
  all.insert(all.end(), parameters.begin(), parameters.end());
  return all;
}

std::string PeSeriesInfo::read(const files::Parameters &all) {
  const std::string *const times = files::find(all, "times");
  explicit_times = times != nullptr;
  if (!times || *times == "own") return {};
  return "parameter 'times' is " + text::in_quotes(*times) + ", expected 'own' or none";
}

std::string PeSeriesInfo::problem() const {
  if (model != "lsm" && model != "block-slider")
    return "model is " + text::in_quotes(model) + ", expected 'lsm' or 'block-slider'";
  if (!std::isfinite(dt) || !(dt > 0.0))
    return "dt is " + text::number(dt) + ", expected a positive number";
  if (!std::isfinite(time0))
    return "time0 is " + text::number(time0) + ", expected a finite number";
  if (stride < 1) return "stride is " + text::number(stride) + ", expected at least 1";
  return {};
}

bool PeSeriesReader::next(std::int64_t &step, double &time, double &pe) {
  using binary_io::from_bytes;
  const bool own = info().explicit_times;
  const char *const record = next_record();
  if (!record) return false;
  step = from_bytes<std::int64_t>(record);
  time = own ? from_bytes<double>(record + 8) : info().time(step);
  pe = from_bytes<double>(record + (own ? 16 : 8));
  if (!std::isfinite(time))
    fail("time of step " + std::to_string(step) + " is not finite, expected a finite number");
  if (!std::isfinite(pe)) fail("pe is not finite, expected a finite number");
  if (has_last_ && step <= last_step_)
    fail("step " + std::to_string(step) + " after step " + std::to_string(last_step_) +
         ", expected increasing steps");
  if (has_last_ && time < last_time_)
    fail("time " + text::number(time) + " after time " + text::number(last_time_) +
         ", expected increasing times");
  last_step_ = step;
  last_time_ = time;
  has_last_ = true;
  return true;
}

PeSeriesWriter::~PeSeriesWriter() {
  try {
    close();
  } catch (...) {
    // Call close() before destruction to learn of errors.
  }
}

void PeSeriesWriter::create(const std::string &path, const PeSeriesInfo &info) {
  close();
  begin(path, info);
  start();
}

void PeSeriesWriter::find_cut(const std::string &path, const PeSeriesInfo &info,
                              std::int64_t last_step) {
  close();
  PeSeriesReader reader(files::open_plain(path), true);
  compare(path, reader.info(), info);
  start();
  std::int64_t step = 0, length = old_header_ = reader.end();
  double time = 0.0, pe = 0.0;
  // Steps increase, so the first one to drop is where the file is cut.
  while (reader.next(step, time, pe) && step <= last_step) {
    last_step_ = step;
    last_time_ = time;
    length = reader.end();
    ++rows_;
  }
  // Where a file without samples was begun is not known.
  if (rows_ > 0 && last_step - info.stride >= last_step_)
    refuse(path, "samples end at step " + std::to_string(last_step_) +
                     ", expected them up to step " + std::to_string(last_step));
  file_.keep(path, length);
}

void PeSeriesWriter::write(std::int64_t step, double pe) {
  if (info_.explicit_times) throw std::logic_error("PE series: a sample needs its time");
  write(step, info_.time(step), pe);
}

void PeSeriesWriter::write(std::int64_t step, double time, double pe) {
  if (!file_.is_open()) throw FileError("PE series is not open");
  if (!info_.explicit_times) time = info_.time(step);
  const auto refuse = [&](const std::string &what) {
    throw FileError(file_.path() + ": cannot write step " + std::to_string(step) + what);
  };
  if (!std::isfinite(time)) refuse(": time is not finite, expected a finite number");
  if (rows_ > 0 && info_.explicit_times && time < last_time_)
    refuse(": time " + text::number(time) + " after time " + text::number(last_time_) +
           ", expected increasing times");
  if (!std::isfinite(pe)) refuse(": pe is not finite, expected a finite number");
  if (rows_ > 0 && step <= last_step_)
    refuse(" after step " + std::to_string(last_step_) + ", expected increasing steps");
  binary_io::append_bytes(buffer_, step);
  if (info_.explicit_times) binary_io::append_bytes(buffer_, time);
  binary_io::append_bytes(buffer_, pe);
  last_step_ = step;
  last_time_ = time;
  ++rows_;
  if (buffer_.size() >= buffer_limit) flush();
}

void PeSeriesWriter::flush() {
  if (buffer_.empty()) return;
  file_.write(buffer_);
  buffer_.clear();
}

void PeSeriesWriter::close() {
  if (!file_.is_open()) return;
  flush();
  file_.close();
}

void PeSeriesWriter::start() {
  rows_ = 0;
  buffer_.clear();
  buffer_.reserve(buffer_limit + 128);
}

}  // namespace LSM
