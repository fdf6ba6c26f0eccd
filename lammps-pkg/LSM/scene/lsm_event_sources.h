// SPDX-License-Identifier: GPL-2.0-or-later
// The styles of a scene whose energies and works compute lsm/events records, found anew for each
// run

#ifndef LMP_LSM_EVENT_SOURCES_H
#define LMP_LSM_EVENT_SOURCES_H

#include "events/event_headers.h"
#include "fault/energy_ledger.h"
#include "lsm_energy.h"
#include "pointers.h"

#include <vector>

namespace LAMMPS_NS {
class BondLSMLinked;
class Fix;
class FixLSMLeap;
class FixLSMNVE;
class FixLSMPlates;

class LSMEventSources : protected Pointers {
 public:
  LSMEventSources(LAMMPS *, const LSM::EventSettings &);
  /// Stops if something in the scene does not work with recording, and warns of energies that are
  /// not recorded.
  /// \param recorder the fix that records
  void check(const Fix *recorder, bool ledger) const;
  /// Stops if the scene lacks something that the settings need; makes the styles record what they
  /// require.
  void find(bool ledger);
  /// Stops recording in those styles that still exist.
  void release();
  /// Completes the settings of slip with those of the scene.
  void find_driving(LSM::EventSettings &) const;

  /// The styles that record contacts.
  const std::vector<LSMEnergySource *> &styles() const { return styles_; }
  FixLSMLeap *leap() const { return leap_; }    ///< null if steps and time are proportional
  /// Bit of the group of the lower (0) or upper (1) face of the fault.
  int face(int upper) const { return upper ? faces_.second : faces_.first; }
  bool has_links() const { return links_; }

  double pe() const;    ///< this rank's share
  /// This rank's share of the PE of links, contacts and tangential springs: three numbers.
  void pe_by_kind(double *) const;
  double max_strain() const;            ///< of this rank's links
  LSM::EnergyTerms energies() const;    ///< of all ranks; works since these styles began
  LSM::SceneInfo scene() const;
  /// The variables of lsm_variables that headers state. The settings of a style in use take
  /// precedence.
  LSM::files::Parameters variables() const;

 private:
  std::pair<int, int> bits_of(const char *keyword, const LSM::TwoSides &) const;
  void find_sides(LSMEnergySource &) const;
  void find_velocity(LSM::EventSettings &) const;

  const LSM::EventSettings &settings_;
  std::pair<int, int> faces_ = {0, 0};
  BondLSMLinked *links_ = nullptr;
  std::vector<LSMEnergySource *> styles_;
  FixLSMPlates *plates_ = nullptr;
  FixLSMLeap *leap_ = nullptr;
  std::vector<FixLSMNVE *> integrators_;
  std::vector<LSMWorkSource *> works_;
};

}    // namespace LAMMPS_NS

#endif
