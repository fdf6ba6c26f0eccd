// SPDX-License-Identifier: GPL-2.0-or-later

#include "compute_lsm_events.h"

#include "comm.h"
#include "error.h"
#include "fix_lsm_record.h"
#include "lsm_keyword_reader.h"
#include "modify.h"
#include "update.h"

#include <algorithm>
#include <vector>

using namespace LAMMPS_NS;

// entries of the global vector, followed by those of the ledger
enum { EVENTS, LAST_SIZE, RATE, IN_EVENT, PE, PE_LINK, PE_CONTACT, PE_TANGENTIAL, NVECTOR };
static constexpr int NLEDGER = 9;
// if ruptures are recorded, these follow, whether there is a ledger or not
enum { RUPTURES, LAST_WORK, OPEN, NRUPTURES };

ComputeLSMEvents::ComputeLSMEvents(LAMMPS *_lmp, int narg, char **arg) : Compute(_lmp, narg, arg)
{
  if (igroup) error->all(FLERR, lsm_place(lmp, arg[1]), "Compute lsm/events must use group all");
  if (modify->get_fix_by_id(id_of_fix()))
    error->all(FLERR, "Compute lsm/events {} needs the fix ID {}, which is in use", id,
               id_of_fix());
  std::string fix_id = id_of_fix();
  char all[] = "all", style[] = "LSM_RECORD";
  std::vector<char *> words = {fix_id.data(), all, style, id};
  words.insert(words.end(), arg + 3, arg + narg);
  modify->add_fix(static_cast<int>(words.size()), words.data());

  const LSMEventOptions &asked = recorder().asked();
  const bool ruptures = asked.events.finds_ruptures();
  scalar_flag = 1;
  vector_flag = 1;
  extscalar = 0;
  extvector = 0;
  size_vector = NVECTOR + (asked.ledger || ruptures ? NLEDGER : 0) + (ruptures ? NRUPTURES : 0);
  vector = new double[size_vector];    // allocated last, as the destructor does not run if the
                                       // constructor throws
}

ComputeLSMEvents::~ComputeLSMEvents()
{
  if (modify && modify->get_fix_by_id(id_of_fix())) modify->delete_fix(id_of_fix());
  delete[] vector;
}

FixLSMRecord &ComputeLSMEvents::recorder() const
{
  auto *const found = dynamic_cast<FixLSMRecord *>(modify->get_fix_by_id(id_of_fix()));
  if (!found)
    error->all(FLERR, Error::NOLASTLINE,
               "Compute lsm/events {}: its fix {} is gone; use uncompute to end recording", id,
               id_of_fix());
  return *found;
}

void ComputeLSMEvents::init()
{
  if (modify->get_compute_by_style("lsm/events").size() > 1 && comm->me == 0)
    error->warning(FLERR, "More than one compute lsm/events");
  recorder();
}

double ComputeLSMEvents::compute_scalar()
{
  invoked_scalar = update->ntimestep;
  scalar = recorder().picked().events;
  return scalar;
}

void ComputeLSMEvents::compute_vector()
{
  invoked_vector = update->ntimestep;
  FixLSMRecord &record = recorder();
  const LSM::Picked picked = record.picked();
  std::fill_n(vector, size_vector, 0.0);
  vector[EVENTS] = picked.events;
  vector[LAST_SIZE] = picked.last_size;
  vector[RATE] = picked.rate;
  vector[IN_EVENT] = picked.in_event;
  if (record.asked().events.finds_ruptures()) {
    double *const ruptures = vector + NVECTOR + NLEDGER;
    ruptures[RUPTURES] = picked.ruptures;
    ruptures[LAST_WORK] = picked.last_work;
    ruptures[OPEN] = picked.open_ruptures;
  }

  double mine[3];
  record.scene().pe_by_kind(mine);
  MPI_Allreduce(mine, &vector[PE_LINK], 3, MPI_DOUBLE, MPI_SUM, world);
  vector[PE] = vector[PE_LINK] + vector[PE_CONTACT] +
      (record.asked().events.tangential ? vector[PE_TANGENTIAL] : 0.0);
  if (!record.asked().ledger) return;
  const LSM::EnergyTerms now = record.energies();
  const double of_ledger[NLEDGER] = {now.kinetic,   now.plates,           now.friction,
                                     now.viscosity, record.residual(now), now.broken,
                                     now.outside,   now.absorbed,         now.within};
  std::copy_n(of_ledger, NLEDGER, vector + NVECTOR);
}
