// SPDX-License-Identifier: GPL-2.0-or-later

#include "lsm_event_options.h"

#include "domain.h"
#include "lsm_keyword_reader.h"
#include "lsm_script.h"

using namespace LAMMPS_NS;
using LSM::Action;
using LSM::Keywords;
using LSM::Must;

static const std::string STYLE = "Compute lsm/events";

LSMEventOptions::LSMEventOptions(LAMMPS *lmp, int first, int narg, char **arg)
{
  LSMKeywordReader in(lmp, STYLE, first, narg, arg);
  std::string prefix;
  in.read_all(keywords(in, prefix));
  const auto named = [&](const char *key, std::string &file, const char *ending) {
    if (file == "yes" && prefix.empty())
      in.stop(std::string(key) + " is 'yes', but there is no prefix");
    if (file == "yes") file = prefix + ending;
    if (file == "no" || file == "none") file.clear();
  };
  named("series", events.series_file, ".pe.bin");
  named("ruptures", events.ruptures_file, ".ruptures.csv");
  named("history", events.history_file, ".slip.bin");
  events.no_series = in.has("series") && events.series_file.empty();
  events.no_history = in.has("history") && events.history_file.empty();
  ledger = ledger || watchdog.tolerance > 0.0;
  events.ruptures.keep_nonpositive = events.drops.keep_nonpositive;
  LSMScript::require_plain(lmp, STYLE + ": emergency", emergency_file);
  if (lmp->domain->dimension == 3)
    for (const char *of_lines : {"location", "fraction"})
      if (in.has(of_lines))
        in.stop(std::string("keyword ") + of_lines +
                " needs dimension 2: drops are located along a line; use ruptures in three "
                "dimensions");
  if (!events.finds_ruptures())
    for (const char *of_ruptures :
         {"slipping", "driving", "gap", "pause", "minwork", "quiet", "unfinished"})
      if (in.has(of_ruptures))
        in.stop(std::string("keyword ") + of_ruptures + " needs ruptures or history");
}

Keywords LSMEventOptions::keywords(LSMKeywordReader &in, std::string &prefix)
{
  const auto reading = [this, &in] {
    if (!LSM::from_string(in.text(), events.picker.reading))
      in.stop(std::string("picker is '") + in.text() + "', but must be " +
                  LSM::choices(events.picker.reading),
              1);
  };
  const auto parameter = [this, &in] {
    events.parameters.emplace_back(in.text(1), in.text(2));
  };
  const auto groups = [&in](LSM::TwoSides &two) {
    two = {in.text(1), in.text(2)};
    if (two.lower == two.upper)
      in.stop(in.key() + " needs two different groups, got " + two.lower + " twice");
  };
  return {{"catalogue", &events.catalogue_file},
          {"prefix", &prefix},
          {"series", &events.series_file},
          {"stride", &events.series_stride, Must::positive},
          {"picker", Action{1, reading}},
          {"lambda", &events.picker.lambda, Must::fraction},
          {"memory", &memory_time, Must::not_negative},
          {"minsize", &events.drops.min_size, Must::not_negative},
          {"nonpositive", &events.drops.keep_nonpositive},
          {"tangential", &events.tangential},
          {"location", &events.location},
          {"fraction", &events.fraction, Must::fraction},
          {"faces",
           Action{2,
                  [this, groups] {
                    groups(events.faces);
                  }}},
          {"sides",
           Action{2,
                  [this, groups] {
                    groups(events.sides);
                  }}},
          {"bin", &events.bin_width, Must::positive},
          {"interval", &events.interval, Must::positive},
          {"modulus", &events.modulus, Must::positive},
          {"ruptures", &events.ruptures_file},
          {"history", &events.history_file},
          {"slipping", &events.slipping, Must::not_negative},
          {"driving", &events.driving, Must::positive},
          {"gap", &events.gap, Must::not_negative},
          {"pause", &events.pause, Must::not_negative},
          {"minwork", &events.ruptures.min_size, Must::not_negative},
          {"quiet", &events.quiet, Must::positive},
          {"unfinished", &unfinished},
          {"parameter", Action{2, parameter}},
          {"resume", &events.resume},
          {"overwrite", &events.overwrite},
          {"block", &block, Must::positive},
          {"ledger", &ledger},
          {"tolerance", &watchdog.tolerance, Must::positive},
          {"emergency", &emergency_file},
          {"strainlimit", &watchdog.strain_limit, Must::positive},
          {"check", &watchdog.every, Must::positive},
          {"progress", &progress}};
}
