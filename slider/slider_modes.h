// SPDX-License-Identifier: GPL-2.0-or-later
/// \file slider_modes.h
/// Forces between blocks that are coupled by a stiffness per mode, with FFTW.
#ifndef SLIDER_MODES_H
#define SLIDER_MODES_H

#include <complex>
#include <memory>
#include <vector>

#include "slider_parameters.h"

struct fftw_plan_s;

namespace Slider {

/// The coupling of a periodic fault: the force on block i is -sum_j C_ij u_j, where C is K(q) less
/// its value at q = 0, the leaf spring, which pulls towards the plate.
///
/// Transforms are planned once, by estimate: measured plans depend on the load of the machine, and
/// so would the last digits. Two objects may be used, made and destroyed at a time by two threads.
/// Numbers of blocks with small prime factors are fastest; any is right.
class ModeForces {
 public:
  /// \param modes stiffness of the modes 0 to blocks / 2
  ModeForces(const std::vector<double> &modes, int blocks);
  ~ModeForces();
  ModeForces(const ModeForces &) = delete;
  ModeForces &operator=(const ModeForces &) = delete;

  /// \param u displacements \param force of the coupling on each block, written
  void find(const double *u, double *force);

 private:
  struct Free {
    void operator()(void *p) const;
  };

  int blocks_;
  std::vector<double> factors_;  // -C / blocks of each mode, for real and imaginary part
  std::unique_ptr<double, Free> values_;
  std::unique_ptr<std::complex<double>, Free> spectrum_;
  fftw_plan_s *forward_, *backward_;
};

/// Those of parameters; none where springs couple.
inline std::unique_ptr<ModeForces> mode_forces(const Parameters &p) {
  return p.by_springs() ? nullptr : std::make_unique<ModeForces>(p.modes, p.blocks);
}

}  // namespace Slider

#endif
