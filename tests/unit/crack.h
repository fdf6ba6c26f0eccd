// SPDX-License-Identifier: GPL-2.0-or-later
// A crack with known slip on a plane, for the recorder, for maps and for their readers.
#ifndef LSM_UNIT_CRACK_H
#define LSM_UNIT_CRACK_H

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include "events/ruptures.h"
#include "events/slip_recorder.h"
#include "files/slip_history.h"

namespace unit {

/// An elliptic crack that grows from a point at constant speeds along strike and dip, as Kostrov's,
/// and stops everywhere at once: until then its slip is rate sqrt(t^2 - r^2), where r is the time
/// at which it reaches a place. Nodes are in the middles of the cells.
struct Crack {
  static constexpr double pi = 3.14159265358979323846;
  double x = 4.0, z = -7.0;             ///< hypocentre, in the middle of a cell
  double speed = 2.0, speed_dip = 1.0;  ///< of the tip
  double until = 6.0;                   ///< time at which it stops
  double rate = 0.5;                    ///< slip rate at the hypocentre
  double strike = 0.8, dip = -0.6;      ///< direction of the slip
  double stress = 3.0, drop = 0.25;     ///< before, and fallen by, in that direction
  double modulus = 0.4;
  double seam = 0.0;  ///< period along strike; 0: none

  LSM::FaultGrid grid;

  explicit Crack(double cell = 0.25) {
    grid.plane = true;
    grid.bins = static_cast<int>(std::lround(40.0 / cell));
    grid.rows = static_cast<int>(std::lround(20.0 / cell));
    grid.width = grid.height = cell;
    grid.x0 = x - (std::lround(20.0 / cell) + 0.5) * cell;
    grid.z0 = z - (std::lround(9.0 / cell) + 0.5) * cell;
    grid.ring = false;
    grid.step0 = 100;
    grid.interval = 5;
    grid.dt = 0.25 * cell / grid.interval;
    grid.time0 = 7.0;
  }
  /// Time since its begin at which it reaches a cell.
  double reached(int cell) const {
    double dx = grid.strike().centre(cell / grid.rows) - x;
    if (seam > 0.0) dx = std::remainder(dx, seam);
    return std::hypot(dx / speed, (grid.dip().centre(cell % grid.rows) - z) / speed_dip);
  }
  double slip(int cell, double t) const {
    const double r = reached(cell);
    t = std::min(t, until);
    return t > r ? rate * std::sqrt(t * t - r * r) : 0.0;
  }
  double area() const { return pi * speed * speed_dip * until * until; }
  double moment() const { return moment(until); }
  /// Moment until a time before its end.
  double moment(double t) const {
    return modulus * rate * (2.0 / 3.0) * pi * speed * speed_dip * t * t * t;
  }
  LSM::RuptureSettings settings() const {
    LSM::RuptureSettings s;
    s.velocity = 0.05;
    s.memory = 3;
    s.modulus = modulus;
    return s;
  }
  std::int64_t intervals() const {
    return static_cast<std::int64_t>(std::lround(until / grid.duration())) + 6;
  }

  /// What the recorder makes of the faces and the contacts in interval n, from 1 on; n = 0 is the
  /// state before it, of one step. Each side moves by half of the slip.
  LSM::FaultRow row(std::int64_t n) const {
    LSM::SlipRecorder recorder;
    recorder.begin(grid, 1.0);
    const double begin = static_cast<double>(n - 1) * grid.duration(),
                 end = begin + grid.duration();
    const auto steps = static_cast<double>(n > 0 ? grid.interval : 1);
    std::vector<LSM::FaceDisplacement> faces;
    std::vector<LSM::FaultContact> contacts;
    for (int cell = 0; cell < grid.cells(); ++cell) {
      const double at_x = grid.strike().centre(cell / grid.rows),
                   at_z = grid.dip().centre(cell % grid.rows);
      const double more = n > 0 ? slip(cell, end) - slip(cell, begin) : 0.0;
      for (const double side : {0.5, -0.5})
        faces.push_back({at_x, side * strike * more, steps, side > 0.0, at_z, side * dip * more});
      const double force = (stress - (n > 0 && reached(cell) < end ? drop : 0.0)) * grid.area();
      contacts.push_back(
          {at_x, drop * more * grid.area() / steps, strike * force, 1.0, at_z, dip * force});
    }
    if (n == 0) {
      recorder.add_forces(contacts);
    } else {
      recorder.add(faces);
      for (std::int64_t step = 0; step < grid.interval; ++step) recorder.add(contacts);
    }
    return LSM::fault_row(grid, recorder.sums().data(), n > 0 ? grid.interval : 1);
  }

  /// Writes its history, and returns its ruptures.
  std::vector<LSM::PlaneRupture> record(const std::string &history) const {
    std::vector<LSM::PlaneRupture> events;
    LSM::RuptureFinder finder(grid, settings());
    LSM::SlipHistoryInfo info;
    info.grid = grid;
    info.ruptures = settings();
    info.driving = 0.01;
    info.parameters = {{"ends_dip", "open"}};
    if (!grid.ring) info.parameters.emplace_back("ends", "open");
    LSM::SlipHistoryWriter writer;
    const LSM::FaultRow before = row(0);
    finder.begin(grid.time0, 0.0, before);
    writer.create(history, info, grid.step0, 0.0, before.stress);
    for (std::int64_t n = 1; n <= intervals(); ++n) {
      const LSM::FaultRow now = row(n);
      const std::int64_t step = grid.step0 + n * grid.interval;
      finder.add(grid.time(step), 0.0, now,
                 [&](const LSM::FaultRupture &r) { events.push_back(finder.plane_rupture(r)); });
      writer.add(step, 0.0, now, finder.active());
    }
    writer.close();
    return events;
  }
};

}  // namespace unit

#endif
