// SPDX-License-Identifier: GPL-2.0-or-later
// Time to read catalogues of earthquakes, and how it grows with the number of events: N is linear.
#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include <string>

#include "earthquakes.h"
#include "text_bytes.h"

namespace {

using namespace LSM::postproc;

std::string quakeml(std::int64_t events) {
  std::string text = "<quakeml><eventParameters>\n";
  for (std::int64_t i = 0; i < events; ++i)
    text += fmt::format(
        "<event publicID=\"smi:x/{0}\">\n <type>earthquake</type>\n <origin publicID=\"smi:x/o{0}\">\n"
        "  <time><value>2000-01-01T00:00:00Z</value></time>\n"
        "  <latitude><value>1</value></latitude><longitude><value>2</value></longitude>\n"
        "  <comment><text>{1}</text></comment>\n </origin>\n"
        " <magnitude publicID=\"smi:x/m{0}\"><mag><value>3.1</value></mag></magnitude>\n</event>\n",
        i, std::string(1500, 'x'));
  return text + "</eventParameters></quakeml>\n";
}

std::string columns(std::int64_t events) {
  std::string text = "time,latitude,longitude,depth,mag,type\n";
  for (std::int64_t i = 0; i < events; ++i)
    text += "2000-01-01T00:00:00.00Z,33.724,-118.832,0.6,2.27,earthquake\n";
  return text;
}

void read(benchmark::State &state, std::string (*text_of)(std::int64_t)) {
  const std::string text = text_of(state.range(0));
  for (auto _ : state) {
    unit::TextBytes bytes(text, "file");
    benchmark::DoNotOptimize(read_earthquakes(bytes, detect_format(text), false));
  }
  state.SetComplexityN(state.range(0));
  state.SetItemsProcessed(state.iterations() * state.range(0));
}

BENCHMARK_CAPTURE(read, quakeml, quakeml)->RangeMultiplier(4)->Range(1024, 65536)->Complexity();
BENCHMARK_CAPTURE(read, columns, columns)->RangeMultiplier(4)->Range(1024, 65536)->Complexity();

}  // namespace

BENCHMARK_MAIN();
