// SPDX-License-Identifier: GPL-2.0-or-later
/// \file files/event.h
/// The kinds of events, each with the columns that its catalogue may have besides those of all:
/// drops of the total elastic potential energy (PE), ruptures, and ruptures on a plane. Times in
/// model time, energies in model energy.
#ifndef LSM_EVENT_H
#define LSM_EVENT_H

#include <array>
#include <cstddef>
#include <cstdint>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "files/names.h"

namespace LSM {

/// How drops of PE are picked, as headers state it: interpretations of the paper's formula for the
/// average change of PE, called A here, with x = PE(t+1) - PE(t).
enum class PickerReading {
  exponential,  ///< A <- lambda A + (1 - lambda) x (default) (*), memory 1/(1 - lambda) samples
  average,      ///< A <- (x + lambda A) / (1 + lambda) (*), memory of about two samples
  literal       ///< A <- (x + lambda A) / (1 + lambda t), t = index of the change, from 0 (paper)
};

constexpr std::array<Named<PickerReading>, 3> names_of(PickerReading) {
  return {{{PickerReading::exponential, "exponential"},
           {PickerReading::average, "average"},
           {PickerReading::literal, "literal"}}};
}

/// When an event happened and how large it was, which is all that most statistics need.
struct EventSummary {
  double t_start = 0.0, t_end = 0.0;
  double size = 0.0;  ///< of a drop pe_start - pe_end, of a rupture work
};

/// What events of all kinds have.
struct Event : EventSummary {
  std::int64_t id = 0;  ///< 1, 2, ... over the events that are written
  std::int64_t step_start = 0, step_end = 0;
  double pe_start = 0.0, pe_end = 0.0;
};

/// A drop of PE, with what the program knows of the slip meanwhile.
struct Drop : Event {
  double slip_moment = 0.0, x_centroid = 0.0, rupture_length = 0.0, peak_slip = 0.0;
  double friction_work = 0.0, friction_total = 0.0;
};

struct Rupture : Event {
  double slip_moment = 0.0, x_centroid = 0.0, rupture_length = 0.0, x_hypocentre = 0.0,
         x_begin = 0.0, mean_slip = 0.0, stress_drop = 0.0, peak_slip = 0.0;
};

struct PlaneRupture : Rupture {
  double moment_strike = 0.0, moment_dip = 0.0, z_centroid = 0.0, rupture_width = 0.0,
         rupture_area = 0.0, z_hypocentre = 0.0, z_begin = 0.0, peak_slip_rate = 0.0;
};

/// A column of one kind of events.
template <class Kind>
struct EventColumn {
  std::string_view name;
  double Kind::*number;
};

// In the order of the file.
inline constexpr EventColumn<Drop> slip_of_drops[] = {{"slip_moment", &Drop::slip_moment},
                                                      {"x_centroid", &Drop::x_centroid},
                                                      {"rupture_length", &Drop::rupture_length},
                                                      {"peak_slip", &Drop::peak_slip}};
inline constexpr EventColumn<Drop> friction_of_drops[] = {
    {"friction_work", &Drop::friction_work}, {"friction_total", &Drop::friction_total}};
inline constexpr EventColumn<Rupture> columns_of_ruptures[] = {
    {"slip_moment", &Rupture::slip_moment},
    {"x_centroid", &Rupture::x_centroid},
    {"rupture_length", &Rupture::rupture_length},
    {"x_hypocentre", &Rupture::x_hypocentre},
    {"x_begin", &Rupture::x_begin},
    {"mean_slip", &Rupture::mean_slip},
    {"stress_drop", &Rupture::stress_drop},
    {"peak_slip", &Rupture::peak_slip}};
/// Those that follow the columns of all ruptures.
inline constexpr EventColumn<PlaneRupture> columns_of_planes[] = {
    {"moment_strike", &PlaneRupture::moment_strike},
    {"moment_dip", &PlaneRupture::moment_dip},
    {"z_centroid", &PlaneRupture::z_centroid},
    {"rupture_width", &PlaneRupture::rupture_width},
    {"rupture_area", &PlaneRupture::rupture_area},
    {"z_hypocentre", &PlaneRupture::z_hypocentre},
    {"z_begin", &PlaneRupture::z_begin},
    {"peak_slip_rate", &PlaneRupture::peak_slip_rate}};

/// What python3 -m lsm.sources adds to ruptures; programs only read it.
inline constexpr std::string_view columns_of_sources[] = {
    "source_duration", "peak_moment_rate",     "centroid_time",   "stress_work",
    "friction_work",   "contact_energy",       "radiated_energy", "apparent_stress",
    "fracture_energy", "weighted_stress_drop", "corner_frequency"};

/// Calls use(table) for each table of columns that events of the kind have.
template <class Use>
void each_table(const Event *, Use &&) {}
template <class Use>
void each_table(const Drop *, Use &&use) {
  use(slip_of_drops);
  use(friction_of_drops);
}
template <class Use>
void each_table(const Rupture *, Use &&use) {
  use(columns_of_ruptures);
}
template <class Use>
void each_table(const PlaneRupture *, Use &&use) {
  use(columns_of_ruptures);
  use(columns_of_planes);
}

/// The number in a column of an event, or nullptr if events of its kind have no such column.
template <class Kind>
double *number_in(Kind &event, std::string_view name) {
  double *found = nullptr;
  each_table(&event, [&](const auto &table) {
    for (const auto &column : table)
      if (column.name == name) found = &(event.*column.number);
  });
  return found;
}

/// Adds the names of a table to a list.
template <class Table>
void add_names(std::vector<std::string_view> &names, const Table &table) {
  for (const auto &column : table) names.push_back(column.name);
}

}  // namespace LSM

#endif
