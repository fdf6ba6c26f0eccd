// SPDX-License-Identifier: GPL-2.0-or-later
// What a contact loop records about its contacts. The loop is compiled once for each recorder, so
// that runs that record nothing have no cost.

#ifndef LMP_LSM_CONTACT_RECORDER_H
#define LMP_LSM_CONTACT_RECORDER_H

#include "lsm_energy.h"

#include <cmath>

namespace LAMMPS_NS {

/// Records nothing.
struct LSMRecordNothing {
  static constexpr bool records = false, tallies = false;

  LSMRecordNothing(LSMEnergySource &, bool) {}
  void finish() {}
};

/// Records energies, and contacts across the fault if requested. `share` is this rank's share of a
/// contact.
class LSMRecordEnergies {
 public:
  static constexpr bool records = true, tallies = false;

  /// \param setup whether this is the setup of a run, for a step whose slip was counted before
  LSMRecordEnergies(LSMEnergySource &source, bool setup) :
      source_(source), counts_(!setup),
      slips_(!setup && (source.record_what & LSMEnergySource::SLIP_RATE))
  {
    if (source.record_what) source_.contacts.clear();
  }
  void springs(double share, double normal, double tangential)
  {
    normal_ += share * normal;
    tangential_ += share * tangential;
  }
  void dissipation(double share, double work)
  {
    if (counts_) lost_ += share * work;
  }
  /// \param moment slip times size of the contact
  void slip(double share, double moment)
  {
    if (slips_) moment_ += share * moment;
  }
  void within(double share, double work)
  {
    if (counts_) within_ += share * work;
  }
  /// Whether contacts across the fault are recorded one by one, as compute lsm/events requests to
  /// find ruptures.
  bool wants_contacts() const { return source_.record_what & LSMEnergySource::CONTACTS; }
  void contact(const LSM::FaultContact &one) { source_.contacts.push_back(one); }
  void finish()
  {
    if (!source_.record_what) return;
    source_.pe_contact = normal_;
    source_.pe_tangential = tangential_;
    source_.work_friction += lost_;
    source_.work_within += within_;
    source_.slip_moment += moment_;
  }

 private:
  LSMEnergySource &source_;
  const bool counts_, slips_;
  double normal_ = 0.0, tangential_ = 0.0, lost_ = 0.0, within_ = 0.0, moment_ = 0.0;
};

/// Also tallies LAMMPS' own energy and virial, which the loop passes to the pair style.
struct LSMRecordAndTally : LSMRecordEnergies {
  static constexpr bool tallies = true;
  using LSMRecordEnergies::LSMRecordEnergies;
};

}    // namespace LAMMPS_NS

#endif
