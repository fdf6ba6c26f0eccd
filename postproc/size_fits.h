// SPDX-License-Identifier: GPL-2.0-or-later
/// \file size_fits.h
/// Exponents of the event sizes (paper: Sect. 4.2), and whether the roll-off moves with the length
/// of the fault, the question the paper left open.
#ifndef LSM_POSTPROC_SIZE_FITS_H
#define LSM_POSTPROC_SIZE_FITS_H

#include <cstdint>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "catalogue_input.h"
#include "finite_size.h"
#include "numbers.h"
#include "plot.h"
#include "power_law.h"
#include "size_densities.h"

namespace LSM::postproc {

struct SizeFitSettings {
  std::vector<Range> ranges;  ///< of sizes (model energy); none: the range is searched
  RangeSearch search;         ///< how it is searched
  Threshold threshold;        ///< smallest size of the search
  int replicas = 100;         ///< of the Monte Carlo p-value; 0: none
  std::uint64_t seed = 1;
  bool compare = true;  ///< with the rivals of compare()
};

/// One catalogue on one range.
struct SizeFit {
  std::string label, model;
  std::size_t catalogue = 0;  ///< index among the catalogues
  double completeness = 0.0;  ///< in the header of the catalogue; 0: not said
  PowerLawFit fit;
  double p = std::numeric_limits<double>::quiet_NaN();        ///< NaN: not computed
  double p_error = std::numeric_limits<double>::quiet_NaN();  ///< of its Monte Carlo estimate
  std::vector<Comparison> comparisons;
};

/// Every catalogue on every range. \throws std::invalid_argument for impossible settings
std::vector<SizeFit> fit_sizes(const std::vector<EventTable> &tables,
                               const SizeFitSettings &settings);

/// "0.001 to 1", with what search_range() found marked.
std::string range_text(const PowerLawFit &fit);
std::string size_fits_text(const std::vector<SizeFit> &fits);
Table size_fits_csv(const std::vector<SizeFit> &fits);
nlohmann::json to_json(const SizeFit &fit);

/// Density of the whole catalogue along the fitted law, for size_density_figure().
/// \param settings those of the densities, which set the normalisation
PowerLine fitted_line(const SizeFit &fit, const EventTable &table,
                      const SizeDensitySettings &settings);

/// Which law a comparison that is not degenerate favours; p below 0.05 decides (ours).
const char *favoured(const Comparison &comparison);
/// favoured() with the numbers, or "degenerate: why".
std::string verdict(const Comparison &comparison);

/// Characteristic sizes of the catalogues of one model and kind of event against their lengths.
struct Scaling {
  std::string model;
  bool ruptures = false;  ///< events are ruptures, not drops of the total PE
  std::string stiffness;  ///< block-slider: kl of the header; "" if there is none
  double threshold = 0.0;
  std::string threshold_text;  ///< with where it comes from
  std::vector<std::string> labels;
  std::vector<SizePoint> points;
  ScalingFit fit;

  std::string name() const;     ///< of the model, with the kind of event and the stiffness
  bool drawable() const;        ///< has a point that is not degenerate
  bool by_event() const;        ///< errors are not those of blocks of time
  std::string verdict() const;  ///< one sentence
};

/// One per model, kind of event and stiffness of the leaf springs; catalogues without a length are
/// left out.
std::vector<Scaling> scale_sizes(const std::vector<EventTable> &tables, const Threshold &threshold,
                                 const Resampling &resampling);

/// Resampling::block from "auto" or a time. \throws std::invalid_argument naming --block
double parse_block(const std::string &text);
constexpr const char *block_help =
    "Length of the stretches of time that are resampled for these errors, since events come in "
    "sequences (model time): auto, from the correlation of each catalogue (Politis and White "
    "2004); "
    "or 0, events one by one as if independent";

std::string scaling_text(const Scaling &scaling);
nlohmann::json to_json(const Scaling &scaling);

/// s* against length with error bars, the fitted power law, the constant and, where it is
/// preferred, growth that ends. \throws std::runtime_error if no point can be drawn
Figure scaling_figure(const std::vector<Scaling> &scalings, int width = 900);

}  // namespace LSM::postproc

#endif
