/* -*- c++ -*- ----------------------------------------------------------
   SPDX-License-Identifier: GPL-2.0-or-later
   Lattice Solid Model: box, particles and links of a fault between two blocks
------------------------------------------------------------------------- */

#ifdef COMMAND_CLASS
// clang-format off
CommandStyle(create_lsm_fault,CreateLSMFault);
// clang-format on
#else

#ifndef LMP_CREATE_LSM_FAULT_H
#define LMP_CREATE_LSM_FAULT_H

#include "command.h"

#include <vector>

namespace LSM {
struct Packing;
struct PackingSettings;
}    // namespace LSM

namespace LAMMPS_NS {

class CreateLSMFault : public Command {
 public:
  CreateLSMFault(class LAMMPS *);
  void command(int, char **) override;

 private:
  int mass_power;    // mass = mass_scale * radius^mass_power
  double mass_scale;
  double mass_floor;    // smaller masses are raised to it
  double margin;        // empty space beyond each plate
  double stiffness;     // of the links, for the estimate of the time step only

  double mass_of(double radius) const;    // before the floor
  void check_setup();
  void parse(int, char **, LSM::PackingSettings &);
  void pack(const LSM::PackingSettings &, LSM::Packing &);
  void create_box(double, double, int);
  void add_particles(const LSM::Packing &, const std::vector<double> &, const std::vector<int> &);
  void report(const LSM::PackingSettings &, const LSM::Packing &, const std::vector<double> &);
};

}    // namespace LAMMPS_NS

#endif
#endif
