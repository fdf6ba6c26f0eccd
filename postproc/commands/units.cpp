// SPDX-License-Identifier: GPL-2.0-or-later
#include "units.h"

#include <algorithm>

#include <fmt/format.h>

#include "command.h"
#include "files/text.h"
#include "numbers.h"

namespace LSM::postproc {

namespace {

class Units : public CatalogueAnalysis {
  UnitOptions units_;

  const char *help() const override {
    return "What the units of the lattice solid fault are in SI for a length, a speed of P-waves "
           "and a density of your choice, and what the faults of catalogues are then † (the "
           "paper has model units only). magnitudes and export take the same options";
  }

  void add_options(CLI::App *command) override {
    catalogues.add_to(command);
    json.add_to(command);
    units_.add_to(OptionGroup(command, "SI units †"));
  }

  static Table units_table(const ModelUnits &units) {
    struct Unit {
      const char *quantity, *unit;
      double value;
    };
    TableOf<Unit> table;
    table.column("quantity", "one model unit of", &Unit::quantity);
    table.show("is", &Unit::value);
    table.column("unit", "in", &Unit::unit);
    table.data("value", &Unit::value);
    table.row({"length", "m", units.length});
    table.row({"time", "s", units.time()});
    table.row({"velocity", "m/s", units.velocity()});
    table.row({"stress, stiffness", "MPa", units.stress() * 1e-6});
    table.row({"energy, sizes", "J", units.energy()});
    table.row({"slip times length, moments", "N m", units.moment()});
    table.row({"Mw of that moment", "", moment_magnitude(units.moment()).constant});
    return Table(std::move(table));
  }

  struct InSi {
    std::string label, quantity;
    double model;
    const char *unit;
    double value;
  };

  /// Adds numbers from the header of a fault, and its largest event, in SI units.
  static void add_fault(TableOf<InSi> &table, const EventTable &fault, const ModelUnits &units,
                        const MagnitudeOptions &magnitudes) {
    const auto header = [&](const char *name, const char *quantity, const char *unit, double si) {
      double value = 0.0;
      const std::string *const text = fault.info.find(name);
      if (text && text::parse(*text, value))
        table.row({fault.label, quantity, value, unit, value * si});
    };
    header("length", "length of the fault", "km", units.length * 1e-3);
    header("width", "width across the fault", "km", units.length * 1e-3);
    header("stress", "normal stress", "MPa", units.stress() * 1e-6);
    header("velocity", "velocity of each plate", "m/s", units.velocity());
    header("dt", "time step", "s", units.time());
    if (fault.events.empty()) return;
    const auto largest = std::max_element(fault.details.begin(), fault.details.end(),
                                          [&](const Event &a, const Event &b) {
                                            return magnitudes.quantity(a) < magnitudes.quantity(b);
                                          });
    const double span = fault.last_end - fault.events.front().t_start;
    table.row({fault.label, "first to last event", span, "s", span * units.time()});
    if (largest == fault.details.end() || !(magnitudes.quantity(*largest) > 0.0)) return;
    const double quantity = magnitudes.quantity(*largest);
    table.row({fault.label, fmt::format("{} of the largest event", magnitudes.type()), quantity, "",
               magnitudes.scale(fault.path, fault.info).of(quantity)});
  }

  Results find() override {
    const ModelUnits units = units_.units();
    catalogues.details = CatalogueOptions::all_events;
    TableOf<InSi> faults;
    faults.column("label", "catalogue", &InSi::label);
    faults.column("quantity", "", &InSi::quantity);
    faults.column("model", "model", &InSi::model);
    faults.show("SI", &InSi::value);
    faults.column("unit", "in", &InSi::unit);
    faults.data("value", &InSi::value);
    for (const EventTable &table : load_catalogues(catalogues)) {
      units_.units(table.path, table.info);
      MagnitudeOptions magnitudes;
      magnitudes.units = units_;
      if (!table.info.slip_moment) magnitudes.take_size();
      add_fault(faults, table, units, magnitudes);
    }
    Results results;
    results.say(fmt::format(
        "S-waves {} m/s, shear modulus {} GPa, thickness {} m\n", short_number(units.s_speed()),
        short_number(units.shear_modulus() * 1e-9), short_number(units.thickness)));
    results.table("units", units_table(units));
    results.table("faults", std::move(faults));
    return results;
  }
};

}  // namespace

std::shared_ptr<Command> make_units() { return std::make_shared<Units>(); }

}  // namespace LSM::postproc
