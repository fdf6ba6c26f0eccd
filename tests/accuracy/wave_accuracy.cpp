// SPDX-License-Identifier: GPL-2.0-or-later
// Speeds of P-, S- and Rayleigh waves of the regular lattice compared with closed forms, and of P-
// and S-waves of the random packing, as functions of their length and direction. Runs lmp and
// writes waves_lattice.csv, waves_rayleigh.csv and waves_packing.csv. Usage: lsm_accuracy_waves
// FOLDER full|quick LMP SCENES
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <sstream>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "lattice_waves.h"

namespace {

using lattice_waves::pi;

std::string folder, lmp, scenes;

std::string text(double value) {
  char buffer[32];
  std::snprintf(buffer, sizeof buffer, "%.17g", value);
  return buffer;
}

/// Output of one run of lmp: the lines of its thermo output, and the value of 'frequency = '.
struct Run {
  std::vector<std::pair<double, double>> rows;
  double frequency = 0.0;
};

Run run(const std::string &scene, const std::vector<std::pair<std::string, std::string>> &given) {
  const std::string output = folder + "/work/waves.out";
  std::string command =
      "cd '" + folder + "/work' && '" + lmp + "' -in '" + scenes + "/" + scene + "' -log none";
  for (const auto &v : given) command += " -var " + v.first + " " + v.second;
  if (std::system((command + " > '" + output + "' 2>&1 < /dev/null").c_str()) != 0)
    throw std::runtime_error(command + " failed, see " + output);
  Run result;
  std::ifstream in(output);
  bool rows = false;
  for (std::string line; std::getline(in, line);) {
    std::istringstream split(line);
    const std::vector<std::string> words{std::istream_iterator<std::string>(split), {}};
    if (words.size() == 3 && words[0] == "frequency") result.frequency = std::stod(words[2]);
    if (words.size() == 3 && words[0] == "Step")
      rows = true;
    else if (!words.empty() && words[0] == "Loop")
      rows = false;
    else if (rows && words.size() == 3)
      result.rows.emplace_back(std::stod(words[1]), std::stod(words[2]));
  }
  return result;
}

/// Angular frequency of a standing wave, and the share of its amplitude left after a period.
std::pair<double, double> swing(const Run &r) {
  const std::vector<lattice_waves::Zero> zeros = lattice_waves::zeros(r.rows);
  if (zeros.size() < 3) throw std::runtime_error("too few swings");
  // The first peak is the initial one.
  const double left =
      std::pow(zeros.back().peak / zeros[1].peak, 2.0 / static_cast<double>(zeros.size() - 2));
  return {lattice_waves::frequency(zeros), left};
}

/// A table of the report.
struct File {
  File(const std::string &name, const char *columns)
      : to(std::fopen((folder + "/" + name).c_str(), "w")) {
    if (!to) throw std::runtime_error(folder + "/" + name + ": cannot be written");
    std::fprintf(to, "%s\n", columns);
  }
  ~File() { std::fclose(to); }
  File(const File &) = delete;
  std::FILE *to;
};

void lattice() {
  const File file("waves_lattice.csv",
                  "wave,angle (degrees),spacings per wave,k h,speed / closed form - 1,speed / that "
                  "of long waves - 1 (%)");
  // number of cells along and across the rows, and of waves in either direction: waves along the
  // rows, at 15 degrees to them, and across them
  const int boxes[][4] = {{40, 2, 1, 0}, {20, 2, 1, 0},  {10, 2, 1, 0},  {6, 2, 1, 0},
                          {4, 2, 1, 0},  {26, 56, 1, 1}, {13, 28, 1, 1}, {13, 28, 2, 2},
                          {2, 23, 0, 1}, {2, 12, 0, 1},  {2, 6, 0, 1},   {2, 3, 0, 1}};
  for (const auto &b : boxes)
    for (const bool p : {true, false}) {
      const double kx = 2.0 * pi * b[2] / b[0], ky = 2.0 * pi * b[3] / (std::sqrt(3.0) * b[1]);
      const double k = std::hypot(kx, ky);
      const auto mode = lattice_waves::plane_wave(kx, ky, p);
      const double w = run("standing_wave.in", {{"nx", std::to_string(b[0])},
                                                {"ny", std::to_string(b[1])},
                                                {"px", std::to_string(b[2])},
                                                {"py", std::to_string(b[3])},
                                                {"ux", text(mode.polarisation[0])},
                                                {"uy", text(mode.polarisation[1])},
                                                {"w", text(mode.frequency)}})
                           .frequency;
      const double fast = p ? lattice_waves::vp : lattice_waves::vs;
      std::fprintf(file.to, "%s,%.3g,%.4g,%.4g,%.1e,%.3f\n", p ? "P" : "S",
                   std::atan2(ky, kx) * 180.0 / pi, 2.0 * pi / k, k, w / mode.frequency - 1.0,
                   100.0 * (w / k / fast - 1.0));
    }
}

void rayleigh(bool quick) {
  const File file("waves_rayleigh.csv",
                  "spacings per wave,speed / that of S-waves,against the half-space (%)");
  const double exact = lattice_waves::rayleigh(std::sqrt(3.0));
  for (const int wave : {6, 10, 20, 40}) {
    if (quick && wave > 20) continue;
    const double w = swing(run("rayleigh_wave.in", {{"wave", std::to_string(wave)}})).first;
    const double speed = w * wave / (2.0 * pi) / lattice_waves::vs;
    std::fprintf(file.to, "%d,%.5f,%.3f\n", wave, speed, 100.0 * (speed / exact - 1.0));
  }
}

void packing(bool quick) {
  const File file(
      "waves_packing.csv",
      "wave,angle (degrees),largest radii per wave,speed in the packings (seeds 1 to 3),"
      "amplitude left after a period");
  const struct {
    const char *wave;
    int px, py;
  } modes[] = {{"P", 1, 0}, {"P", 1, 2}, {"P", 0, 2}, {"S", 1, 2}, {"S", 0, 2},
               {"Y", 1, 0}, {"P", 3, 0}, {"P", 0, 6}, {"S", 0, 6}, {"Y", 3, 0}};
  for (const auto &m : modes) {
    const double kx = 2.0 * pi * m.px / 60.0, ky = pi * m.py / 60.0, k = std::hypot(kx, ky);
    std::string speeds;
    double left = 0.0;
    const int seeds = quick ? 1 : 3;
    for (int seed = 1; seed <= seeds; ++seed) {
      const auto s = swing(run("packing_wave.in", {{"wave", m.wave},
                                                   {"px", std::to_string(m.px)},
                                                   {"py", std::to_string(m.py)},
                                                   {"seed", std::to_string(seed)},
                                                   {"until", text(480.0 / k / 60.0 * 6.0)}}));
      char one[16];
      std::snprintf(one, sizeof one, "%s%.3f", seed > 1 ? " " : "", s.first / k);
      speeds += one;
      left += s.second / seeds;
    }
    std::fprintf(file.to, "%s,%.3g,%.3g,%s,%.2f\n", *m.wave == 'P' ? "P" : "S",
                 std::atan2(ky, kx) * 180.0 / pi, 2.0 * pi / k, speeds.c_str(), left);
  }
}

}  // namespace

int main(int argc, char **argv) {
  if (argc != 5 || (std::string(argv[2]) != "full" && std::string(argv[2]) != "quick")) {
    std::fprintf(stderr, "usage: lsm_accuracy_waves FOLDER full|quick LMP SCENES\n");
    return 2;
  }
  folder = argv[1];
  lmp = argv[3];
  scenes = argv[4];
  const bool quick = std::string(argv[2]) == "quick";
  try {
    lattice();
    rayleigh(quick);
    packing(quick);
  } catch (const std::exception &e) {
    std::fprintf(stderr, "lsm_accuracy_waves: %s\n", e.what());
    return 1;
  }
  return 0;
}
