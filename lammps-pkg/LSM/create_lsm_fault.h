// SPDX-License-Identifier: GPL-2.0-or-later
// Lattice Solid Model: box, particles and links of a fault between two blocks

#ifdef COMMAND_CLASS
// clang-format off
CommandStyle(create_lsm_fault,CreateLSMFault);
// clang-format on
#else

#ifndef LMP_CREATE_LSM_FAULT_H
#define LMP_CREATE_LSM_FAULT_H

#include "command.h"

#include <functional>

namespace LSM {
class CubicLattice;
struct Keyword;
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
  int cubed = 0;    // mass = mass_scale * radius^2, or ^3
  double mass_scale = 1.0;
  double step = 0.0;         // time step for which masses are raised until it is stable; 0: none
  double step_kt = 0.0;      // tangential stiffness of contacts, for step
  double margin = 2.0;       // empty space beyond each plate
  double stiffness = 1.0;    // of links and contacts, for step
  bool lattice = false;      // mirrored rows of equal discs, not a random packing
  bool cubic = false;        // in three dimensions
  double diameter = 0.0;     // of the nodes of a cubic lattice
  int types;                 // number of atom types

  void check_setup();
  void check_box_and_dimension();
  LSM::CubicLattice parse_cubic(int, char **);
  void create_cubic(const LSM::CubicLattice &);
  void parse(int, char **, LSM::PackingSettings &);
  void parse(int, char **, LSM::LatticeSettings &);
  void read(class LSMKeywordReader, std::vector<LSM::Keyword>,
            const std::vector<const char *> &required);
  void pack(LSM::Packing &, const std::function<LSM::Packing()> &make);
  double mass_of(double radius) const;    // before the floor
  std::vector<double> masses_of(const LSM::Packing &, double length) const;
  int most_links_stored(const LSM::Packing &) const;
  std::string box_of(const LSM::LatticeSettings &) const;
  std::string box_of(const LSM::PackingSettings &) const;
  void create_box(const std::string &limits, int link_types, int bonds_per_atom);
  void add_particle(bigint id, int type, const double *x, double radius, double mass, int block);
  bool is_mine(const double *x) const;
  void finish_particles(bigint count, bigint links);
  void add_particles(const LSM::Packing &, const std::vector<double> &masses);
  void add_links(const LSM::Packing &, const std::vector<int> &);
  void report_types(bigint links, const std::vector<bigint> &of_types);
  void report(const LSM::PackingSettings &, const LSM::Packing &);
  void report_masses(const LSM::Packing &, const std::vector<double> &);
};

}    // namespace LAMMPS_NS

#endif
#endif
