// SPDX-License-Identifier: GPL-2.0-or-later
#include <chrono>
#include <cmath>
#include <stdexcept>

#include <date/date.h>
#include <fmt/format.h>

#include "command.h"
#include "event_time.h"
#include "new_file.h"
#include "numbers.h"

namespace LSM::postproc {

namespace {

/// UTC date with microseconds, or "" outside the years that the readers of the format know.
/// \param seconds since `start`
/// \param start in microseconds since 1970
std::string utc_text(double seconds, std::int64_t start, int last_year) {
  // Keeps the integers below from overflowing. 1e12 s is longer than all valid years.
  if (!(std::fabs(seconds) < 1e12)) return {};
  const date::sys_time<std::chrono::microseconds> at(
      std::chrono::microseconds(start + std::llround(seconds * 1e6)));
  const int year = static_cast<int>(date::year_month_day(date::floor<date::days>(at)).year());
  return year < 1700 || year > last_year ? std::string() : date::format("%FT%T", at);
}

/// An event with what the formats need.
struct Exported {
  const Event &event;
  std::size_t catalogue;
  std::string date;
  double magnitude, longitude, latitude;
  double depth;             ///< km; NaN: not known
  const std::string &type;  ///< type of the magnitude; "": not known
};

/// A format of the output.
struct Format {
  const char *name;
  int last_year;  ///< last year that its readers know
  std::string head, tail;
  std::string (*event)(const Exported &event);
};

std::string seismostats_row(const Exported &e) {
  return fmt::format("{},{},{},{},{},{},{},{},{},{}\n", e.longitude, e.latitude, e.depth, e.date,
                     e.magnitude, e.event.id, e.catalogue, e.event.t_end - e.event.t_start,
                     e.event.size, e.type);
}

std::string csep_row(const Exported &e) {
  return fmt::format("{},{},{},{},{},{},{}\n", e.longitude, e.latitude, e.magnitude, e.date,
                     e.depth, e.catalogue, e.event.id);
}

std::string quakeml_event(const Exported &e) {
  const std::string name = fmt::format("smi:local/lsm-fault/{}/{}", e.catalogue, e.event.id);
  const auto value = [](const char *what, const auto &number) {
    return fmt::format("  <{0}>\n   <value>{1}</value>\n  </{0}>\n", what, number);
  };
  const auto known = [&](const char *what, double number) {
    return std::isnan(number) ? std::string() : value(what, number);
  };
  return fmt::format(
      "<event publicID=\"{0}/event\">\n"
      " <preferredOriginID>{0}/origin</preferredOriginID>\n"
      " <preferredMagnitudeID>{0}/magnitude</preferredMagnitudeID>\n"
      " <type>earthquake</type>\n"
      " <origin publicID=\"{0}/origin\">\n{1} </origin>\n"
      " <magnitude publicID=\"{0}/magnitude\">\n{2}{3}"
      "  <originID>{0}/origin</originID>\n </magnitude>\n</event>\n",
      name,
      value("time", e.date + "Z") + known("longitude", e.longitude) +
          known("latitude", e.latitude) + known("depth", 1000.0 * e.depth),
      value("mag", e.magnitude), e.type.empty() ? "" : "  <type>" + e.type + "</type>\n");
}

const Format formats[] = {
    {"seismostats", 2261,
     "longitude,latitude,depth,time,magnitude,event_id,catalog_id,duration,size,magnitude_type\n",
     "", seismostats_row},
    {"csep", 9999, "lon,lat,mag,time_string,depth,catalog_id,event_id\n", "", csep_row},
    {"quakeml", 9999,
     "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
     "<q:quakeml xmlns:q=\"http://quakeml.org/xmlns/quakeml/1.2\" "
     "xmlns=\"http://quakeml.org/xmlns/bed/1.2\">\n"
     "<eventParameters publicID=\"smi:local/lsm-fault\">\n",
     "</eventParameters>\n</q:quakeml>\n", quakeml_event}};

class Export : public CatalogueAnalysis {
  std::optional<std::string> start_;
  std::string format_ = "seismostats";
  MagnitudeOptions magnitudes_;
  std::optional<double> unit_;  // seconds per unit of model time

  const char *help() const override {
    return "Writes catalogues as a file for earthquake catalogue tools. Earthquakes keep their "
           "dates, magnitudes, places and depths. A model has neither dates nor magnitudes, so "
           "that both have to be chosen: by --unit-length, --p-speed and "
           "--density of a rock, from which magnitudes, times and longitudes follow; or by "
           "--time-unit, --start-date and --magnitude-constant, M = (2/3) log10(size) + constant "
           "†. A model of a single fault has no geography: latitude and depth are 0";
  }

  void add_options(CLI::App *command) override {
    add_catalogues(command, catalogues);
    catalogues.bins_for_models = true;
    add_magnitude_bin(command, catalogues,
                      "none for models; magnitudes of earthquakes as they are");
    json.add_to(command);
    OptionGroup own(command);
    own.remove("--format");  // the format of the output has the name instead
    add_format(OptionGroup(command, "Catalogues"), catalogues, "--input-format");
    add_file(own, "Table to write");
    OptionGroup group(command, "Conventions †");
    group.add("--format", format_,
              "seismostats: longitude, latitude, depth, time, magnitude (what seismostats.Catalog "
              "requires; read with pandas.read_csv(FILE, parse_dates=['time'])), then event_id, "
              "catalog_id, duration (model time), size (energy), magnitude_type (Mw, Me, or M for "
              "a scale of your own). csep: lon, lat, mag, time_string, depth, catalog_id, "
              "event_id, the columns of pyCSEP's CSV (csep.load_catalog(FILE, type='csep-csv')). "
              "quakeml: QuakeML 1.2",
              among({"seismostats", "csep", "quakeml"}));
    magnitudes_.add_to(group);
    group.call<std::vector<std::string>>(
        "--start-date", [this](const std::vector<std::string> &text) { start_ = text.back(); },
        "Date of model time 0, YYYY-MM-DD or YYYY-MM-DDTHH:MM:SS (UTC). Times are the starts "
        "of events, YYYY-MM-DDTHH:MM:SS.ffffff",
        shown("with --unit-length 2000-01-01"));
    group.add("--time-unit", unit_,
              "Length of one unit of model time: second, minute, hour, day, year (365.25 days), or "
              "a number of seconds. Dates have to lie before 2262 (pandas) or 10000 (others)",
              number_or({{"second", 1.0},
                         {"minute", 60.0},
                         {"hour", 3600.0},
                         {"day", 86400.0},
                         {"year", 365.25 * 86400.0}}),
              positive());
  }

  /// Checks that everything was given that a model leaves open.
  /// \throws std::invalid_argument otherwise
  void check_conventions() const {
    if (magnitudes_.in_si()) {
      if (unit_)
        throw std::invalid_argument(
            "--time-unit with --unit-length, from which it follows: expected one of them");
      return;
    }
    const char *missing = !unit_                  ? "--time-unit"
                          : !start_               ? "--start-date"
                          : !magnitudes_.constant ? "--magnitude-constant"
                                                  : nullptr;
    if (missing)
      throw std::invalid_argument(
          fmt::format("no {}: a model has neither dates nor magnitudes, expected --unit-length, "
                      "--p-speed and --density, or --time-unit, --start-date and "
                      "--magnitude-constant",
                      missing));
  }

  /// Microseconds since 1970 of model time 0.
  /// \throws std::invalid_argument for impossible options
  std::int64_t checked_start() const {
    magnitudes_.check();
    const std::string start = start_.value_or("2000-01-01");
    const std::optional<double> days = parse_date(start);
    if (!days)
      throw std::invalid_argument(fmt::format(
          "--start-date '{}': expected a date YYYY-MM-DD or YYYY-MM-DDTHH:MM:SS", start));
    return std::llround(*days * 86400e6);
  }

  std::string conventions(std::int64_t start, bool models, bool quakes) const {
    std::string out;
    if (quakes) out = "earthquakes: dates, magnitudes, places and depths of the files\n";
    if (!models) return out;
    const double second = unit_ ? *unit_ : magnitudes_.units().time();
    return out + fmt::format("{}; a unit of time is {} s; time 0 is {}\n", magnitudes_.text(),
                             short_number(second), utc_text(0.0, start, 9999).substr(0, 19));
  }

  Results find() override {
    const std::int64_t start = checked_start();
    const Format *format = formats;
    while (format->name != format_) ++format;
    const std::string of_model = magnitudes_.type(), unknown;
    const auto file = std::make_shared<ClaimedFile<files::OutputFile>>(file_, overwrite);
    files::OutputFile &out = file->writer;
    out.create(file_, format->head, true);
    std::string block;
    std::int64_t written = 0, without = 0;
    std::size_t number = 0;
    bool models = false, quakes = false;
    for_each_catalogue(catalogues, [&](const std::string &path, const CatalogueOptions &one) {
      MagnitudeScale scale;
      double per_length = 0.0, second = 0.0;
      CatalogueInfo info;
      const auto begin = [&](const EventTable &table) {
        (table.earthquakes() ? quakes : models) = true;
        if (table.earthquakes()) return;
        check_conventions();
        scale = magnitudes_.scale(path, table.info);
        second = unit_ ? *unit_ : magnitudes_.units(path, table.info).time();
        info = table.info;
        constexpr double metres = 111194.9;  // per degree on a sphere with a radius of 6371 km
        if (magnitudes_.in_si() && info.has("x_centroid"))
          per_length = magnitudes_.units().length / metres;
      };
      const auto write = [&](const Exported &row) {
        ++written;
        block += format->event(row);
        if (block.size() < (1 << 16)) return;
        out.write(block);
        block.clear();
      };
      const MagnitudeBins bins = catalogues.magnitude_bins.value_or(MagnitudeBins());
      const auto use = [&](const ReadEvent &event) {
        if (const Earthquake *const quake = event.earthquake) {
          const std::string date = utc_text(quake->time * 86400.0, 0, format->last_year);
          if (date.empty())
            throw std::runtime_error(fmt::format(
                "{}: event {} is outside the years 1700 to {} that this --format can have", path,
                event.id, format->last_year));
          return write({event, number, date, bins.binned(quake->magnitude), quake->longitude,
                        quake->latitude, quake->depth, unknown});
        }
        const double quantity = magnitudes_.quantity(event, info);
        if (!(quantity > 0.0)) {
          ++without;
          return;
        }
        const std::string date = utc_text(event.t_start * second, start, format->last_year);
        if (date.empty())
          throw std::runtime_error(
              fmt::format("{}: event {} starts at time {}, a date outside the years 1700 to {}; "
                          "expected another --time-unit or --start-date",
                          path, event.id, event.t_start, format->last_year));
        write({event, number, date, bins.binned(scale.of(quantity)),
               info.number(event, "x_centroid") * per_length, 0.0, 0.0, of_model});
      };
      const EventTable table = read_events(path, one, use, begin);
      state_repairs(table);
      ++number;
      return table.earthquakes();
    });
    out.write(block + format->tail);
    Results results;
    results.say(conventions(start, models, quakes));
    if (!models && (unit_ || start_ || magnitudes_.for_models()))
      results.warn(
          "earthquakes keep their dates and magnitudes: --time-unit, --start-date, "
          "--magnitude-constant and SI units are for models");
    results.say(fmt::format("{} events; left out: {} of {} <= 0, which have no magnitude\n",
                            written, without, magnitudes_.of()));
    results.file(file_, [file] { file->writer.close(); });
    Table counts("events,without_magnitude");
    counts.row(written, without);
    results.table("counts", std::move(counts));
    return results;
  }
};

}  // namespace

std::shared_ptr<Command> make_export() { return std::make_shared<Export>(); }

}  // namespace LSM::postproc
