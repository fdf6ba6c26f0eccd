// SPDX-License-Identifier: GPL-2.0-or-later
#include "files/header_keys.h"

#include <cmath>
#include <limits>

#include "files/event.h"
#include "files/names.h"
#include "files/text.h"

namespace LSM {

const std::vector<HeaderKey> &header_keys() {
  using Of = HeaderKey::Of;
  using Type = HeaderKey::Type;
  constexpr Of model = Of::model, recording = Of::recording;
  constexpr Type text = Type::text, number = Type::number, whole = Type::whole;
  constexpr double infinity = std::numeric_limits<double>::infinity();
  constexpr double above_0 = std::numeric_limits<double>::denorm_min();
  constexpr const char *size = "a finite size of at least 0";
  // clang-format off
  static const std::vector<HeaderKey> keys = {
      // of all models
      {"model",              model,     text},
      {"program",            recording, text,   0, 0, nullptr, true},
      {"length",             model,     number, above_0, infinity, "a positive length"},
      {"width",              model,     number},
      {"mass",               model,     text},
      {"velocity",           model,     number},
      {"law",                model,     text},
      {"modulus",            model,     number},
      {"seed",               model,     whole},
      {"dt",                 model,     number, above_0, infinity, "a positive number"},
      {"leap",               model,     text},
      {"completeness",       recording, number, 0, infinity, size},
      // of a fault
      {"particles",          model,     whole},
      {"links",              model,     whole,  0, 0, nullptr, true},
      {"ranks",              model,     whole,  0, 0, nullptr, true},
      {"viscosity",          model,     text},
      {"kelvin_voigt",       model,     text},
      {"checkpoint",         model,     whole},
      // of a block-slider
      {"blocks",             model,     whole,  above_0, infinity, "a positive number of blocks"},
      {"kc",                 model,     number},
      {"kl",                 model,     number},
      {"coupling",           model,     text},
      {"radiation",          model,     number},
      {"friction_low",       model,     number},
      {"friction_high",      model,     number},
      {"correlation_length", model,     number},
      {"dynamic_friction",   model,     number},
      {"scheme",             model,     text},
      {"steps",              model,     whole,  0, 0, nullptr, true},
      {"leap_calm",          model,     number},
      // of events
      {"events",             recording, text},
      {"picker",             recording, Type::reading},
      {"lambda",             recording, number, 0, 1, "a number of at least 0 and less than 1"},
      {"min_size",           recording, number, 0, infinity, size},
      {"keep_nonpositive",   recording, Type::yes_no},
      {"warmup",             recording, number, -infinity, infinity, "a finite time"},
      {"plate_drops",        model,     text},
      {"tangential_energy",  model,     text},
      {"picked_by",          recording, text},
      {"selected",           recording, text},
      {"thinned",            recording, text},
      // of slip and ruptures
      {"slip_bin",           recording, number},
      {"slip_bin_dip",       recording, number},
      {"rupture_fraction",   recording, number},
      {"interval",           recording, whole},
      {"driving",            model,     number},
      {"slipping",           recording, number},
      {"slip_velocity",      model,     number},
      {"gap",                recording, whole},
      {"pause",              recording, number},
      {"rupture_gap",        recording, number},
      // of PE series and slip histories
      {"series",             model,     text},
      {"history",            model,     text},
      {"step0",              model,     whole},
      {"time0",              model,     number},
      {"stride",             recording, whole},
      {"times",              recording, text},
      {"bins",               model,     whole},
      {"x0",                 model,     number},
      {"bin",                model,     number},
      {"memory_intervals",   model,     whole},
      {"quiet",              model,     whole},
      {"ends",               model,     text},
      {"bins_dip",           model,     whole},
      {"z0",                 model,     number},
      {"bin_dip",            model,     number},
      {"ends_dip",           model,     text},
  };
  // clang-format on
  return keys;
}

const HeaderKey *header_key(std::string_view key) {
  const std::size_t end = key.find_last_not_of("0123456789");
  if (end != std::string_view::npos && end + 1 < key.size() && key[end] == '_')
    key = key.substr(0, end);
  for (const HeaderKey &one : header_keys())
    if (one.key == key) return &one;
  return nullptr;
}

std::string bad_value(const std::string &key, const std::string &value) {
  const HeaderKey *const known = header_key(key);
  if (!known || known->key != key) return {};
  const auto expected = [&](const std::string &what) {
    return key + " is " + text::in_quotes(value) + ", expected " + what;
  };
  using Type = HeaderKey::Type;
  const bool whole = known->type == Type::whole;
  double number = 0.0;
  if ((whole || known->type == Type::number) &&
      (!text::parse(value, number) || (whole && number != std::floor(number))))
    return expected(known->expected ? known->expected : whole ? "a whole number" : "a number");
  if (known->expected && !(number >= known->least && number < known->below))
    return expected(known->expected);
  PickerReading reading{};
  if (known->type == Type::reading && !from_string(value, reading))
    return expected(choices(reading));
  if (known->type == Type::yes_no && value != "yes" && value != "no") return expected("yes or no");
  return {};
}

}  // namespace LSM
