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

#include <string>
#include <vector>

namespace LSM {
struct LatticeSettings;
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
  double step;          // masses are raised so that it is stable with any contacts; 0: not
  double step_kt;       // tangential stiffness of these
  double margin;        // empty space beyond each plate
  double stiffness;     // of links and contacts, for step
  bool lattice;         // mirrored rows of equal discs, not a random packing
  int types;            // of atoms

  double mass_of(double radius) const;    // before the floor
  std::vector<double> masses_of(const LSM::Packing &) const;
  void check_setup();
  void parse(int, char **, LSM::PackingSettings &);
  void parse(int, char **, LSM::LatticeSettings &);
  void parse_mass(const char *, const char *);
  void parse_types(const char *);
  double positive(const std::string &, const char *) const;
  template <class Make> void pack(Make &&, LSM::Packing &);
  void create(const double *, const double *, const LSM::Packing &, const std::vector<double> &);
  void create_box(const double *, const double *, int);
  void add_particles(const LSM::Packing &, const std::vector<double> &, const std::vector<int> &);
  void report_types(const LSM::Packing &);
  void report(const LSM::PackingSettings &, const LSM::Packing &, const std::vector<double> &);
};

}    // namespace LAMMPS_NS

#endif
#endif
