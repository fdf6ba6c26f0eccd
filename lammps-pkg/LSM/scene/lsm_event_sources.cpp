// SPDX-License-Identifier: GPL-2.0-or-later

#include "lsm_event_sources.h"

#include "atom.h"
#include "bond_lsm_linked.h"
#include "comm.h"
#include "domain.h"
#include "error.h"
#include "fix.h"
#include "fix_lsm_leap.h"
#include "fix_lsm_nve.h"
#include "fix_lsm_plates.h"
#include "force.h"
#include "group.h"
#include "modify.h"
#include "pair_lsm_free.h"
#include "update.h"

#include "files/parameters.h"
#include "files/text.h"
#include "lsm_fixes.h"
#include "lsm_ranks.h"
#include "lsm_scene.h"
#include "lsm_script.h"
#include "lsm_version.h"

#include <cmath>

using namespace LAMMPS_NS;

LSMEventSources::LSMEventSources(LAMMPS *_lmp, const LSM::EventSettings &settings) :
    Pointers(_lmp), settings_(settings)
{
}

void LSMEventSources::check(const Fix *recorder, bool ledger) const
{
  const std::string &id = settings_.name;
  if (update->whichflag == 0) return;
  if (update->whichflag == 2)
    error->all(FLERR, Error::NOLASTLINE,
               "Compute lsm/events does not work with minimize: it records the steps of a "
               "run; uncompute it first");
  if (LSMScene::is_rerun(lmp))
    error->all(FLERR, Error::NOLASTLINE,
               "Compute lsm/events does not work with rerun: it records the steps of a run; "
               "use thermo keyword pe for the energies of snapshots");

  // the strain of links is checked before particles move to other ranks
  for (const auto &ifix : modify->get_fix_list()) {
    if (ifix == recorder) break;
    if (ifix->pre_exchange_migrate)
      error->all(FLERR, Error::NOLASTLINE,
                 "Compute lsm/events {} must be defined before fix {}, which moves particles to "
                 "other ranks",
                 id, ifix->id);
  }
  if (ledger)
    for (const char *adds_or_takes : {"^pour", "^deposit", "^evaporate"})
      for (const auto &other : modify->get_fix_by_style(adds_or_takes))
        error->all(
            FLERR, Error::NOLASTLINE,
            "Compute lsm/events {}: the energy ledger does not include the particles that fix {} "
            "adds or removes; use ledger no and no tolerance",
            id, other->id);
  const std::string foreign = LSMScene::foreign_forces(force);
  if (!foreign.empty() && comm->me == 0)
    error->warning(FLERR,
                   "Compute lsm/events {}: PE, events and ledger do not include the energy of {}",
                   id, foreign);
}

void LSMEventSources::find(bool ledger)
{
  links_ = dynamic_cast<BondLSMLinked *>(force->bond_match("lsm/linked"));
  const auto contacts = LSMScene::contact_styles(force);
  if (!links_ && contacts.empty())
    error->all(FLERR, Error::NOLASTLINE,
               "Compute lsm/events needs bond style lsm/linked or pair style lsm/free or "
               "lsm/friction");
  if (settings_.records_slip() && !force->pair_match("lsm/friction", 1))
    error->all(FLERR, Error::NOLASTLINE, "Compute lsm/events {} needs pair style lsm/friction",
               settings_.asked_by());

  styles_.clear();
  if (links_) styles_.push_back(links_);
  styles_.insert(styles_.end(), contacts.begin(), contacts.end());
  for (auto *style : styles_) {
    style->record_what |= LSMEnergySource::ENERGY;
    if (!settings_.finds_ruptures()) continue;
    style->record_what |= LSMEnergySource::CONTACTS;
    find_sides(*style);
  }

  if (settings_.records_slip()) faces_ = bits_of("faces", settings_.faces);

  plates_ = nullptr;
  leap_ = nullptr;
  works_ = lsm_fixes<LSMWorkSource>(modify);
  for (const auto &ifix : modify->get_fix_list()) {
    if (auto p = dynamic_cast<FixLSMPlates *>(ifix)) {
      if (plates_)
        error->all(FLERR, Error::NOLASTLINE,
                   "Compute lsm/events {}: fixes {} and {} are both lsm/plates, expected one",
                   settings_.name, plates_->id, p->id);
      plates_ = p;
    }
    if (auto p = dynamic_cast<FixLSMLeap *>(ifix)) leap_ = p;
  }
  integrators_ = lsm_fixes<FixLSMNVE>(modify);
  if (ledger)
    for (auto *p : integrators_) p->record_work = true;
}

// bits of the two groups of a keyword
std::pair<int, int> LSMEventSources::bits_of(const char *keyword, const LSM::TwoSides &groups) const
{
  if (groups.lower.empty())
    error->all(
        FLERR, Error::NOLASTLINE,
        "Compute lsm/events {} needs the keyword {} with the groups below and above the fault",
        settings_.asked_by(), keyword);
  const auto bit = [&](const std::string &name) {
    const int found = group->find(name);
    if (found < 0 || group->count(found) == 0)
      error->all(FLERR, Error::NOLASTLINE, "Compute lsm/events {}: {} has the group {}, which {}",
                 settings_.name, keyword, name, found < 0 ? "does not exist" : "has no particles");
    return group->bitmask[found];
  };
  return {bit(groups.lower), bit(groups.upper)};
}

// contacts between particles of one side are not part of the fault
void LSMEventSources::find_sides(LSMEnergySource &style) const
{
  const auto [lower, upper] = bits_of("sides", settings_.sides);
  if (style.lower_side && (style.lower_side != lower || style.upper_side != upper))
    error->all(FLERR, Error::NOLASTLINE,
               "Compute lsm/events {}: sides differ from those of another compute lsm/events",
               settings_.name);
  style.lower_side = lower;
  style.upper_side = upper;
}

// Styles may have been deleted, so they are looked up again.
void LSMEventSources::release()
{
  if (force) {
    if (auto p = dynamic_cast<LSMEnergySource *>(force->bond_match("lsm/linked")))
      p->record_nothing();
    for (auto *p : LSMScene::contact_styles(force)) p->record_nothing();
  }
  if (modify)
    for (auto *p : lsm_fixes<FixLSMNVE>(modify)) p->record_work = false;
}

// finds references for the slip of the fault: velocity and direction of the plates, and stiffness
// of the links
void LSMEventSources::find_driving(LSM::EventSettings &settings) const
{
  if (plates_ && plates_->driving_velocity() < 0.0) settings.forward = -1.0;
  if (settings.finds_ruptures()) find_velocity(settings);
  if (settings.modulus > 0.0) return;
  if (domain->dimension == 3)
    error->all(FLERR, Error::NOLASTLINE,
               "Compute lsm/events {} needs the keyword modulus in three dimensions",
               settings.asked_by());
  if (!links_)
    error->all(FLERR, Error::NOLASTLINE,
               "Compute lsm/events {} needs bond style lsm/linked, or the keyword modulus",
               settings.asked_by());
  int dim;
  const auto *stiffness = static_cast<const double *>(links_->extract("k", dim));
  settings.modulus = 0.25 * sqrt(3.0) * stiffness[1];    // of the regular lattice of equal discs
}

void LSMEventSources::find_velocity(LSM::EventSettings &settings) const
{
  if (settings.driving == 0.0 && leap_) settings.driving = 2.0 * leap_->fastest();
  if (settings.driving == 0.0 && plates_)
    settings.driving = 2.0 * fabs(plates_->driving_velocity());
  if (settings.driving == 0.0)
    error->all(FLERR, Error::NOLASTLINE, "Compute lsm/events {} needs {}, or the keyword driving",
               settings.asked_by(),
               plates_ ? "a velocity of fix lsm/plates that is not 0" : "fix lsm/plates");
}

double LSMEventSources::pe() const
{
  double pe = 0.0;
  for (const auto *style : styles_) {
    pe += style->pe_link + style->pe_contact;
    if (settings_.tangential) pe += style->pe_tangential;
  }
  return pe;
}

void LSMEventSources::pe_by_kind(double *pe) const
{
  pe[0] = pe[1] = pe[2] = 0.0;
  for (const auto *style : styles_) {
    pe[0] += style->pe_link;
    pe[1] += style->pe_contact;
    pe[2] += style->pe_tangential;
  }
}

double LSMEventSources::max_strain() const
{
  return links_ ? links_->max_strain() : 0.0;
}

// the tangential springs belong to the balance even if they are not counted as potential energy
LSM::EnergyTerms LSMEventSources::energies() const
{
  double potential = 0.0, friction = 0.0, viscosity = 0.0, outside = 0.0, absorbed = 0.0,
         within = 0.0;
  for (const auto *style : styles_) {
    potential += style->pe_link + style->pe_contact + style->pe_tangential;
    friction += style->work_friction;
    within += style->work_within;
  }
  for (const auto *p : integrators_) viscosity += p->work_viscosity;
  for (const auto *p : works_) {
    outside += p->work_outside;
    absorbed += p->work_absorbed;
    viscosity += p->work_dashpots;
  }
  LSM::EnergyTerms terms;

  // plates count with their motion across the fault only, as the energy of the driven motion is no
  // part of the balance
  terms.kinetic = lsm_total(LSMScene::kinetic(atom, plates_ ? plates_->moved_bits() : 0), world) +
      (plates_ ? plates_->kinetic() : 0.0);
  terms.potential = lsm_total(potential, world);
  terms.friction = lsm_total(friction, world);
  terms.viscosity = lsm_total(viscosity, world);
  terms.broken = links_ ? lsm_total(links_->work_broken, world) : 0.0;
  terms.plates = plates_ ? plates_->compute_scalar() : 0.0;
  terms.outside = lsm_total(outside, world);
  terms.absorbed = lsm_total(absorbed, world);
  terms.within = lsm_total(within, world);
  terms.counted_pe = lsm_total(pe(), world);
  return terms;
}

LSM::SceneInfo LSMEventSources::scene() const
{
  using LSM::text::number;
  LSM::SceneInfo info;
  info.ranks = comm->nprocs;
  info.dt = update->dt;
  info.parameters = {
      {"program", std::string("LAMMPS ") + lmp->version + " package LSM " LSM_VERSION},
      {"particles", std::to_string(atom->natoms)},
      {"links", std::to_string(atom->nbonds)},
      {"length", number(domain->prd[0])},
      {"dt", number(update->dt)}};
  for (size_t n = 0; n < integrators_.size(); n++)
    info.parameters.emplace_back(n ? "viscosity_" + std::to_string(n + 1) : "viscosity",
                                 integrators_[n]->viscosity());
  const std::string retardation = links_ ? links_->retardation() : "";
  if (!retardation.empty()) info.parameters.emplace_back("kelvin_voigt", retardation);
  if (leap_) info.parameters.emplace_back("leap", leap_->settings());
  return info;
}

LSM::files::Parameters LSMEventSources::variables() const
{
  LSM::files::Parameters stated;
  const auto running = plates_ ? plates_->settings() : LSM::files::Parameters();
  for (const auto &[name, value] : LSMScript::listed(lmp, LSMScript::HEADER)) {
    const std::string *const runs = LSM::files::find(running, name);
    double given, used;
    const bool same =
        runs && LSM::text::parse(value, given) && LSM::text::parse(*runs, used) && given == used;
    const std::string &text = !runs || same ? value : *runs;
    if (!text.empty()) stated.emplace_back(name, text);
  }
  return stated;
}
