// SPDX-License-Identifier: GPL-2.0-or-later
/// \file magnitude_options.h
/// How the commands make magnitudes of events.
#ifndef LSM_POSTPROC_MAGNITUDE_OPTIONS_H
#define LSM_POSTPROC_MAGNITUDE_OPTIONS_H

#include <string>

#include <CLI/CLI.hpp>

#include "lsm_catalogue.h"
#include "magnitudes.h"

namespace LSM::postproc {

struct MagnitudeOptions {
  MagnitudeScale scale;
  double bin = 0.0;        ///< width of the bins; 0: none
  bool of_moment = false;  ///< of the slip moment, not of the size

  /// Adds --magnitude-of, --magnitude-slope, --magnitude-constant and --magnitude-bin.
  void add_to(CLI::App *command, const std::string &group);
  /// \throws std::invalid_argument for impossible values
  void check() const;
  /// Column name of what the magnitude is of.
  std::string of() const { return of_moment ? "slip_moment" : "size"; }
  double quantity(const Event &event) const { return of_moment ? event.slip_moment : event.size; }
  /// \throws std::runtime_error if the catalogue lacks the column
  void require(const std::string &path, const CatalogueInfo &info) const;
  double magnitude(const Event &event) const { return binned(scale.of(quantity(event)), bin); }
};

}  // namespace LSM::postproc

#endif
