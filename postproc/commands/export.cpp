// SPDX-License-Identifier: GPL-2.0-or-later
#include <chrono>
#include <cmath>
#include <stdexcept>

#include <date/date.h>
#include <fmt/format.h>

#include "command.h"
#include "new_file.h"

namespace LSM::postproc {

namespace {

/// UTC date with microseconds, or "" outside the years that the readers know.
/// \param start seconds since 1970
std::string date_text(double seconds, std::int64_t start, int last_year) {
  // Longer than all years that can come out; keeps the integers below from overflowing.
  if (!(std::fabs(seconds) < 1e12)) return {};
  const date::sys_time<std::chrono::microseconds> at(
      std::chrono::seconds(start) + std::chrono::microseconds(std::llround(seconds * 1e6)));
  const int year = static_cast<int>(date::year_month_day(date::floor<date::days>(at)).year());
  return year < 1700 || year > last_year ? std::string() : date::format("%FT%T", at);
}

class Export : public CatalogueAnalysis {
  OutputOption output_;
  std::string start_ = "2000-01-01T00:00:00";
  std::string format_ = "seismostats";
  MagnitudeOptions magnitudes_;
  double degrees_ = 0.0;
  double unit_ = 1.0;  // seconds in a unit of model time

  const char *help() const override {
    return "Writes catalogues as a table for earthquake catalogue tools. Magnitudes are a "
           "convention, not a result: M = (2/3) log10(size) + constant, the usual slope between "
           "magnitude and the logarithm of seismic moment or energy, as the size of an event is an "
           "energy of the model (ours). A model of a single fault has no geography: latitude and "
           "depth are 0";
  }

  void add_options(CLI::App *command) override {
    catalogues.add_to(command);
    json.add_to(command);
    OptionGroup own(command);
    own.remove("--format");  // here that of the output
    output_.add_to(own, "table");
    OptionGroup group(command, "Conventions (ours)");
    group.add("--format", format_,
              "seismostats: longitude, latitude, depth, time, magnitude (what seismostats.Catalog "
              "requires; read with pandas.read_csv(FILE, parse_dates=['time'])), then event_id, "
              "catalog_id, duration (model time), size (energy). csep: lon, lat, mag, time_string, "
              "depth, catalog_id, event_id, the columns of pyCSEP's CSV (csep.load_catalog(FILE, "
              "type='csep-csv'))",
              among({"seismostats", "csep"}));
    magnitudes_.add_to(group);
    group.add("--start-date", start_,
              "Date of model time 0, YYYY-MM-DD or YYYY-MM-DDTHH:MM:SS (UTC). Times are the starts "
              "of events, YYYY-MM-DDTHH:MM:SS.ffffff");
    group.add("--time-unit", unit_,
              "Length of one unit of model time: second, minute, hour, day, year (365.25 days), or "
              "a number of seconds. Dates have to lie before 2262 (pandas) or 10000 (csep)",
              number_or({{"second", 1.0},
                         {"minute", 60.0},
                         {"hour", 3600.0},
                         {"day", 86400.0},
                         {"year", 365.25 * 86400.0}}),
              positive(), shown("second"));
    group.add("--degrees-per-length", degrees_,
              "Longitude = x_centroid x this (degrees per model length); 0: all longitudes are 0",
              finite());
  }

  std::vector<Output> outputs() const override { return {output_.output()}; }

  bool csep() const { return format_ == "csep"; }

  /// Seconds since 1970 of model time 0. \throws std::invalid_argument for impossible options
  std::int64_t checked_start() const {
    check(catalogues);
    const std::optional<double> days = parse_date(start_);
    if (!days)
      throw std::invalid_argument(fmt::format(
          "--start-date '{}': expected a date YYYY-MM-DD or YYYY-MM-DDTHH:MM:SS", start_));
    return std::llround(*days * 86400.0);
  }

  /// Row of an event of the catalogue with this number.
  std::string row_of(const Event &event, std::size_t number, std::int64_t start) const {
    const int last_year = csep() ? 9999 : 2261;
    const double magnitude = magnitudes_.magnitude(magnitudes_.quantity(event));
    const double longitude = event.x_centroid * degrees_;
    const std::string date = date_text(event.t_start * unit_, start, last_year);
    if (date.empty())
      throw std::runtime_error(
          fmt::format("{}: event {} starts at time {}, a date outside the years 1700 to {}; "
                      "expected another --time-unit or --start-date",
                      catalogues.paths[number], event.id, event.t_start, last_year));
    if (csep())
      return fmt::format("{},0,{},{},0,{},{}\n", longitude, magnitude, date, number, event.id);
    return fmt::format("{},0,0,{},{},{},{},{},{}\n", longitude, date, magnitude, event.id, number,
                       event.t_end - event.t_start, event.size);
  }

  Findings find() override {
    const std::int64_t start = checked_start();
    const FileLock lock = claim_output(output_.path, output_.force);
    text_io::OutputFile out;
    out.create(output_.path,
               csep()
                   ? "lon,lat,mag,time_string,depth,catalog_id,event_id\n"
                   : "longitude,latitude,depth,time,magnitude,event_id,catalog_id,duration,size\n",
               true);
    std::string block;
    std::int64_t written = 0, without = 0;
    for (std::size_t i = 0; i < catalogues.paths.size(); ++i) {
      const std::string &path = catalogues.paths[i];
      const EventTable table = read_events(path, catalogues, [&](const Event &event) {
        const bool has_magnitude = magnitudes_.quantity(event) > 0.0;
        ++(has_magnitude ? written : without);
        if (has_magnitude) block += row_of(event, i, start);
        if (block.size() < (1 << 16)) return;
        out.write(block);
        block.clear();
      });
      magnitudes_.require(path, table.info);
      if (degrees_ != 0.0 && !table.info.x_centroid)
        throw std::runtime_error(
            path + ": has no column x_centroid, expected one for --degrees-per-length");
      state_repairs(table);
    }
    out.write(block);
    out.close();
    Findings found;
    found.say(fmt::format("{} events; left out: {} of {} <= 0, which have no magnitude\nwrote {}\n",
                          written, without, magnitudes_.of(), output_.path));
    Table counts("events,without_magnitude");
    counts.row(written, without);
    found.table("counts", std::move(counts));
    return found;
  }
};

}  // namespace

std::shared_ptr<Command> make_export() { return std::make_shared<Export>(); }

}  // namespace LSM::postproc
