// SPDX-License-Identifier: GPL-2.0-or-later

#include "lsm_contact_coefficients.h"

#include "atom.h"
#include "error.h"
#include "lsm_contacts.h"
#include "lsm_ranks.h"
#include "neighbor.h"
#include "update.h"

using namespace LAMMPS_NS;

bool LSMContactCoefficients::init(const LSMTypePairs<int> &on)
{
  numbers.resize(table.properties().size());
  build = -1;
  outdate();
  bool any = false;
  for (int i = 1; i <= atom->ntypes; i++)
    for (int j = i; j <= atom->ntypes; j++) any = any || (on[i][j] && table.has_property(i, j));
  if (!any) return false;
  check_properties(on);
  read();
  check_particles(on);
  return true;
}

void LSMContactCoefficients::check_properties(const LSMTypePairs<int> &on) const
{
  for (int i = 1; i <= atom->ntypes; i++)
    for (int j = i; j <= atom->ntypes; j++)
      for (int p = 0; p < table.law->count; p++) {
        const int n = table.property(p, i, j);
        if (!on[i][j] || n < 0) continue;
        const std::string &name = table.properties()[n];
        int is_double, columns, ghost = 0;
        const int found = atom->find_custom_ghost(name.c_str() + 2, is_double, columns, ghost);
        if (found >= 0 && is_double && !columns && ghost) continue;
        error->all(FLERR, Error::NOLASTLINE,
                   "Pair lsm/friction {} of types {} {} is {}, but {}; expected 'fix ID all "
                   "property/atom {} ghost yes'",
                   table.law->parameters[p].name, i, j, name,
                   found < 0 || !is_double || columns ? "particles have no such property"
                                                      : "ghosts do not have this property",
                   name);
      }
}

void LSMContactCoefficients::read()
{
  build = neighbor->ncalls;
  for (size_t n = 0; n < numbers.size(); n++) {
    int is_double, columns;
    const int found = atom->find_custom(table.properties()[n].c_str() + 2, is_double, columns);
    if (found < 0 || !is_double || columns) continue;    // of types that are off
    const double *const values = atom->dvector[found];
    numbers[n].assign(values, values + atom->nlocal + atom->nghost);
  }
}

// The particle of the lowest ID whose numbers are out of range is named, on any number of ranks.
void LSMContactCoefficients::check_particles(const LSMTypePairs<int> &on) const
{
  tagint mine = MAXTAGINT;
  std::string what;
  for (int i = 0; i < atom->nlocal; i++) {
    const int itype = atom->type[i];
    for (int jtype = 1; jtype <= atom->ntypes && atom->tag[i] < mine; jtype++) {
      const int low = MIN(itype, jtype), high = MAX(itype, jtype);
      if (!on[low][high] || !table.has_property(low, high)) continue;
      const std::string wrong = complaint(i, low, high);
      if (wrong.empty()) continue;
      mine = atom->tag[i];
      what = wrong;
    }
  }
  tagint first = MAXTAGINT;
  MPI_Allreduce(&mine, &first, 1, MPI_LMP_TAGINT, MPI_MIN, world);
  if (first == MAXTAGINT) return;
  std::vector<char> text;
  if (mine == first) text.assign(what.begin(), what.end());
  text = lsm_gather(text, world);
  error->all(FLERR, Error::NOLASTLINE, std::string(text.begin(), text.end()));
}

// what is wrong with the numbers of a particle in contacts of two types
std::string LSMContactCoefficients::complaint(int i, int itype, int jtype) const
{
  std::vector<double> all = table.values(itype, jtype);
  for (int p = 0; p < table.law->count; p++) {
    const int n = table.property(p, itype, jtype);
    if (n >= 0) all[p] = numbers[n][i];
  }
  const std::string wrong = table.complaint(all, "");
  if (wrong.empty()) return wrong;
  return table.complaint(
      all, fmt::format(" of particle {} in contacts of types {} {}", atom->tag[i], itype, jtype));
}

std::vector<double> LSMContactCoefficients::values(int i, int j) const
{
  const int itype = atom->type[i], jtype = atom->type[j];
  std::vector<double> all = table.values(itype, jtype);
  for (int p = 0; p < table.law->count; p++) {
    const int n = table.property(p, itype, jtype);
    if (n >= 0) all[p] = 0.5 * (numbers[n][i] + numbers[n][j]);
  }
  return all;
}

void LSMContactCoefficients::follow(const LSMContacts &contacts, const LSMTypePairs<int> &on,
                                    const LSMTypePairs<double> &stiffness,
                                    const LSMTypePairs<double> &retardation)
{
  const bool again = update->setupflag || build != neighbor->ncalls;
  if (again) {
    read();
    check_particles(on);
  }
  if (again || begun != contacts.begun() || known == 0) {
    begun = contacts.begun();
    known = 0;
    k.clear();
    delay.clear();
    for (int p = 0; p < table.law->count; p++) coefficient[p].clear();
  }
  for (; known < contacts.count(); known++) {
    const LSMContacts::Pair &pair = contacts.pair(known);
    const int itype = atom->type[pair.i], jtype = atom->type[pair.j];
    const std::vector<double> all = values(pair.i, pair.j);
    k.add(stiffness[itype][jtype]);
    delay.add(retardation[itype][jtype]);
    for (int p = 0; p < table.law->count; p++) coefficient[p].add(all[p]);
  }
}
