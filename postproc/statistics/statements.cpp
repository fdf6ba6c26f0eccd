// SPDX-License-Identifier: GPL-2.0-or-later
#include "statements.h"

#include <gsl/gsl_cdf.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "power_law.h"

namespace LSM::postproc {

namespace {

using Parts = std::vector<double>;

double total(const Parts &parts) {
  NeumaierSum sum;
  for (const double part : parts) sum.add(part);
  return sum.value();
}

/// Jackknife estimate of a function of totals.
/// \param parts number of parts
/// \param of_all_but value without one part; with the argument `parts`, of all of them
template <class Function>
Measured jackknife(std::size_t parts, const Function &of_all_but) {
  Measured found{of_all_but(parts), 0.0};
  const auto n = static_cast<double>(parts);
  Parts without;
  for (std::size_t k = 0; k < parts; ++k) without.push_back(of_all_but(k));
  const double mean = mean_of(without);
  NeumaierSum squares;
  for (const double value : without) squares.add((value - mean) * (value - mean));
  found.error = std::sqrt(squares.value() * (n - 1.0) / n);
  return found;
}

/// Time spent at each velocity over that of the plates: one bin below a tenth, then five per
/// decade.
class VelocityTimes {
 public:
  void add(int part, double velocity, double time) {
    const std::size_t bin =
        velocity < 0.1
            ? 0
            : static_cast<std::size_t>(1.0 + std::floor(5.0 * (std::log10(velocity) + 1.0)));
    Parts &bins = content_[static_cast<std::size_t>(part)];
    if (bins.size() <= bin) bins.resize(bin + 1);
    bins[bin] += time;
  }
  Monotony result() {
    std::size_t bins = 1;
    for (const Parts &part : content_) bins = std::max(bins, part.size());
    for (Parts &part : content_) part.resize(bins);
    std::vector<double> edges = {0.0};
    for (std::size_t k = 0; k < bins; ++k)
      edges.push_back(std::pow(10.0, 0.2 * static_cast<double>(k) - 1.0));
    return monotony(std::move(edges), content_);
  }

 private:
  std::vector<Parts> content_ = std::vector<Parts>(run_parts);
};

}  // namespace

int RunParts::of(double time) const {
  if (!(time >= from && time <= to)) return -1;
  return std::min(run_parts - 1, static_cast<int>((time - from) / (to - from) * run_parts));
}

Measured ratio_of_parts(const std::vector<double> &above, const std::vector<double> &below) {
  const double all_above = total(above), all_below = total(below);
  return jackknife(above.size(), [&](std::size_t k) {
    const bool out = k < above.size();
    return (all_above - (out ? above[k] : 0.0)) / (all_below - (out ? below[k] : 0.0));
  });
}

Monotony monotony(std::vector<double> edges, const std::vector<std::vector<double>> &content) {
  Monotony found;
  found.edges = std::move(edges);
  const std::size_t bins = found.edges.size() - 1, parts = content.size();
  Parts of_part;
  for (const Parts &part : content) of_part.push_back(total(part));
  std::vector<Parts> of_bin(bins, Parts(parts));
  std::vector<std::size_t> usable;
  for (std::size_t b = 0; b < bins; ++b) {
    std::size_t filled = 0;
    for (std::size_t k = 0; k < parts; ++k) {
      of_bin[b][k] = content[k][b];
      filled += content[k][b] > 0.0;
    }
    const double width = found.edges[b + 1] - found.edges[b];
    const Measured share = ratio_of_parts(of_bin[b], of_part);
    found.density.push_back({share.value / width, share.error / width});
    if (2 * filled >= parts) usable.push_back(b);
  }
  const auto pairs = static_cast<double>(usable.size() * (usable.size() - 1) / 2);
  if (usable.size() < 2) return found;
  const double least = gsl_cdf_tdist_Qinv(0.05 / pairs, static_cast<double>(parts) - 1.0);
  const auto centre = [&](std::size_t b) { return 0.5 * (found.edges[b] + found.edges[b + 1]); };
  for (std::size_t j = 1; j < usable.size(); ++j)
    for (std::size_t i = 0; i < j; ++i) {
      const std::size_t low = usable[i], high = usable[j];
      const double width =
          (found.edges[low + 1] - found.edges[low]) / (found.edges[high + 1] - found.edges[high]);
      const double all_low = total(of_bin[low]), all_high = total(of_bin[high]);
      const Measured ratio = jackknife(parts, [&](std::size_t k) {
        const bool out = k < parts;
        return std::log(width * (all_high - (out ? of_bin[high][k] : 0.0)) /
                        (all_low - (out ? of_bin[low][k] : 0.0)));
      });
      const bool beyond = ratio.value > least * ratio.error;
      const double rise = std::exp(ratio.value);
      // A significant rise takes precedence over any that is not.
      if (found.rises && !beyond) continue;
      if (beyond == found.rises && !std::isnan(found.rise.value) && rise <= found.rise.value)
        continue;
      found.rises = beyond;
      found.rise = {rise, rise * ratio.error};
      found.rises_from = centre(low);
      found.rises_to = centre(high);
    }
  return found;
}

SlipStatements slip_statements(SlipHistoryReader &history, const std::vector<Event> &drops,
                               double least) {
  std::vector<Event> events;
  for (const Event &drop : drops)
    if (drop.size >= least) events.push_back(drop);
  if (events.size() < 2)
    throw std::runtime_error("slip between drops of PE: fewer than two drops of this size");
  const FaultGrid &grid = history.info().grid;
  const double driving = std::fabs(history.info().driving);
  const RunParts run{events.front().t_start, events.back().t_end};
  Parts within(run_parts), between(run_parts), time_within(run_parts), time_between(run_parts),
      rise(run_parts), work(run_parts);
  VelocityTimes all, single;
  double time_single = 0.0, backwards = 0.0, known = 0.0;
  std::size_t next = 0;  // index of the first event that ends after the record begins
  for (SlipRecord record; history.next(record);) {
    const double begin = grid.time(record.step_begin), end = grid.time(record.step_end);
    const int part = run.of(0.5 * (begin + end));
    if (!(end > begin) || part < 0) continue;
    const double time = end - begin;
    while (next < events.size() && events[next].t_end <= begin) ++next;
    double open = 0.0;
    for (std::size_t i = next; i < events.size() && events[i].t_start < end; ++i)
      open += std::min(end, events[i].t_end) - std::max(begin, events[i].t_start);
    const double share = std::min(1.0, open / time);
    const bool one = record.step_end - record.step_begin == grid.interval;
    double slip = 0.0, stress = 0.0;
    for (std::size_t b = 0; b < record.row.slip.size(); ++b) {
      const double velocity = static_cast<double>(record.row.slip[b]) / (time * driving);
      slip += static_cast<double>(record.row.slip[b]);
      stress += static_cast<double>(record.row.stress[b]);
      if (velocity < 0.0) {
        backwards += time;
        continue;
      }
      all.add(part, velocity, time);
      if (one) single.add(part, velocity, time);
    }
    const auto bins = static_cast<double>(grid.bins);
    const auto p = static_cast<std::size_t>(part);
    within[p] += share * slip / bins;
    between[p] += (1.0 - share) * slip / bins;
    time_within[p] += share * time;
    time_between[p] += (1.0 - share) * time;
    work[p] += (1.0 - share) * time * stress * grid.width * driving;
    known += time;
    if (one) time_single += time;
  }
  if (!(known > 0.0)) throw std::runtime_error("no slip history in the time of the drops of PE");
  for (std::size_t i = 1; i < events.size(); ++i) {
    const int part = run.of(0.5 * (events[i - 1].t_end + events[i].t_start));
    if (part >= 0)
      rise[static_cast<std::size_t>(part)] += events[i].pe_start - events[i - 1].pe_end;
  }
  SlipStatements found;
  found.time = known;
  found.single = time_single / known;
  found.backwards = backwards / (known * grid.bins);
  found.velocities = all.result();
  found.while_slipping = single.result();
  found.time_between = total(time_between) / known;
  Parts slip(run_parts), plates(run_parts), plates_always(run_parts);
  for (std::size_t k = 0; k < run_parts; ++k) {
    slip[k] = within[k] + between[k];
    plates[k] = driving * time_between[k];
    plates_always[k] = driving * (time_within[k] + time_between[k]);
  }
  found.recorded = ratio_of_parts(slip, plates_always);
  found.slip_between = ratio_of_parts(between, slip);
  found.rate_between = ratio_of_parts(between, plates);
  found.rise_over_work = ratio_of_parts(rise, work);
  const double sums[] = {total(within), total(time_within), total(between), total(time_between)};
  found.rate_within = jackknife(run_parts, [&](std::size_t k) {
    const bool out = k < run_parts;
    const auto left = [&](std::size_t n, const Parts &parts) {
      return sums[n] - (out ? parts[k] : 0.0);
    };
    return (left(0, within) / left(1, time_within)) / (left(2, between) / left(3, time_between));
  });
  return found;
}

Measured share_of_one_bin(const EventTable &ruptures) {
  double bin = 0.0;
  const std::string *const text = ruptures.info.find("slip_bin");
  if (!ruptures.info.rupture_length || !text || !text_io::parse(*text, bin) || !(bin > 0.0))
    throw std::runtime_error(ruptures.path +
                             ": no column rupture_length, or no slip_bin in the header, expected "
                             "a catalogue of ruptures");
  Extent starts;
  for (const Event &rupture : ruptures.details) starts.add(rupture.t_start);
  if (!(starts.hi > starts.lo))
    throw std::runtime_error(ruptures.path + ": fewer than two ruptures, expected more");
  const RunParts run{starts.lo, starts.hi};
  Parts short_ones(run_parts), all(run_parts);
  for (const Event &rupture : ruptures.details) {
    const auto part = static_cast<std::size_t>(run.of(rupture.t_start));
    all[part] += 1.0;
    short_ones[part] += rupture.rupture_length < 1.5 * bin;
  }
  return ratio_of_parts(short_ones, all);
}

RollOff roll_off(const EventTable &table, double least) {
  std::vector<double> sizes = column_from(table, least, &EventSummary::size);
  std::sort(sizes.begin(), sizes.end());
  RollOff found;
  found.free = fit_maximum_likelihood(sizes, least);
  found.exponential = fit_maximum_likelihood(sizes, least, 1.0);
  const PowerLawFit law = fit_power_law(sizes, least, std::numeric_limits<double>::infinity());
  if (!law.degenerate && !found.exponential.degenerate)
    found.gain = 2.0 * (found.exponential.log_likelihood - law.log_likelihood);
  return found;
}

}  // namespace LSM::postproc
