// SPDX-License-Identifier: GPL-2.0-or-later

#include "fix_lsm_traction.h"

#include "atom.h"
#include "comm.h"
#include "domain.h"
#include "error.h"
#include "force.h"
#include "group.h"
#include "input.h"
#include "lsm_keyword_reader.h"
#include "lsm_scene.h"
#include "modify.h"
#include "neighbor.h"
#include "pair_lsm_friction.h"
#include "update.h"
#include "variable.h"

#include <algorithm>
#include <cmath>

using namespace LAMMPS_NS;

enum { BELOW, ABOVE };
// largest distance of two discs that face each other, in sums of their radii, in total and along
// the fault
static constexpr double FACING = 1.2;
static constexpr double ASIDE = 0.2;
static constexpr double TOUCHING = 1e-9;    // overlap of discs that just touch, in radii: rounding

FixLSMTraction::FixLSMTraction(LAMMPS *_lmp, int narg, char **arg) : LSMKeptFix(_lmp, narg, arg)
{
  has_output(&work_outside);

  if (narg < 7)
    error->all(FLERR,
               "Fix lsm/traction expects 'fix ID group lsm/traction lower-group upper-group "
               "NORMAL SHEAR [share diameter|spacing] [per/mass A] [dip SHEAR] [added SHEAR]', "
               "tractions as numbers or variables v_name");
  LSMKeywordReader in(lmp, "Fix lsm/traction", 7, narg, arg);
  in.read_all({{"share", LSM::Words{&spaced, {"diameter", "spacing"}}},
               {"per/mass", &per_mass, LSM::Must::positive},
               {"dip", &traction[DIP]},
               {"added", &traction[ADDED]}});
  for (const char *word : {"share", "dip"})
    if (in.has(word) && (domain->dimension == 3) != (word[0] == 'd'))
      error->all(FLERR, "Fix lsm/traction {} needs dimension {}, found dimension {}", word,
                 word[0] == 'd' ? 3 : 2, domain->dimension);
  if (spaced && in.has("added"))
    error->all(FLERR, "Fix lsm/traction added needs share diameter, or per/mass");
  if (modify->get_fix_by_style("^lsm/traction").size() > 0)
    error->all(FLERR, "Fix lsm/traction can be used once only; give it variables of the position");
  for (int s : {BELOW, ABOVE}) {
    const int which = group->find(arg[3 + s]);
    if (which < 0)
      error->all(FLERR, lsm_place(lmp, arg[3 + s]), "Fix lsm/traction {} group '{}' does not exist",
                 s ? "upper" : "lower", arg[3 + s]);
    if (group->count(which) == 0)
      error->all(FLERR, lsm_place(lmp, arg[3 + s]),
                 "Fix lsm/traction {} group '{}' has no particles, expected a face",
                 s ? "upper" : "lower", arg[3 + s]);
    side[s] = group->bitmask[which];
    traction[s] = arg[5 + s];
  }
}

FixLSMTraction::~FixLSMTraction()
{
  const std::string store = std::string(id) + "_store";
  if (force)
    for (auto *const pair : LSMScene::contact_styles(force)) pair->forget_radii();
  if (modify && modify->get_fix_by_id(store)) modify->delete_fix(store);
}

// the values are stored by a fix that sends them from rank to rank and to restart files
void FixLSMTraction::post_constructor()
{
  modify->add_fix(std::string(id) +
                  "_store all property/atom d_lsm_contact_radius d_lsm_normal d_lsm_shear " +
                  (domain->dimension == 3 ? "d_lsm_dip " : "") + "ghost yes writedata no");
}

void FixLSMTraction::init()
{
  LSMScene::require_verlet(lmp, "Fix lsm/traction");
  if (!dynamic_cast<PairLSMFriction *>(force->pair_match("lsm/friction", 1)))
    error->all(FLERR, Error::NOLASTLINE, "Fix lsm/traction needs pair style lsm/friction");
  if (!modify->get_fix_by_id(std::string(id) + "_store"))
    error->all(FLERR, Error::NOLASTLINE,
               "Fix lsm/traction {} needs its fix {}_store, which was deleted", id, id);
}

const double *FixLSMTraction::contact_radii() const
{
  int flag, columns;
  return atom->dvector[atom->find_custom("lsm_contact_radius", flag, columns)];
}

// the arrays move when they grow, so that pointers have to be renewed
void FixLSMTraction::find_store()
{
  int flag, columns;
  contact_radius = const_cast<double *>(contact_radii());
  load[NORMAL] = atom->dvector[atom->find_custom("lsm_normal", flag, columns)];
  load[SHEAR] = atom->dvector[atom->find_custom("lsm_shear", flag, columns)];
  load[DIP] = domain->dimension == 3 ? atom->dvector[atom->find_custom("lsm_dip", flag, columns)]
                                     : nullptr;
}

// evaluates a traction at each particle of this rank
std::vector<double> FixLSMTraction::evaluate(const std::string &text) const
{
  std::vector<double> all(atom->nlocal);
  if (text.substr(0, 2) != "v_") {
    all.assign(all.size(), utils::numeric(FLERR, text, false, lmp));
    return all;
  }
  auto *const variable = input->variable;
  const int which = variable->find(text.substr(2).c_str());
  if (which < 0)
    error->all(FLERR, Error::NOLASTLINE, "Fix lsm/traction: variable {} does not exist",
               text.substr(2));
  if (variable->equalstyle(which))
    all.assign(all.size(), variable->compute_equal(which));
  else if (variable->atomstyle(which))
    variable->compute_atom(which, igroup, all.data(), 1, 0);
  else
    error->all(FLERR, Error::NOLASTLINE,
               "Fix lsm/traction: variable {} must be of style equal or atom", text.substr(2));
  return all;
}

// others: particles of the other side, in the order of x
int FixLSMTraction::partner(int i, const std::vector<int> &others) const
{
  double **x = atom->x;
  int found = -1;
  const double widest = ASIDE * (atom->radius[i] + widest_radius);
  const auto first =
      std::lower_bound(others.begin(), others.end(), x[i][0] - widest, [x](int j, double least) {
        return x[j][0] < least;
      });
  for (auto at = first; at != others.end() && x[*at][0] <= x[i][0] + widest; ++at) {
    const int j = *at;
    const double dx = x[i][0] - x[j][0], dy = x[i][1] - x[j][1];
    const double dz = domain->dimension == 3 ? x[i][2] - x[j][2] : 0.0;
    const double reach = FACING * (atom->radius[i] + atom->radius[j]);
    if (dx * dx + dy * dy + dz * dz > reach * reach || fabs(dx) > ASIDE / FACING * reach ||
        fabs(dz) > ASIDE / FACING * reach)
      continue;
    if (found >= 0)
      error->one(
          FLERR, Error::NOLASTLINE,
          "Fix lsm/traction: particle {} faces particles {} and {}, but must face one, as in "
          "create_lsm_fault lattice or with mirror yes",
          atom->tag[i], atom->tag[found], atom->tag[j]);
    found = j;
  }
  if (found < 0)
    error->one(FLERR, Error::NOLASTLINE,
               "Fix lsm/traction: particle {} faces none of the other side", atom->tag[i]);
  return found;
}

// Length of the fault, in three dimensions its area, that a particle represents: given for its mass,
// its diameter or the square of it.
double FixLSMTraction::share_of(int i) const
{
  const double diameter = 2.0 * atom->radius[i];
  return per_mass > 0.0        ? per_mass * atom->rmass[i]
      : domain->dimension == 3 ? diameter * diameter
                               : diameter;
}

// That of each particle of this rank on one side, which in two dimensions may be half the distance
// to the next particles of that side on the left and on the right. At the ends of a fault that is
// not periodic, its radius replaces the missing half.
std::vector<double> FixLSMTraction::shares(int s) const
{
  const double *const radius = atom->radius;
  std::vector<double> share(atom->nlocal, 0.0), mine;
  for (int i = 0; i < atom->nlocal; i++) {
    if (!(atom->mask[i] & side[s])) continue;
    share[i] = share_of(i);
    mine.push_back(atom->x[i][0]);
  }
  if (!spaced) return share;

  std::vector<double> all = lsm_gather(mine, world);
  std::sort(all.begin(), all.end());
  for (int i = 0; i < atom->nlocal; i++) {
    if (!(atom->mask[i] & side[s])) continue;
    const double x = atom->x[i][0];
    const auto at = std::lower_bound(all.begin(), all.end(), x) - all.begin();
    double left = radius[i], right = radius[i];
    if (at > 0)
      left = 0.5 * (x - all[at - 1]);
    else if (domain->xperiodic)
      left = 0.5 * (x - all.back() + domain->xprd);
    if (at + 1 < static_cast<std::ptrdiff_t>(all.size()))
      right = 0.5 * (all[at + 1] - x);
    else if (domain->xperiodic)
      right = 0.5 * (all.front() + domain->xprd - x);
    share[i] = left + right;
  }
  return share;
}

// Contacts of all other particles have their radii, which may have changed, and so have those that
// were added to a face: their stored radius is 0.
void FixLSMTraction::pre_neighbor()
{
  find_store();
  for (int i = 0; i < atom->nlocal + atom->nghost; i++)
    if (contact_radius[i] == 0.0 || !(atom->mask[i] & (side[BELOW] | side[ABOVE])))
      contact_radius[i] = atom->radius[i];
}

// Where discs just touch, contacts reach farther by the overlap that the normal traction needs, and
// their tangential springs begin with the elongation that the shear traction needs: no particle
// moves and no link is strained. Contacts that are there already keep what they have besides.
void FixLSMTraction::setup_pre_force(int /*vflag*/)
{
  if (begun) return;
  auto *const pair = dynamic_cast<PairLSMFriction *>(force->pair_match("lsm/friction", 1));
  find_store();
  const std::vector<double> normal = evaluate(traction[NORMAL]), shear = evaluate(traction[SHEAR]);
  const std::vector<double> dip = evaluate(traction[DIP]);
  const int *const mask = atom->mask;
  const double *const radius = atom->radius;
  const std::vector<double> share[2] = {shares(BELOW), shares(ABOVE)};
  std::vector<int> face[2];
  for (int i = 0; i < atom->nlocal + atom->nghost; i++)
    for (int s : {BELOW, ABOVE})
      if (mask[i] & side[s]) face[s].push_back(i);
  widest_radius = 0.0;
  for (auto &of_side : face) {
    for (const int i : of_side) widest_radius = MAX(widest_radius, radius[i]);
    std::stable_sort(of_side.begin(), of_side.end(), [this](int i, int j) {
      return atom->x[i][0] < atom->x[j][0];
    });
  }

  for (int i = 0; i < atom->nlocal; i++) {
    contact_radius[i] = radius[i];
    load[NORMAL][i] = load[SHEAR][i] = 0.0;
    if (load[DIP]) load[DIP][i] = 0.0;
    for (int s : {BELOW, ABOVE}) {
      if (!(mask[i] & side[s])) continue;
      const int j = partner(i, face[1 - s]);
      const double k = pair->stiffness(atom->type[i], atom->type[j]);
      if (k == 0.0)
        error->one(FLERR, Error::NOLASTLINE,
                   "Fix lsm/traction: types {} and {} of particles that face each other do not "
                   "touch by pair_coeff",
                   atom->type[i], atom->type[j]);
      if (spaced && fabs(atom->x[i][0] - atom->x[j][0]) > 1e-6 * radius[i])
        error->one(FLERR, Error::NOLASTLINE,
                   "Fix lsm/traction: with share spacing particles {} and {}, which face each "
                   "other, must be at the same x",
                   atom->tag[i], atom->tag[j]);
      if (!(normal[i] >= 0.0) || !std::isfinite(normal[i]) || !std::isfinite(shear[i]) ||
          !std::isfinite(dip[i]))
        error->one(FLERR, Error::NOLASTLINE,
                   "Fix lsm/traction: normal and shear traction of particle {} are {} and {}, "
                   "but must be >= 0 and finite",
                   atom->tag[i], normal[i], std::isfinite(dip[i]) ? shear[i] : dip[i]);
      load[NORMAL][i] = share[s][i] * normal[i];
      load[SHEAR][i] = share[s][i] * shear[i];
      if (load[DIP]) load[DIP][i] = share[s][i] * dip[i];
      const double dx = atom->x[i][0] - atom->x[j][0], dy = atom->x[i][1] - atom->x[j][1];
      const double dz = load[DIP] ? atom->x[i][2] - atom->x[j][2] : 0.0;
      const double r = sqrt(dx * dx + dy * dy + dz * dz), overlap = radius[i] + radius[j] - r;
      const double more = overlap > TOUCHING * radius[i]
          ? 0.5 * load[NORMAL][i] / k
          : 0.5 * (r + load[NORMAL][i] / k - radius[i] - radius[j]);
      if (fabs(more) > 0.05 * radius[i])
        error->one(
            FLERR, Error::NOLASTLINE,
            "Fix lsm/traction: particle {} would overlap its partner by {:.3g} of its "
            "radius, but may by a tenth; its contact is too soft for the normal traction, or "
            "the faces do not touch",
            atom->tag[i], 2.0 * more / radius[i]);
      if (2.0 * more > neighbor->skin)
        error->one(FLERR, Error::NOLASTLINE,
                   "Fix lsm/traction: particle {} would overlap its partner by {:.3g}, but the "
                   "lists of neighbors reach only the skin {} beyond particles that touch; give a "
                   "larger skin, or a stiffer contact",
                   atom->tag[i], 2.0 * more, neighbor->skin);
      contact_radius[i] += more;
    }
  }
  std::vector<double *> of_each(atom->nlocal + atom->nghost);
  for (size_t i = 0; i < of_each.size(); i++) of_each[i] = &contact_radius[i];
  comm->forward_comm_array(1, of_each.data());
  pair->load_contacts(side, load[SHEAR], load[DIP]);
  begun = true;
}

// The forces that balance the tractions: the upper face is pulled along x and z, and each is
// pressed on the other; what is added along x acts besides. Within a run velocities are those of
// the middle of the step; times the time step they give the displacement.
void FixLSMTraction::post_force(int /*vflag*/)
{
  find_store();
  double **v = atom->v;
  double **f = atom->f;
  double work = 0.0;
  std::vector<double> added;
  if (traction[ADDED] != "0") added = evaluate(traction[ADDED]);
  for (int i = 0; i < atom->nlocal; i++)
    for (int s : {BELOW, ABOVE}) {
      if (!(atom->mask[i] & side[s])) continue;
      const double up = s == ABOVE ? 1.0 : -1.0;
      double shear = load[SHEAR][i];
      if (!added.empty()) {
        shear += added[i] * share_of(i);
        if (!std::isfinite(shear))
          error->one(FLERR, Error::NOLASTLINE,
                     "Fix lsm/traction: added traction of particle {} is {}, but must be finite",
                     atom->tag[i], added[i]);
      }
      const double fx = up * shear, fy = -up * load[NORMAL][i];
      f[i][0] += fx;
      f[i][1] += fy;
      work += fx * v[i][0] + fy * v[i][1];
      if (!load[DIP]) continue;
      const double fz = up * load[DIP][i];
      f[i][2] += fz;
      work += fz * v[i][2];
    }
  if (!update->setupflag) work_outside += update->dt * work;
}
