// SPDX-License-Identifier: GPL-2.0-or-later

#include "lsm_event_options.h"

#include "lsm_keyword_reader.h"

#include <algorithm>

using namespace LAMMPS_NS;
using LSM::Action;
using LSM::EventKind;
using LSM::Keywords;
using LSM::Must;

static const std::string STYLE = "Compute lsm/events";

/// Reads the kind of events before everything else, as the keywords depend on it.
static std::shared_ptr<EventKind> kind_of_events(LAMMPS *lmp, int first, int narg, char **arg)
{
  LSMKeywordReader in(lmp, STYLE, first, narg, arg);
  auto kind = LSM::all_event_kinds().front();
  while (in.next()) {
    in.need(in.key() == "parameter" || in.key() == "sides" || in.key() == "faces" ? 2 : 1);
    if (in.key() != "events") continue;
    kind = LSM::make_event_kind(in.text());
    if (!kind)
      in.stop(std::string("events is '") + in.text() + "', but must be " +
              LSM::names_of_kinds([](const EventKind &) { return true; }));
  }
  return kind;
}

LSMEventOptions::LSMEventOptions(LAMMPS *lmp, int first, int narg, char **arg)
{
  events.kind = kind_of_events(lmp, first, narg, arg);
  LSMKeywordReader in(lmp, STYLE, first, narg, arg);
  Keywords table = of_all(in);
  for (const Keywords &more :
       {events.kind->keywords(), events.kind->wants_intervals() ? of_intervals(in) : Keywords()})
    table.insert(table.end(), more.begin(), more.end());
  while (in.next())
    if (!in.read(table)) no_such_keyword(in);
  ledger = ledger || watchdog.tolerance > 0.0;
  if (emergency_file.find_first_of("*%") != std::string::npos)
    in.stop("emergency is " + emergency_file +
            ", but must be the name of one file, without * and %");
}

Keywords LSMEventOptions::of_all(LSMKeywordReader &in)
{
  const auto reading = [this, &in] {
    if (!LSM::from_string(in.text(), events.picker.reading))
      in.stop(std::string("picker is '") + in.text() + "', but must be " +
              LSM::choices(events.picker.reading));
  };
  const auto parameter = [this, &in] { events.parameters.emplace_back(in.text(1), in.text(2)); };
  const auto groups = [&in](LSM::TwoSides &two) {
    two = {in.text(1), in.text(2)};
    if (two.lower == two.upper)
      in.stop(in.key() + " needs two different groups, got " + two.lower + " twice");
  };
  return {{"events", Action{1, [] {}}},    // read already
          {"picker", Action{1, reading}},
          {"parameter", Action{2, parameter}},
          {"lambda", &events.picker.lambda, Must::fraction},
          {"memory", &memory_time, Must::positive},
          {"minsize", &events.picker.min_size, Must::not_negative},
          {"nonpositive", &events.picker.keep_nonpositive},
          {"tangential", &events.tangential},
          {"sides", Action{2, [this, groups] { groups(events.sides); }}},
          {"faces", Action{2, [this, groups] { groups(events.faces); }}},
          {"bin", &events.bin_width, Must::positive},
          {"catalogue", &events.catalogue_file},
          {"series", file_or_none(in, events.series_file)},
          {"stride", &events.series_stride, Must::positive},
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

// "none" stands for no file; headers state it
LSM::Action LSMEventOptions::file_or_none(LSMKeywordReader &in, std::string &file)
{
  return {1, [this, &in, &file] {
            file = in.text();
            if (file != "none") return;
            file.clear();
            events.parameters.emplace_back(in.key(), "none");
          }};
}

// keywords of kinds that need the fault in intervals
Keywords LSMEventOptions::of_intervals(LSMKeywordReader &in)
{
  return {{"history", file_or_none(in, events.history_file)},
          {"quiet", &events.quiet, Must::positive},
          {"driving", &events.driving, Must::positive},
          {"interval", &events.interval, Must::positive},
          {"modulus", &events.modulus, Must::positive},
          {"unfinished", &unfinished}};
}

void LSMEventOptions::no_such_keyword(LSMKeywordReader &in)
{
  const auto holds = [&in](const Keywords &table) {
    return std::any_of(table.begin(), table.end(),
                       [&in](const LSM::Keyword &k) { return in.key() == k.name; });
  };
  const std::string needed = LSM::names_of_kinds([&](EventKind &kind) {
    return holds(kind.keywords()) || (kind.wants_intervals() && holds(of_intervals(in)));
  });
  if (!needed.empty()) in.stop("keyword " + in.key() + " needs events " + needed);

  Keywords all = of_all(in);
  const auto add = [&all](const Keywords &more) {
    all.insert(all.end(), more.begin(), more.end());
  };
  add(of_intervals(in));
  const auto kinds = LSM::all_event_kinds();
  for (const auto &kind : kinds) add(kind->keywords());
  in.unknown(all);
}
