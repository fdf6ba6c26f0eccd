// SPDX-License-Identifier: GPL-2.0-or-later
#include "files/slip_history.h"

#include <cmath>
#include <cstddef>

namespace LSM {

files::Parameters SlipHistoryInfo::header() const {
  files::Parameters all = binary_io::numbers_of(*this);
  all.insert(all.end(), parameters.begin(), parameters.end());
  return all;
}

std::string SlipHistoryInfo::read(const files::Parameters &all) {
  const auto ring = [&all](const char *key) {
    const std::string *const ends = files::find(all, key);
    return !ends || *ends != "open";
  };
  grid.ring = ring("ends");
  grid.ring_dip = grid.plane && ring("ends_dip");
  return {};
}

std::string SlipHistoryInfo::problem() const {
  if (model != "lsm") return "model is " + text::in_quotes(model) + ", expected 'lsm'";
  if (grid.bins < 1 || grid.bins > most_bins)
    return "bins is not a number of bins, expected 1 to " + std::to_string(most_bins);
  if (grid.rows < 1 || grid.rows > most_bins / grid.bins)
    return "bins_dip is " + text::number(grid.rows) + ", expected 1 to " +
           std::to_string(most_bins / grid.bins) + " with " + std::to_string(grid.bins) + " bins";
  for (const auto &[name, value] : {std::pair<const char *, double>{"bin", grid.width},
                                    {"bin_dip", grid.height},
                                    {"dt", grid.dt},
                                    {"modulus", ruptures.modulus}})
    if (!(value > 0.0))
      return std::string(name) + " is " + text::number(value) + ", expected a positive number";
  for (const auto &[name, value] :
       {std::pair<const char *, std::int64_t>{"interval", grid.interval},
        {"memory_intervals", ruptures.memory},
        {"quiet", quiet}})
    if (value < 1)
      return std::string(name) + " is " + text::number(value) + ", expected at least 1";
  if (ruptures.gap < 0 || ruptures.gap > most_bins)
    return "gap is out of range, expected 0 to " + std::to_string(most_bins);
  if (!(ruptures.velocity >= 0.0))
    return "slip_velocity is " + text::number(ruptures.velocity) + ", expected at least 0";
  return {};
}

bool SlipHistoryReader::next(SlipRecord &record) {
  using binary_io::from_bytes;
  const char *at = next_record();
  if (!at) return false;
  record.step_begin = from_bytes<std::int64_t>(at);
  record.step_end = from_bytes<std::int64_t>(at + 8);
  record.pe = from_bytes<double>(at + 16);
  at += 24;
  if (!std::isfinite(record.pe)) fail("pe is not finite, expected a finite number");
  record.row = FaultRow(info().grid);
  for (std::vector<float> *values : {&record.row.slip, &record.row.work, &record.row.stress})
    for (float &value : *values) {
      value = from_bytes<float>(at);
      at += 4;
      if (!std::isfinite(value))
        fail("slip, work or stress of a bin is not finite, expected finite numbers");
    }
  check_steps(record);
  last_end_ = record.step_end;
  has_last_ = true;
  return true;
}

void SlipHistoryReader::check_steps(const SlipRecord &record) const {
  const std::string steps =
      "steps " + std::to_string(record.step_begin) + " to " + std::to_string(record.step_end);
  const FaultGrid &grid = info().grid;
  if (!has_last_) {
    if (record.step_begin != record.step_end)
      fail(steps + ", expected the state before the first interval");
  } else if (record.step_begin != last_end_) {
    fail(steps + " after step " + std::to_string(last_end_) + ", expected records without gaps");
  } else if (record.step_end <= record.step_begin) {
    fail(steps + ", expected increasing steps");
  }
  // Unsigned, as the difference of two arbitrary steps may overflow a signed integer.
  const auto since =
      static_cast<std::uint64_t>(record.step_end) - static_cast<std::uint64_t>(grid.step0);
  if (record.step_end < grid.step0 || since % static_cast<std::uint64_t>(grid.interval) != 0)
    fail(steps + ", expected whole intervals of " + std::to_string(grid.interval) +
         " steps from step " + std::to_string(grid.step0));
  if (!std::isfinite(grid.time(record.step_end)))
    fail("time of " + steps + " is not finite, expected a finite number");
}

void SlipHistoryWriter::create(const std::string &path, const SlipHistoryInfo &info,
                               std::int64_t step, double pe, const std::vector<float> &stress) {
  begin(path, info);
  start(step);
  SlipRecord first{step, step, pe, FaultRow(info.grid)};
  first.row.stress = stress;
  put(first);
}

void SlipHistoryWriter::find_cut(const std::string &path, const SlipHistoryInfo &info,
                                 const std::vector<double> &saved) {
  close();
  const FaultRow row(info.grid);
  if (saved.size() != 4 + row.slip.size() + row.work.size() + row.stress.size())
    refuse(path, "the saved state is of another fault");
  SlipHistoryReader reader(files::open_plain(path), true);
  compare(path, reader.info(), info);
  start(0);
  StateReader in(saved);
  visit(*this, in);
  std::int64_t reached = 0, length = 0;
  SlipRecord record;
  while (reader.next(record) && record.step_end <= begin_) {
    reached = record.step_end;
    length = reader.end();
  }
  if (length == 0 || reached != begin_)
    refuse(path, (length == 0 ? "no records" : "records end at step " + std::to_string(reached)) +
                     ", expected them up to step " + std::to_string(begin_));
  file_.keep(path, length);
}

void SlipHistoryWriter::add(std::int64_t step_end, double pe, const FaultRow &row, bool active) {
  if (active) finish();
  for (std::size_t b = 0; b < slip_.size(); ++b) slip_[b] += static_cast<double>(row.slip[b]);
  for (std::size_t b = 0; b < work_.size(); ++b) work_[b] += static_cast<double>(row.work[b]);
  last_.step_end = step_end;
  last_.pe = pe;
  last_.row.stress = row.stress;
  ++pending_;
  if (active || pending_ >= info_.quiet) finish();
}

std::vector<double> SlipHistoryWriter::state() const {
  std::vector<double> out;
  StateWriter to(out);
  visit(*this, to);
  return out;
}

void SlipHistoryWriter::start(std::int64_t step) {
  begin_ = step;
  pending_ = 0;
  last_.row = FaultRow(info_.grid);
  slip_.assign(last_.row.slip.size(), 0.0);
  work_.assign(last_.row.work.size(), 0.0);
}

void SlipHistoryWriter::finish() {
  if (pending_ == 0) return;
  last_.step_begin = begin_;
  const auto take = [](std::vector<double> &sums, std::vector<float> &values) {
    for (std::size_t b = 0; b < sums.size(); ++b)
      values[b] = static_cast<float>(std::exchange(sums[b], 0.0));
  };
  take(slip_, last_.row.slip);
  take(work_, last_.row.work);
  put(last_);
  begin_ = last_.step_end;
  pending_ = 0;
}

void SlipHistoryWriter::put(const SlipRecord &record) {
  std::string bytes;
  bytes.reserve(static_cast<std::size_t>(info_.record_bytes()));
  binary_io::append_bytes(bytes, record.step_begin);
  binary_io::append_bytes(bytes, record.step_end);
  binary_io::append_bytes(bytes, record.pe);
  for (const std::vector<float> *values : {&record.row.slip, &record.row.work, &record.row.stress})
    for (const float value : *values) {
      if (!std::isfinite(value))
        throw FileError(file_.path() + ": cannot write step " + std::to_string(record.step_end) +
                        ": slip, work or stress is not finite");
      binary_io::append_bytes(bytes, value);
    }
  file_.write(bytes);
}

}  // namespace LSM
