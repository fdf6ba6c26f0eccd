// SPDX-License-Identifier: GPL-2.0-or-later
// Fuzz target of the readers of catalogues, PE series and slip histories, strict and lenient.
// Whatever the bytes, a reader returns what its description promises or throws a FileError; it
// never crashes.
//
// As a program it mutates files that it has written itself, for a bounded time:
//   fuzz_readers [SECONDS [SEED]]        (default 2 1)
// The entry LLVMFuzzerTestOneInput serves libFuzzer: clang++ -std=c++17 -DLSM_LIBFUZZER
// -fsanitize=fuzzer,address,undefined -I lammps-pkg/core tests/postproc/fuzz_readers.cpp
#include <chrono>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <unistd.h>

#include "files/catalogue.h"
#include "events/event_picker.h"
#include "files/pe_series.h"
#include "numerics/random.h"
#include "files/slip_history.h"

namespace {

namespace fs = std::filesystem;

/// A temporary folder, in memory if possible, as thousands of files are written; removed at the
/// end.
struct Folder {
  Folder() {
    const fs::path memory = "/dev/shm";
    const bool fast = access(memory.c_str(), W_OK) == 0;
    std::string name = ((fast ? memory : fs::temp_directory_path()) / "lsm-fuzz-XXXXXX").string();
    if (!mkdtemp(name.data())) std::abort();
    path = name;
  }
  ~Folder() {
    std::error_code ignored;
    fs::remove_all(path, ignored);
  }
  fs::path path;
};

const Folder &folder() {
  static const Folder one;
  return one;
}

struct Counts {
  std::int64_t inputs = 0, accepted = 0, repaired = 0, refused = 0;
};
Counts catalogues, series, histories;

void require(bool good, const char *what) {
  if (good) return;
  std::fprintf(stderr, "fuzz_readers: broken promise: %s\n", what);
  std::abort();
}

struct Outcome {
  bool refused = false;
  std::int64_t repairs = 0;
  std::string message;
};

bool same(const LSM::EventRow &a, const LSM::EventRow &b) {
  return a.id == b.id && a.t_start == b.t_start && a.t_end == b.t_end &&
         a.step_start == b.step_start && a.step_end == b.step_end && a.size == b.size &&
         a.pe_start == b.pe_start && a.pe_end == b.pe_end && a.more == b.more;
}

Outcome read_catalogue(const std::string &path, bool lenient, std::vector<LSM::EventRow> &events,
                       std::vector<std::string_view> &columns) {
  Outcome outcome;
  try {
    LSM::CatalogueReader reader(LSM::files::open_plain(path), lenient);
    require(reader.info().model == "lsm" || reader.info().model == "block-slider", "known model");
    columns = reader.info().columns;
    LSM::EventRow event;
    while (reader.next(event)) {
      for (const LSM::CatalogueColumn &column : LSM::columns_of(reader.info()))
        require(std::isfinite(column.of(event)), "finite numbers");
      require(event.t_start <= event.t_end, "an event ends after its start");
      require(event.step_start <= event.step_end, "an event ends after its first step");
      if (!events.empty()) {
        require(events.back().id < event.id, "increasing identifiers");
        require(events.back().t_end <= event.t_start, "events in order of time");
        require(events.back().step_end <= event.step_start, "events in order of steps");
      }
      events.push_back(event);
    }
    outcome.repairs = reader.skipped();
    require(reader.repairs().empty() == (reader.skipped() == 0), "repairs are stated");
    require(reader.first_problem().empty() == (reader.skipped() == 0), "the first one is named");
  } catch (const LSM::FileError &error) {
    outcome.refused = true;
    outcome.message = error.what();
    require(outcome.message.rfind(path, 0) == 0, "a message begins with the file");
    require(outcome.message.find('\n') == std::string::npos, "a message is one line");
  }
  return outcome;
}

void try_catalogue(const std::string &path) {
  std::vector<LSM::EventRow> strict, lenient;
  LSM::CatalogueInfo info;
  info.model = "lsm";
  const Outcome a = read_catalogue(path, false, strict, info.columns);
  const Outcome b = read_catalogue(path, true, lenient, info.columns);
  require(a.repairs == 0, "strict repairs nothing");
  require(!b.refused || a.refused, "lenient accepts what strict accepts");
  if (!a.refused) {
    require(b.repairs == 0 && strict.size() == lenient.size(), "nothing to repair");
    for (std::size_t i = 0; i < strict.size(); ++i)
      require(same(strict[i], lenient[i]), "the same events");
  } else if (!b.refused) {
    require(b.repairs > 0, "a repair for what strict refuses");
  }
  ++catalogues.inputs;
  ++(!a.refused ? catalogues.accepted : !b.refused ? catalogues.repaired : catalogues.refused);
  if (a.refused) return;
  // What has been read can be written and read back.
  const std::string copy = (folder().path / "copy").string();
  LSM::CatalogueWriter writer;
  writer.create(copy, info);
  for (const LSM::EventRow &event : strict) writer.write(event);
  writer.close();
  std::vector<LSM::EventRow> again;
  require(
      !read_catalogue(copy, false, again, info.columns).refused && again.size() == strict.size(),
      "a copy can be read");
  for (std::size_t i = 0; i < strict.size(); ++i) require(same(strict[i], again[i]), "a true copy");
}

void try_history(const std::string &path) {
  std::int64_t counts[2] = {0, 0};
  bool refused[2] = {false, false}, torn = false;
  for (const bool lenient : {false, true}) {
    try {
      LSM::SlipHistoryReader reader(LSM::files::open_plain(path), lenient);
      LSM::SlipRecord record;
      std::int64_t last = 0;
      while (reader.next(record)) {
        require(std::isfinite(record.pe), "finite PE");
        const LSM::FaultGrid &grid = reader.info().grid;
        const auto cells = static_cast<std::size_t>(grid.cells());
        for (const auto *values : {&record.row.slip, &record.row.work, &record.row.stress}) {
          const bool scalar = values == &record.row.work;
          require(values->size() == (scalar ? 1 : grid.components()) * cells, "all cells");
          for (const float x : *values) require(std::isfinite(x), "finite numbers");
        }
        require(counts[lenient] == 0 ? record.step_begin == record.step_end
                                     : record.step_begin == last && record.step_end > last,
                "records without gaps");
        last = record.step_end;
        ++counts[lenient];
      }
      torn = torn || reader.torn();
    } catch (const LSM::FileError &error) {
      refused[lenient] = true;
      const std::string message = error.what();
      require(message.rfind(path, 0) == 0, "a message begins with the file");
      require(message.find('\n') == std::string::npos, "a message is one line");
    }
  }
  require(!refused[true] || refused[false], "lenient accepts what strict accepts");
  require(refused[false] || (counts[0] == counts[1] && !torn), "nothing to repair");
  require(!refused[false] || refused[true] || torn, "a repair for what strict refuses");
  ++histories.inputs;
  ++(!refused[false]  ? histories.accepted
     : !refused[true] ? histories.repaired
                      : histories.refused);
}

struct Sample {
  std::int64_t step;
  double time, pe;
  bool operator==(const Sample &o) const { return step == o.step && time == o.time && pe == o.pe; }
};

Outcome read_series(const std::string &path, bool lenient, std::vector<Sample> &samples) {
  Outcome outcome;
  try {
    LSM::PeSeriesReader reader(LSM::files::open_plain(path), lenient);
    require(reader.info().dt > 0.0 && reader.info().stride >= 1, "sane header");
    LSM::EventPicker picker{LSM::PickerSettings()};
    LSM::Event event;
    Sample s{};
    bool picking = true;
    while (reader.next(s.step, s.time, s.pe)) {
      require(std::isfinite(s.time) && std::isfinite(s.pe), "finite numbers");
      if (!samples.empty()) {
        require(samples.back().step < s.step, "increasing steps");
        require(samples.back().time <= s.time, "increasing times");
        // A picker may refuse only a change that is too large for a double.
        picking = picking && std::isfinite(s.pe - samples.back().pe);
      }
      if (picking) picker.push(s.step, s.time, s.pe, event);
      samples.push_back(s);
    }
    outcome.repairs = reader.torn() ? 1 : 0;
  } catch (const LSM::FileError &error) {
    outcome.refused = true;
    outcome.message = error.what();
    require(outcome.message.rfind(path, 0) == 0, "a message begins with the file");
    require(outcome.message.find('\n') == std::string::npos, "a message is one line");
  }
  return outcome;
}

void try_series(const std::string &path) {
  std::vector<Sample> strict, lenient;
  const Outcome a = read_series(path, false, strict);
  const Outcome b = read_series(path, true, lenient);
  require(!b.refused || a.refused, "lenient accepts what strict accepts");
  if (!a.refused)
    require(a.repairs == 0 && b.repairs == 0 && strict == lenient, "nothing to repair");
  else
    require(b.refused || b.repairs > 0, "only a truncated last sample is repaired");
  ++series.inputs;
  ++(!a.refused ? series.accepted : !b.refused ? series.repaired : series.refused);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t *data, std::size_t size) {
  const std::string path = (folder().path / "input").string();
  std::ofstream(path, std::ios::binary)
      .write(reinterpret_cast<const char *>(data), static_cast<std::streamsize>(size));
  try_catalogue(path);
  try_series(path);
  try_history(path);
  return 0;
}

#ifndef LSM_LIBFUZZER
namespace {

std::string slurp(const std::string &path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
}

/// Small files that look like those of the programs.
std::vector<std::string> seeds() {
  std::vector<std::string> out;
  const std::string path = (folder().path / "seed").string();
  for (const auto &[columns, plane] : {std::pair{false, false}, {true, false}, {true, true}}) {
    LSM::CatalogueInfo info;
    info.model = columns ? "lsm" : "block-slider";
    info.parameters = {{"dt", "0.03"}, {"length", "120"}, {"picker", "exponential"}};
    if (columns) LSM::add_names(info.columns, LSM::columns_of_ruptures);
    if (plane) LSM::add_names(info.columns, LSM::columns_of_planes);
    LSM::CatalogueWriter writer;
    writer.create(path, info);
    for (int i = 0; i < 8; ++i) {
      LSM::PlaneRupture event;
      event.id = i + 1;
      event.step_start = 100 * i;
      event.step_end = event.step_start + 10 * (i % 4);
      event.t_start = 0.03 * static_cast<double>(event.step_start);
      event.t_end = 0.03 * static_cast<double>(event.step_end);
      event.size = std::pow(10.0, -i);
      event.pe_start = 1.5;
      event.pe_end = event.pe_start - event.size;
      event.slip_moment = 0.25 * i;
      writer.write(event);
    }
    writer.close();
    out.push_back(slurp(path));
  }
  LSM::PeSeriesInfo info;
  info.model = "lsm";
  info.dt = 0.03;
  info.step0 = 20;
  info.time0 = 0.6;
  info.parameters = {{"lambda", "0.99"}};
  LSM::PeSeriesWriter writer;
  writer.create(path, info);
  for (int i = 0; i < 12; ++i) writer.write(20 + i, 0.14 + 1e-3 * (i % 5));
  writer.close();
  out.push_back(slurp(path));
  return out;
}

/// A small slip history as compute lsm/events writes it, of a line or a plane.
std::string history_seed(bool plane) {
  const std::string path = (folder().path / "seed").string();
  LSM::SlipHistoryInfo info;
  info.grid.bins = 2;
  info.grid.interval = 10;
  info.grid.dt = 0.06;
  info.quiet = 3;
  info.grid.plane = plane;
  info.grid.rows = plane ? 2 : 1;
  LSM::SlipHistoryWriter writer;
  LSM::FaultRow row(info.grid);
  row.stress[0] = 0.5F;
  writer.create(path, info, 0, 1.0, row.stress);
  for (int n = 1; n <= 9; ++n) {
    row.slip[0] = 0.25F;
    writer.add(10 * n, 1.0 - 0.01 * n, row, n > 3 && n < 7);
  }
  writer.close();
  return slurp(path);
}

class Mutator {
 public:
  explicit Mutator(std::uint64_t seed) : random_(seed) {}

  std::size_t below(std::size_t n) { return n == 0 ? 0 : random_.next() % n; }

  void mutate(std::string &text, const std::vector<std::string> &others) {
    static const char *const tokens[] = {"nan",
                                         "inf",
                                         "-inf",
                                         "1e999",
                                         "1e-999",
                                         "-",
                                         ",",
                                         ",,",
                                         "\n",
                                         "\r\n",
                                         "\n\n",
                                         "#",
                                         "# ",
                                         " = ",
                                         "=",
                                         "0",
                                         "-1",
                                         "9223372036854775807",
                                         "-9223372036854775808",
                                         "1e308",
                                         "-1e308",
                                         "# model = lsm\n",
                                         "# dt = 0\n",
                                         "slip_moment",
                                         ",slip_moment",
                                         "# lsm-catalogue 2",
                                         "lsm-pe-series-1\n",
                                         "\xff\xff\xff\xff\xff\xff\xff\xff"};
    const std::size_t at = below(text.size() + 1);
    switch (below(9)) {
      case 0:
        if (!text.empty()) text[below(text.size())] ^= static_cast<char>(1 << below(8));
        break;
      case 1:
        if (!text.empty()) text[below(text.size())] = static_cast<char>(below(256));
        break;
      case 2:
        text.erase(at, below(below(2) ? 4 : 200));
        break;
      case 3:
        text.insert(at, tokens[below(std::size(tokens))]);
        break;
      case 4:
        text.resize(at);
        break;
      case 5:
        text.insert(at, text.substr(below(text.size() + 1), below(200)));
        break;
      case 6: {
        const std::string &other = others[below(others.size())];
        text = text.substr(0, at) + other.substr(below(other.size() + 1));
        break;
      }
      case 7: {  // replacing a digit by a digit keeps the form and changes the order
        const std::size_t digit = text.find_first_of("0123456789", at);
        if (digit != std::string::npos) text[digit] = static_cast<char>('0' + below(10));
        break;
      }
      default: {  // repeats or moves a line
        const std::size_t begin = text.rfind('\n', at) + 1, end = text.find('\n', begin);
        if (end == std::string::npos) break;
        const std::string line = text.substr(begin, end + 1 - begin);
        if (below(2)) text.erase(begin, line.size());
        const std::size_t to = text.find('\n', below(text.size() + 1));
        if (to != std::string::npos) text.insert(to + 1, line);
      }
    }
  }

 private:
  LSM::Random random_;
};

void show(const char *name, const Counts &c) {
  std::printf("%s: %lld inputs, %lld accepted, %lld repaired, %lld refused\n", name,
              static_cast<long long>(c.inputs), static_cast<long long>(c.accepted),
              static_cast<long long>(c.repaired), static_cast<long long>(c.refused));
}

}  // namespace

int main(int argc, char **argv) {
  const double seconds = argc > 1 ? std::atof(argv[1]) : 2.0;
  const std::uint64_t seed = argc > 2 ? std::strtoull(argv[2], nullptr, 10) : 1;
  std::printf("seed %llu\n", static_cast<unsigned long long>(seed));
  std::vector<std::string> files = seeds();
  for (const bool plane : {false, true}) files.push_back(history_seed(plane));
  Mutator mutator(seed);
  const auto run = [](const std::string &text) {
    LLVMFuzzerTestOneInput(reinterpret_cast<const std::uint8_t *>(text.data()), text.size());
  };
  for (const std::string &file : files) run(file);
  const auto begin = std::chrono::steady_clock::now();
  // The first inputs, which reach all outcomes, are run even on a slow machine.
  for (int i = 0; i < 5000 ||
                  std::chrono::steady_clock::now() - begin < std::chrono::duration<double>(seconds);
       ++i) {
    std::string text = files[mutator.below(files.size())];
    for (std::size_t times = 1 + mutator.below(5); times > 0; --times) mutator.mutate(text, files);
    run(text);
  }
  show("catalogues", catalogues);
  show("PE series", series);
  show("slip histories", histories);
  for (const Counts *c : {&catalogues, &series, &histories}) {
    if (c->accepted > 10 && c->repaired > 10 && c->refused > 10) continue;
    std::fprintf(stderr,
                 "fuzz_readers: an outcome was hardly reached, the mutations test little\n");
    return 1;
  }
  return 0;
}
#endif
