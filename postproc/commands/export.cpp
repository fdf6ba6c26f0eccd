// SPDX-License-Identifier: GPL-2.0-or-later
#include <cmath>
#include <cstdint>
#include <ctime>
#include <map>
#include <memory>
#include <stdexcept>
#include <string>

#include <fmt/format.h>

#include "catalogue_input.h"
#include "commands.h"
#include "json_output.h"
#include "lsm_text_io.h"
#include "magnitude_options.h"
#include "new_file.h"

namespace LSM::postproc {

namespace {

enum class Format { seismostats, csep };

struct Options {
  CatalogueOptions catalogues;
  JsonOutput json;
  std::string output, start = "2000-01-01T00:00:00";
  Format format = Format::seismostats;
  MagnitudeOptions magnitudes;
  double degrees = 0.0;
  double unit = 1.0;  // seconds in a unit of model time
  bool force = false;
};

constexpr std::int64_t micro = 1000000;

/// Seconds since 1970 of YYYY-MM-DD or YYYY-MM-DDTHH:MM:SS (UTC).
std::int64_t parse_date(const std::string &text) {
  std::tm date{};
  const char *end = strptime(text.c_str(), "%Y-%m-%d", &date);
  if (end && *end == 'T') end = strptime(end, "T%H:%M:%S", &date);
  std::tm normal = date;
  const std::time_t seconds = end ? timegm(&normal) : 0;
  // timegm moves a day that does not exist into the next month.
  if (!end || *end != '\0' || normal.tm_mday != date.tm_mday || normal.tm_mon != date.tm_mon)
    throw std::invalid_argument(
        fmt::format("--start-date '{}': expected a date YYYY-MM-DD or YYYY-MM-DDTHH:MM:SS", text));
  return seconds;
}

/// UTC date with microseconds, or "" outside the years that the readers know.
std::string date_text(double seconds, std::int64_t start, int last_year) {
  // Longer than all years that can come out; keeps the integers below from overflowing.
  if (!(std::fabs(seconds) < 1e12)) return {};
  const std::int64_t microseconds = std::llround(seconds * static_cast<double>(micro));
  std::int64_t whole = microseconds / micro, rest = microseconds % micro;
  if (rest < 0) {
    rest += micro;
    --whole;
  }
  const std::time_t at = start + whole;
  std::tm date{};
  if (!gmtime_r(&at, &date)) return {};
  const int year = date.tm_year + 1900;
  if (year < 1700 || year > last_year) return {};
  return fmt::format("{:04}-{:02}-{:02}T{:02}:{:02}:{:02}.{:06}", year, date.tm_mon + 1,
                     date.tm_mday, date.tm_hour, date.tm_min, date.tm_sec, rest);
}

void run(Options &options) {
  options.json.check(options.catalogues.paths);
  check_outputs({{"--output", options.output}, options.json.output()}, options.catalogues.paths);
  check(options.catalogues);
  options.magnitudes.check();
  if (!std::isfinite(options.degrees))
    throw std::invalid_argument("--degrees-per-length: expected a finite number");
  const bool csep = options.format == Format::csep;
  const std::int64_t start = parse_date(options.start);
  const FileLock lock = claim_output(options.output, options.force);
  text_io::OutputFile out;
  out.create(options.output,
             csep ? "lon,lat,mag,time_string,depth,catalog_id,event_id\n"
                  : "longitude,latitude,depth,time,magnitude,event_id,catalog_id,duration,size\n",
             true);
  std::string block;
  std::int64_t written = 0, without = 0;
  for (std::size_t i = 0; i < options.catalogues.paths.size(); ++i) {
    const std::string &path = options.catalogues.paths[i];
    const EventTable table = read_events(path, options.catalogues, [&](const Event &event) {
      if (!(options.magnitudes.quantity(event) > 0.0)) {
        ++without;
        return;
      }
      const double magnitude = options.magnitudes.magnitude(event);
      const double longitude = event.x_centroid * options.degrees;
      const std::string date = date_text(event.t_start * options.unit, start, csep ? 9999 : 2261);
      if (date.empty())
        throw std::runtime_error(fmt::format(
            "{}: event {} starts at time {}, a date outside the years 1700 to {}; expected another "
            "--time-unit or --start-date",
            path, event.id, event.t_start, csep ? 9999 : 2261));
      if (csep)
        block += fmt::format("{},0,{},{},0,{},{}\n", longitude, magnitude, date, i, event.id);
      else
        block += fmt::format("{},0,0,{},{},{},{},{},{}\n", longitude, date, magnitude, event.id, i,
                             event.t_end - event.t_start, event.size);
      ++written;
      if (block.size() < (1 << 16)) return;
      out.write(block);
      block.clear();
    });
    options.magnitudes.require(path, table.info);
    if (options.degrees != 0.0 && !table.info.x_centroid)
      throw std::runtime_error(path +
                               ": has no column x_centroid, expected one for "
                               "--degrees-per-length");
    state_repairs(table);
  }
  out.write(block);
  out.close();
  fmt::print("{} events; left out: {} of {} <= 0, which have no magnitude\nwrote {}\n", written,
             without, options.magnitudes.of(), options.output);
  Table counts({"events", "without_magnitude"});
  counts.add(written).add(without).end_row();
  options.json.add("counts", counts);
  options.json.write();
}

}  // namespace

void add_export(CLI::App &app) {
  CLI::App *command = app.add_subcommand(
      "export",
      "Writes catalogues as a table for earthquake catalogue tools. Magnitudes are a convention, "
      "not a result: M = (2/3) log10(size) + constant, the usual slope between magnitude and the "
      "logarithm of seismic moment or energy, as the size of an event is an energy of the model "
      "(ours). A model of a single fault has no geography: latitude and depth are 0");
  auto options = std::make_shared<Options>();
  options->catalogues.add_to(command);
  options->json.add_to(command);
  command->remove_option(command->get_option("--format"));  // here that of the output
  command->add_option("-o,--output", options->output, "Table to write")->required();
  command->add_flag("--force", options->force, "Replace the table if it exists");
  const std::string group = "Conventions (ours)";
  command
      ->add_option("--format", options->format,
                   "seismostats: longitude, latitude, depth, time, magnitude (what "
                   "seismostats.Catalog requires; read with pandas.read_csv(FILE, "
                   "parse_dates=['time'])), then event_id, catalog_id, duration (model time), size "
                   "(energy). csep: lon, lat, mag, time_string, depth, catalog_id, event_id, the "
                   "columns of pyCSEP's CSV (csep.load_catalog(FILE, type='csep-csv'))")
      ->transform(CLI::CheckedTransformer(std::map<std::string, Format>{
          {"seismostats", Format::seismostats}, {"csep", Format::csep}}))
      ->default_str("seismostats")
      ->group(group);
  options->magnitudes.add_to(command, group);
  command
      ->add_option("--start-date", options->start,
                   "Date of model time 0, YYYY-MM-DD or YYYY-MM-DDTHH:MM:SS (UTC). Times are the "
                   "starts of events, YYYY-MM-DDTHH:MM:SS.ffffff")
      ->group(group);
  command
      ->add_option("--time-unit", options->unit,
                   "Length of one unit of model time: second, minute, hour, day, year (365.25 "
                   "days), or a number of seconds. Dates have to lie before 2262 (pandas) or 10000 "
                   "(csep)")
      ->transform(CLI::Transformer(std::map<std::string, double>{{"second", 1.0},
                                                                 {"minute", 60.0},
                                                                 {"hour", 3600.0},
                                                                 {"day", 86400.0},
                                                                 {"year", 365.25 * 86400.0}}))
      ->check(CLI::PositiveNumber)
      ->default_str("second")
      ->group(group);
  command
      ->add_option("--degrees-per-length", options->degrees,
                   "Longitude = x_centroid x this (degrees per model length); 0: all longitudes "
                   "are 0")
      ->group(group);
  command->callback([options] { run(*options); });
}

}  // namespace LSM::postproc
