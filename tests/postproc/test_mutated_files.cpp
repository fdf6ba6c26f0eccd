// SPDX-License-Identifier: GPL-2.0-or-later
// Mutated files of all kinds, strict and lenient. Whatever the bytes, a reader returns what its
// description promises or throws a FileError; it never crashes. Other mutations:
//   lsm_postproc_tests --gtest_filter='MutatedFiles.*' --gtest_random_seed=N
#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <functional>
#include <memory>
#include <sstream>
#include <stdexcept>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "earthquakes.h"
#include "events/event_picker.h"
#include "files/catalogue.h"
#include "files/file_error.h"
#include "files/pe_series.h"
#include "files/slip_history.h"
#include "numerics/random.h"
#include "text_bytes.h"
#include "unit_files.h"

using namespace LSM;

namespace {

void require(bool good, const char *what) {
  if (!good) throw std::logic_error(what);
}

/// What a reader made of a file: its rows of numbers, unless it refused the file.
struct Outcome {
  bool refused = false;
  std::int64_t repairs = 0;
  std::vector<std::vector<double>> rows = {};
};

using Read = std::function<void(const std::string &text, bool lenient, Outcome &out)>;

auto bytes_of(const std::string &text) { return std::make_unique<unit::TextBytes>(text, "file"); }

void read_catalogue(const std::string &text, bool lenient, Outcome &out) {
  CatalogueReader reader(bytes_of(text), lenient);
  require(reader.info().model == "lsm" || reader.info().model == "block-slider", "known model");
  const std::vector<CatalogueColumn> columns = columns_of(reader.info());
  EventRow before, event;
  for (bool first = true; reader.next(event); first = false) {
    out.rows.emplace_back();
    for (const CatalogueColumn &column : columns) {
      out.rows.back().push_back(column.of(event));
      require(std::isfinite(column.of(event)), "finite numbers");
    }
    require(event.t_start <= event.t_end, "an event ends after its start");
    require(event.step_start <= event.step_end, "an event ends after its first step");
    require(first || (before.id < event.id && before.t_end <= event.t_start &&
                      before.step_end <= event.step_start),
            "events in order of their identifiers, times and steps");
    before = event;
  }
  out.repairs = reader.skipped();
  require(reader.repairs().empty() == (reader.skipped() == 0), "repairs are stated");
  require(reader.first_problem().empty() == (reader.skipped() == 0), "the first one is named");
}

void read_series(const std::string &text, bool lenient, Outcome &out) {
  PeSeriesReader reader(bytes_of(text), lenient);
  require(reader.info().dt > 0.0 && reader.info().stride >= 1, "sane header");
  EventPicker picker{PickerSettings()};
  Event event;
  std::int64_t step = 0, step_before = 0;
  double time = 0.0, pe = 0.0, time_before = 0.0, pe_before = 0.0;
  bool picking = true;
  while (reader.next(step, time, pe)) {
    require(std::isfinite(time) && std::isfinite(pe), "finite numbers");
    if (!out.rows.empty()) {
      require(step_before < step && time_before <= time, "increasing steps and times");
      // A picker may refuse only a change that is too large for a double.
      picking = picking && std::isfinite(pe - pe_before);
    }
    if (picking) picker.push(step, time, pe, event);
    out.rows.push_back({static_cast<double>(step), time, pe});
    std::tie(step_before, time_before, pe_before) = std::tie(step, time, pe);
  }
  out.repairs = reader.torn() ? 1 : 0;
}

void read_history(const std::string &text, bool lenient, Outcome &out) {
  SlipHistoryReader reader(bytes_of(text), lenient);
  const FaultGrid &grid = reader.info().grid;
  const auto cells = static_cast<std::size_t>(grid.cells());
  SlipRecord record;
  for (std::int64_t last = 0; reader.next(record); last = record.step_end) {
    std::vector<double> row = {record.pe};
    for (const auto *values : {&record.row.slip, &record.row.work, &record.row.stress}) {
      const bool scalar = values == &record.row.work;
      require(values->size() == (scalar ? 1 : grid.components()) * cells, "all cells");
      row.insert(row.end(), values->begin(), values->end());
    }
    for (const double x : row) require(std::isfinite(x), "finite numbers");
    require(out.rows.empty() ? record.step_begin == record.step_end
                             : record.step_begin == last && record.step_end > last,
            "records without gaps");
    out.rows.push_back(row);
  }
  out.repairs = reader.torn() ? 1 : 0;
}

void read_quakes(const std::string &text, bool lenient, Outcome &out) {
  const auto bytes = bytes_of(text);
  const std::string format = postproc::detect_format(bytes->peek(postproc::head_size));
  if (format == "models") throw FileError("file: no earthquakes");
  const postproc::EarthquakeList list = postproc::read_earthquakes(*bytes, format, lenient);
  for (const postproc::Earthquake &one : list.events) {
    require(std::isfinite(one.time) && std::fabs(one.magnitude) <= 12.0, "finite numbers");
    require(out.rows.empty() || out.rows.back()[0] <= one.time, "in order of time");
    out.rows.push_back({one.time, one.magnitude});
  }
  out.repairs = list.bad_lines;
  for (const auto &[type, count] : list.others) out.repairs += lenient ? count : 0;
}

/// How many files a reader accepted, repaired and refused.
struct Kind {
  const char *name;
  Read read;
  std::int64_t accepted = 0, repaired = 0, refused = 0;

  Outcome outcome_of(const std::string &text, bool lenient) const {
    Outcome out;
    try {
      read(text, lenient, out);
    } catch (const FileError &error) {
      out.refused = true;
      const std::string message = error.what();
      require(message.rfind("file", 0) == 0, "a message begins with the file");
      require(message.find('\n') == std::string::npos, "a message is one line");
    }
    return out;
  }

  void judge(const std::string &text) {
    const Outcome strict = outcome_of(text, false), lenient = outcome_of(text, true);
    require(strict.repairs == 0, "strict repairs nothing");
    require(!lenient.refused || strict.refused, "lenient accepts what strict accepts");
    require(strict.refused || strict.rows == lenient.rows, "nothing to repair");
    require(lenient.refused || !strict.refused || lenient.repairs > 0,
            "a repair for what strict refuses");
    ++(!strict.refused ? accepted : !lenient.refused ? repaired : refused);
  }
};

class MutatedFiles : public unit::Files {
 protected:
  MutatedFiles() {
    std::istringstream all(
        "nan|inf|-inf|1e999|1e-999|-|,|,,|\n|\r\n|\n\n|#|# | = |=|0|-1|9223372036854775807|"
        "-9223372036854775808|1e308|-1e308|# model = lsm\n|# dt = 0\n|slip_moment|,slip_moment|"
        "# lsm-catalogue 2|lsm-pe-series-1\n|\xff\xff\xff\xff\xff\xff\xff\xff|\"|:|/|<|time");
    for (std::string token; std::getline(all, token, '|');) tokens_.push_back(token);
  }

  /// Files that look like those of the programs, and of agencies.
  std::vector<std::string> seeds() const {
    std::vector<std::string> out;
    const std::string path = this->path("seed");
    for (const auto &[columns, plane] : {std::pair{false, false}, {true, false}, {true, true}}) {
      CatalogueInfo info;
      info.model = columns ? "lsm" : "block-slider";
      info.parameters = {{"dt", "0.03"}, {"length", "120"}, {"picker", "exponential"}};
      if (columns) add_names(info.columns, columns_of_ruptures);
      if (plane) add_names(info.columns, columns_of_planes);
      CatalogueWriter writer;
      writer.create(path, info);
      for (int i = 0; i < 8; ++i) {
        PlaneRupture event;
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
      out.push_back(unit::slurp(path));

      SlipHistoryInfo history;
      history.grid.bins = 2;
      history.grid.interval = 10;
      history.grid.dt = 0.06;
      history.quiet = 3;
      history.grid.plane = plane;
      history.grid.rows = plane ? 2 : 1;
      SlipHistoryWriter slips;
      FaultRow row(history.grid);
      row.stress[0] = 0.5F;
      slips.create(path, history, 0, 1.0, row.stress);
      for (int n = 1; n <= 9; ++n) {
        row.slip[0] = 0.25F;
        slips.add(10 * n, 1.0 - 0.01 * n, row, n > 3 && n < 7);
      }
      slips.close();
      out.push_back(unit::slurp(path));
    }
    PeSeriesInfo info;
    info.model = "lsm";
    info.dt = 0.03;
    info.step0 = 20;
    info.time0 = 0.6;
    info.parameters = {{"lambda", "0.99"}};
    PeSeriesWriter writer;
    writer.create(path, info);
    for (int i = 0; i < 12; ++i) writer.write(20 + i, 0.14 + 1e-3 * (i % 5));
    writer.close();
    out.push_back(unit::slurp(path));
    out.push_back(
        "date,time,lat,lon,mag,type\n13/10/2022,06:29:41.1,1,2,3.1,eq\n"
        "14/10/2022,6:30 PM,1,2,3,\"a \"\"b\"\n");
    out.push_back("year,month,day,hrmn,lat,lon,mag\n2022,10,13,629,1,2,3\n2022,10,13,1446,1,2,4\n");
    out.push_back(
        "-118.5 34.2 1994 1 17 6.7 18.2 12 30 55.39\n-118.4 34.2 1994.1 1 18 5 5 1 2 3\n");
    out.push_back("1994/01/15 00:00:00.00 eq  l 2.01 c    33.500 -116.500   5.0 A  5  10   20\n");
    out.push_back(
        "{\"features\":[{\"properties\":{\"mag\":6.7,\"time\":758809855390},\n"
        "\"geometry\":{\"coordinates\":[-118.5,34.2,18.2]}}]}");
    out.push_back(
        "<q><eventParameters><event><origin><time><value>1994-01-17T12:31:58</value>\n"
        "</time></origin><magnitude><mag><value>5</value></mag></magnitude></event>"
        "</eventParameters></q>\n");
    return out;
  }

  std::size_t below(std::size_t n) { return n == 0 ? 0 : random_.next() % n; }

  void mutate(std::string &text, const std::vector<std::string> &others) {
    const std::string &token = tokens_[below(tokens_.size())];
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
        text.insert(at, token);
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

  std::vector<std::string> tokens_;
  Random random_{static_cast<std::uint64_t>(1 + GTEST_FLAG_GET(random_seed))};
};

TEST_F(MutatedFiles, AreReadAsPromisedOrRefused) {
  const std::vector<std::string> files = seeds();
  Kind kinds[] = {{"catalogues", read_catalogue},
                  {"PE series", read_series},
                  {"slip histories", read_history},
                  {"earthquakes", read_quakes}};
  for (std::size_t n = 0; n < files.size() + 6000; ++n) {
    std::string text = files[n < files.size() ? n : below(files.size())];
    if (n >= files.size())
      for (std::size_t times = 1 + below(5); times > 0; --times) mutate(text, files);
    try {
      for (Kind &kind : kinds) kind.judge(text);
    } catch (const std::logic_error &broken) {
      FAIL() << "broken promise: " << broken.what() << " of this file:\n" << text;
    }
  }
  // Else the mutations test little.
  for (const Kind &kind : kinds)
    for (const std::int64_t outcome : {kind.accepted, kind.repaired, kind.refused})
      EXPECT_GT(outcome, 10) << kind.name;
}

}  // namespace
