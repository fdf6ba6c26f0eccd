// SPDX-License-Identifier: GPL-2.0-or-later
// Reads output files for the tests of the block-slider.
#ifndef LSM_TESTS_SLIDER_FILES_H
#define LSM_TESTS_SLIDER_FILES_H

#include <cstdint>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include "files/pe_series.h"

namespace Slider {

inline std::string text(const std::string &path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
}

// PE of every sample of a series.
inline std::vector<double> pe_of(const std::string &path) {
  LSM::PeSeriesReader series(LSM::files::open_plain(path));
  std::vector<double> pe;
  std::int64_t step = 0;
  double time = 0.0, value = 0.0;
  while (series.next(step, time, value)) pe.push_back(value);
  return pe;
}

}  // namespace Slider

#endif
