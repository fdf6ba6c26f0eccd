// SPDX-License-Identifier: GPL-2.0-or-later
/// \file slider_run.h
/// A run of the block-slider: stepping, event picking, catalogue, PE series, checkpoints.
#ifndef SLIDER_RUN_H
#define SLIDER_RUN_H

#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <limits>
#include <memory>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "lsm_catalogue.h"
#include "lsm_event_picker.h"
#include "lsm_pe_series.h"
#include "slider_chain.h"
#include "slider_kernels.h"
#include "slider_parameters.h"
#include "slider_ruptures.h"
#include "slider_scalar.h"
#include "slider_switching.h"

namespace Slider {

/// How the schemes printed, semi-implicit and verlet are run.
enum class Kernel { active, dense, scalar };
inline const char *to_string(Kernel kernel) {
  return kernel == Kernel::active ? "active" : kernel == Kernel::dense ? "dense" : "scalar";
}

/// What an event is: a drop of the PE of the whole chain (paper), or a connected set of sliding
/// blocks (ours, see slider_ruptures.h).
enum class Events { pe, ruptures };
inline const char *to_string(Events events) { return events == Events::pe ? "pe" : "ruptures"; }
inline bool from_string(const std::string &name, Events &events) {
  if (name != "pe" && name != "ruptures") return false;
  events = name == "pe" ? Events::pe : Events::ruptures;
  return true;
}

struct RunOptions {
  Parameters parameters;
  std::vector<double> mu;  ///< one per block
  std::int64_t steps = 0;
  Events events = Events::pe;
  LSM::PickerSettings picker;       ///< for ruptures, only the sizes that are written
  std::int64_t rupture_memory = 1;  ///< steps over which slips are connected, at least 1
  double warmup = 0.0;              ///< events that start before this time are not written
  Kernel kernel = Kernel::active;
  InstructionSet isa = InstructionSet::automatic;
  std::string catalogue;  ///< empty: none
  bool x_centroid = false, rupture_length = false;
  std::string series;  ///< empty: none
  bool series_binary = false;
  std::int64_t series_stride = 1;
  std::string checkpoint;  ///< empty: none
  std::int64_t checkpoint_interval = 0;
  bool resume = false;
  bool overwrite = false;  ///< replace files of an earlier run
  bool progress = false;
  std::vector<std::pair<std::string, std::string>> header;  ///< everything that shapes the result
  const std::atomic<int> *stop = nullptr;                   ///< a signal number ends the run
};

struct RunResult {
  std::int64_t steps = 0;          ///< reached
  std::int64_t first_step = 0;     ///< step the run started from
  std::int64_t events = 0;         ///< in the catalogue
  std::int64_t before_warmup = 0;  ///< picked but too early
  std::int64_t dropped_nonpositive = 0, dropped_small = 0;
  std::int64_t moved = 0;            ///< block-steps with motion
  std::int64_t jumped = 0;           ///< quiet steps jumped over
  double pe = 0.0, pe_direct = 0.0;  ///< by work, and summed over all springs, at the end
  double mean_slip = 0.0, largest_event = 0.0, seconds = 0.0;
  int interrupted = 0;  ///< signal number, or 0
};

/// \throws std::invalid_argument with one line for ruptures where nobody tells which block slides.
inline void check_events(const RunOptions &o) {
  if (o.events != Events::ruptures) return;
  if (o.parameters.scheme == Scheme::rk4 || o.parameters.scheme == Scheme::reference)
    throw std::invalid_argument(std::string("--events = ruptures with --scheme ") +
                                to_string(o.parameters.scheme) +
                                ", expected the scheme printed, semi-implicit or verlet");
  if (o.kernel == Kernel::scalar)
    throw std::invalid_argument(
        "--events = ruptures with --kernel scalar, expected the kernel active or dense");
}

/// Finds out early whether an output can be written; an empty path is none.
/// \throws std::runtime_error naming file and option
inline void probe(const std::string &path, const std::string &option) {
  if (path.empty()) return;
  const std::string trial = path + ".new";
  std::FILE *file = std::fopen(trial.c_str(), "wb");
  if (!file)
    throw std::runtime_error(path + ": " + std::strerror(errno) +
                             ", expected a writable file for " + option);
  std::fclose(file);
  std::remove(trial.c_str());
}

/// A run that starts afresh replaces no file that holds something, unless asked.
/// \throws std::runtime_error naming file and options
inline void check_replaced(const RunOptions &o) {
  if (o.resume || o.overwrite) return;
  const std::pair<const std::string &, const char *> outputs[] = {
      {o.catalogue, "--catalogue"}, {o.series, "--pe-series"}, {o.checkpoint, "--checkpoint"}};
  for (const auto &[path, option] : outputs)
    if (LSM::text_io::holds_data(path))
      throw std::runtime_error(path + ": exists, expected a new file for " + option +
                               "; --overwrite replaces it, --resume goes on with it");
}

namespace detail {

struct RunState {
  ChainState chain;
  LSM::PickerState picker;
  std::int64_t events = 0, before_warmup = 0;
  double slip_start = 0.0, largest = 0.0;
  std::vector<double> u_start;
  RuptureState ruptures;
  bool with_ruptures = false;  ///< otherwise a checkpoint has none
  bool with_rest = false;      ///< as with the ruptures
};

class ByteWriter {
 public:
  template <class T>
  void put(const T &value) {
    static_assert(std::is_trivially_copyable<T>::value, "plain data only");
    const char *p = reinterpret_cast<const char *>(&value);
    bytes.append(p, sizeof value);
  }
  template <class T>
  void put(const std::vector<T> &a) {
    put(static_cast<std::uint64_t>(a.size()));
    bytes.append(reinterpret_cast<const char *>(a.data()), a.size() * sizeof(T));
  }
  void put(const std::string &a) {
    put(static_cast<std::uint64_t>(a.size()));
    bytes += a;
  }
  std::string bytes;
};

class ByteReader {
 public:
  explicit ByteReader(const std::string &bytes) : bytes_(bytes) {}
  template <class T>
  void get(T &value) {
    std::memcpy(&value, take(sizeof value), sizeof value);
  }
  template <class T>
  void get(std::vector<T> &a) {
    static_assert(std::is_trivially_copyable<T>::value, "plain data only");
    a.resize(count(sizeof(T)));
    const std::size_t size = a.size() * sizeof(T);
    const char *from = take(size);
    if (size) std::memcpy(a.data(), from, size);
  }
  void get(std::string &a) {
    const std::size_t size = count(1);
    a.assign(take(size), size);
  }
  bool at_end() const { return position_ == bytes_.size(); }

 private:
  std::size_t count(std::size_t item) {
    std::uint64_t n = 0;
    get(n);
    if (n > bytes_.size() / item) throw std::runtime_error("truncated");
    return static_cast<std::size_t>(n);
  }
  const char *take(std::size_t size) {
    if (size > bytes_.size() - position_) throw std::runtime_error("truncated");
    const char *p = bytes_.data() + position_;
    position_ += size;
    return p;
  }
  const std::string &bytes_;
  std::size_t position_ = 0;
};

inline std::uint64_t checksum(const std::string &bytes) {
  std::uint64_t h = 14695981039346656037ULL;  // FNV-1a
  for (const char c : bytes) h = (h ^ static_cast<unsigned char>(c)) * 1099511628211ULL;
  return h;
}

inline std::string fingerprint(const std::vector<std::pair<std::string, std::string>> &header) {
  std::string text;
  for (const auto &[key, value] : header) text += key + " = " + value + "\n";
  return text;
}

constexpr char checkpoint_magic[] = "slider-checkpoint-1\n";

template <class Archive, class State>
void archive(Archive &&each, State &s) {
  each(s.chain.step);
  each(s.chain.slip_sum);
  each(s.chain.slip_compensation);
  each(s.chain.pe_sum);
  each(s.chain.pe_compensation);
  each(s.chain.quiet_since);
  each(s.chain.pe_anchor);
  each(s.chain.loading_anchor);
  each(s.chain.moved);
  each(s.chain.dpe);
  each(s.chain.u);
  each(s.chain.v);
  each(s.picker);
  each(s.events);
  each(s.before_warmup);
  each(s.slip_start);
  each(s.largest);
  each(s.u_start);
  if (s.with_ruptures) {
    each(s.ruptures.open);
    each(s.ruptures.recent);
  }
  if (s.with_rest) each(s.chain.rest);
}

/// Replaces the file in one go, so that there is a whole checkpoint at any moment.
inline void write_checkpoint(const std::string &path, const std::string &print,
                             const RunState &state) {
  ByteWriter out;
  out.put(print);
  archive([&out](const auto &x) { out.put(x); }, state);
  const std::uint64_t sum = checksum(out.bytes);
  const std::string written = path + ".new";
  std::FILE *file = std::fopen(written.c_str(), "wb");
  bool good = file != nullptr;
  if (good) {
    good = std::fputs(checkpoint_magic, file) >= 0 && std::fwrite(&sum, sizeof sum, 1, file) == 1 &&
           std::fwrite(out.bytes.data(), 1, out.bytes.size(), file) == out.bytes.size() &&
           std::fflush(file) == 0 && fsync(fileno(file)) == 0;
    good = (std::fclose(file) == 0) && good;
  }
  if (!good || std::rename(written.c_str(), path.c_str()) != 0) {
    const std::string why = std::strerror(errno);
    std::remove(written.c_str());
    throw std::runtime_error(path + ": cannot write the checkpoint: " + why);
  }
}

inline RunState read_checkpoint(const std::string &path, const std::string &print,
                                bool with_ruptures, bool with_rest) {
  std::ifstream in(path, std::ios::binary);
  if (!in)
    throw std::runtime_error(path + ": cannot be read, expected a checkpoint to resume from");
  std::string all((std::istreambuf_iterator<char>(in)), std::istreambuf_iterator<char>());
  const std::size_t magic = sizeof checkpoint_magic - 1;
  if (all.compare(0, magic, checkpoint_magic) != 0)
    throw std::runtime_error(path + ": not a checkpoint of slider_cli, version 1");
  const std::runtime_error damaged(path + ": damaged checkpoint, expected a whole file");
  std::uint64_t sum = 0;
  if (all.size() < magic + sizeof sum) throw damaged;
  std::memcpy(&sum, all.data() + magic, sizeof sum);
  all.erase(0, magic + sizeof sum);
  if (checksum(all) != sum) throw damaged;
  std::string found;
  RunState state;
  state.with_ruptures = with_ruptures;
  state.with_rest = with_rest;
  try {
    ByteReader reader(all);
    reader.get(found);
    if (found == print) {
      archive([&reader](auto &x) { reader.get(x); }, state);
      if (!reader.at_end()) throw damaged;
    }
  } catch (const std::runtime_error &) {
    throw damaged;
  }
  if (found != print) {
    // Name the first line that differs.
    std::size_t a = 0, b = 0;
    for (;;) {
      const std::string x = found.substr(a, found.find('\n', a) - a);
      const std::string y = print.substr(b, print.find('\n', b) - b);
      if (x != y)
        throw std::runtime_error(path + ": cannot resume: checkpoint has '" + x + "', expected '" +
                                 y + "'");
      a += x.size() + 1;
      b += y.size() + 1;
    }
  }
  return state;
}

template <Events events, class C>
RunResult run(const RunOptions &o, C &chain) {
  constexpr bool ruptures = events == Events::ruptures;
  using Clock = std::chrono::steady_clock;
  const Clock::time_point begin = Clock::now();
  const double dt = o.parameters.dt;
  LSM::EventPicker picker(o.picker);
  // The sizes dropped are counted where the picker does, for checkpoints.
  LSM::PickerState counts;
  RuptureTracker tracker(ruptures ? o.parameters.blocks : 1, o.rupture_memory, o.x_centroid);
  RunState state;
  state.with_ruptures = ruptures;
  state.with_rest = o.parameters.friction.needs_rest();
  RunResult result;
  // The straightforward loop keeps none of the sums that the others go on from.
  const std::string print =
      fingerprint(o.header) +
      (o.kernel == Kernel::scalar ? "kernel = scalar\n" : "kernel = active or dense\n");

  LSM::CatalogueInfo info;
  info.model = "block-slider";
  info.parameters = o.header;
  info.slip_moment = true;
  info.x_centroid = o.x_centroid;
  info.rupture_length = o.rupture_length;
  const bool snapshots = o.x_centroid || o.rupture_length;
  LSM::PeSeriesInfo series_info;
  series_info.model = "block-slider";
  series_info.dt = dt;
  series_info.stride = o.series_stride;
  series_info.parameters = o.header;
  // The series has keys of its own for these.
  auto &keys = series_info.parameters;
  keys.erase(std::remove_if(keys.begin(), keys.end(),
                            [](const auto &x) { return x.first == "dt" || x.first == "stride"; }),
             keys.end());

  // Nothing is written if one of the outputs cannot be.
  check_replaced(o);
  probe(o.series, "--pe-series");
  probe(o.checkpoint, "--checkpoint");
  LSM::CatalogueWriter catalogue;
  LSM::PeSeriesWriter series;
  if (o.resume) {
    state = read_checkpoint(o.checkpoint, print, ruptures, state.with_rest);
    chain.set_state(state.chain);
    picker.set_state(state.picker);
    counts = state.picker;
    if (ruptures) tracker.set_state(state.ruptures, chain.step());
  }
  if (o.resume) {
    // An event that ended with the checkpoint's last sample is found by the sample after it, a
    // rupture when its memory is over.
    const std::int64_t late = ruptures ? o.rupture_memory : 1;
    if (!o.catalogue.empty())
      catalogue.resume(o.catalogue, info, chain.step() - late, {}, state.events);
    if (!o.series.empty()) series.resume(o.series, series_info, o.series_binary, chain.step());
  } else {
    if (!o.catalogue.empty()) catalogue.create(o.catalogue, info);
    if (!o.series.empty()) {
      series.create(o.series, series_info, o.series_binary);
      series.write(0, chain.pe());
    }
    LSM::Event none;
    picker.push_change(0, 0.0, chain.pe(), 0.0, none);
  }
  result.first_step = chain.step();

  auto save = [&] {
    if (series.is_open()) series.flush();
    state.chain = chain.state();
    state.picker = ruptures ? counts : picker.state();
    if (ruptures) state.ruptures = tracker.state();
    write_checkpoint(o.checkpoint, print, state);
  };
  const bool checkpoints = !o.checkpoint.empty();
  const std::int64_t interval = o.checkpoint_interval;
  auto next_multiple = [&](std::int64_t every) { return (chain.step() / every + 1) * every; };
  // After so many steps the picker has forgotten what it was started with, to the last digit.
  const double lambda = o.picker.lambda;
  const double memory = o.picker.reading == LSM::PickerReading::exponential
                            ? 45.0 / std::max(1.0 - lambda, 1e-15)
                            : 100.0;
  const std::int64_t replay = static_cast<std::int64_t>(std::min(memory, 1e15)) + 1;

  auto finish_event = [&](LSM::Event &event) {
    if (event.t_start < o.warmup) {
      ++state.before_warmup;
      return;
    }
    event.id = ++state.events;
    event.slip_moment = chain.slip_sum() - state.slip_start;
    if (snapshots) {
      const std::vector<double> u = chain.displacements();
      const double circle = 2.0 * 3.14159265358979323846 / static_cast<double>(u.size());
      double c = 0.0, s = 0.0;
      for (std::size_t i = 0; i < u.size(); ++i) {
        const double slip = u[i] - state.u_start[i];
        if (slip > 0.0) event.rupture_length += 1.0;
        c += slip * std::cos(circle * static_cast<double>(i));
        s += slip * std::sin(circle * static_cast<double>(i));
      }
      event.x_centroid = (c == 0.0 && s == 0.0) ? 0.0 : std::atan2(s, c) / circle;
      if (event.x_centroid < 0.0) event.x_centroid += static_cast<double>(u.size());
    }
    if (event.size > state.largest) state.largest = event.size;
    if (catalogue.is_open()) catalogue.write(event);
  };

  auto finish_rupture = [&](const Rupture &rupture) {
    LSM::Event e = tracker.event(rupture, dt);
    if (!(e.size > 0.0)) {
      if (!o.picker.keep_nonpositive) {
        ++counts.dropped_nonpositive;
        return;
      }
    } else if (e.size < o.picker.min_size) {
      ++counts.dropped_small;
      return;
    }
    if (e.t_start < o.warmup) {
      ++state.before_warmup;
      return;
    }
    e.id = ++state.events;
    state.largest = std::max(state.largest, e.size);
    if (catalogue.is_open()) catalogue.write(e);
  };
  // One step, or several in which nothing slides.
  [[maybe_unused]] auto advance_ruptures = [&]([[maybe_unused]] std::int64_t limit) {
    if constexpr (ruptures) {
      if (tracker.idle() && chain.quiet_until() > chain.step() + 1) {
        std::int64_t to = std::min(chain.quiet_until(), limit);
        if (series.is_open()) to = std::min(to, next_multiple(o.series_stride));
        result.jumped += to - chain.step() - 1;
        chain.jump(to);
        return;
      }
      chain.advance(tracker);
      if (!std::isfinite(chain.dpe()) || !std::isfinite(chain.pe()))
        throw std::runtime_error("potential energy at step " + std::to_string(chain.step()) +
                                 " is not a finite number");
      tracker.end_step(chain.pe(), finish_rupture);
    }
  };

  Clock::time_point reported = begin;
  LSM::Event event;
  const std::int64_t look = std::max<std::int64_t>(16, 200000 / (o.parameters.blocks + 100));
  while (chain.step() < o.steps) {
    std::int64_t limit = o.steps;
    if (checkpoints && interval > 0) limit = std::min(limit, next_multiple(interval));
    const std::int64_t pause = std::min(limit, chain.step() + look);
    bool in_event = picker.in_event();
    while (chain.step() < pause) {
      if constexpr (ruptures) {
        advance_ruptures(limit);
        if (series.is_open() && chain.step() % o.series_stride == 0)
          series.write(chain.step(), chain.pe());
        continue;
      }
      if (!in_event && chain.quiet_until() > chain.step() + replay) {
        // Nothing slips: the plate alone changes PE, and as long as it raises PE no event can
        // commence. With an event open the steps are taken one by one.
        std::int64_t to = std::min(chain.quiet_until(), limit);
        if (series.is_open()) to = std::min(to, next_multiple(o.series_stride) - 1);
        to -= replay;
        if (to > chain.step() && picker.rate() >= 0.0 && chain.quiet_change(chain.step()) > 0.0) {
          LSM::PickerState s = picker.state();
          result.jumped += to - chain.step();
          s.samples += to - chain.step();
          chain.jump(to);
          s.step = to;
          s.time = dt * static_cast<double>(to);
          s.pe = chain.pe();
          s.rate = chain.dpe();
          if (o.picker.reading == LSM::PickerReading::literal)
            s.rate /= 1.0 + lambda * static_cast<double>(s.samples - 2);
          picker.set_state(s);
          break;
        }
      }
      chain.advance();
      const std::int64_t n = chain.step();
      const bool report =
          picker.push_change(n, dt * static_cast<double>(n), chain.pe(), chain.dpe(), event);
      if (picker.in_event() != in_event) {
        in_event = !in_event;
        // Slip is taken one sample late at both ends, which is less than a time step's worth.
        if (in_event) {
          state.slip_start = chain.slip_sum();
          if (snapshots) state.u_start = chain.displacements();
        }
        if (report) finish_event(event);
      }
      if (series.is_open() && n % o.series_stride == 0) series.write(n, chain.pe());
    }
    if (checkpoints && interval > 0 && chain.step() % interval == 0 && chain.step() < o.steps)
      save();
    const int stopped_by = o.stop ? o.stop->load(std::memory_order_relaxed) : 0;
    if (stopped_by != 0 && chain.step() < o.steps) {
      result.interrupted = stopped_by;
      if (checkpoints) save();
      break;
    }
    if (o.progress && Clock::now() - reported > std::chrono::seconds(1)) {
      reported = Clock::now();
      std::fprintf(stderr, "step %lld of %lld, %lld events\n", static_cast<long long>(chain.step()),
                   static_cast<long long>(o.steps), static_cast<long long>(state.events));
    }
  }
  if (checkpoints && result.interrupted == 0) save();
  if (series.is_open()) series.close();
  if (catalogue.is_open()) catalogue.close();
  result.steps = chain.step();
  result.events = state.events;
  result.before_warmup = state.before_warmup;
  const LSM::PickerState &counted = ruptures ? counts : picker.state();
  result.dropped_nonpositive = counted.dropped_nonpositive;
  result.dropped_small = counted.dropped_small;
  result.moved = chain.moved();
  result.pe = chain.pe();
  result.pe_direct = direct_energy(o.parameters, chain.displacements(),
                                   o.parameters.velocity * dt * static_cast<double>(chain.step()));
  result.mean_slip = chain.slip_sum() / o.parameters.blocks;
  result.largest_event = state.largest;
  result.seconds = std::chrono::duration<double>(Clock::now() - begin).count();
  return result;
}

}  // namespace detail

/// Runs, or goes on with, one chain. \throws std::exception with one line on bad input or output.
inline RunResult run(const RunOptions &o) {
  const Parameters &p = o.parameters;
  check_events(o);
  if (p.scheme == Scheme::rk4 || p.scheme == Scheme::reference) {
    SwitchingChain chain(p, o.mu);
    return detail::run<Events::pe>(o, chain);
  }
  if (o.kernel == Kernel::scalar) {
    ScalarChain chain(p, o.mu);
    return detail::run<Events::pe>(o, chain);
  }
  Chain chain(p, o.mu, o.kernel == Kernel::dense, o.isa);
  return o.events == Events::ruptures ? detail::run<Events::ruptures>(o, chain)
                                      : detail::run<Events::pe>(o, chain);
}

}  // namespace Slider

#endif
