/* ----------------------------------------------------------------------
   SPDX-License-Identifier: GPL-2.0-or-later
   Lattice Solid Model: box, particles and links of a fault between two blocks
------------------------------------------------------------------------- */

#include "create_lsm_fault.h"

#include "lsm_lattice.h"
#include "lsm_packing.h"

#include "atom.h"
#include "atom_vec.h"
#include "comm.h"
#include "create_box.h"
#include "domain.h"
#include "error.h"
#include "force.h"
#include "special.h"
#include "update.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <exception>
#include <limits>
#include <numeric>
#include <string>
#include <tuple>
#include <utility>

using namespace LAMMPS_NS;

// atom types: block, plus an offset for the fault zone and for the plate

static constexpr int NTYPES = 6;
static constexpr int BULK = 1;
static constexpr int FAULT_ZONE = 3;
static constexpr int PLATE = 5;
static constexpr int LINK_TYPE = 1;
static constexpr int BORDER_LINK_TYPE = 2;    // of a lattice

static int type_of(const LSM::Disc &disc)
{
  return (disc.plate ? PLATE : (disc.fault ? FAULT_ZONE : BULK)) + disc.block;
}

// Discs in sections along the fault; in each section first those that can be in contact, then the blocks,
// then the plates, by x. Loops over particles, links or contacts in the order of the IDs then find their
// data in the nearest caches, and each kind contiguous.

static constexpr double STRETCH = 64.0;    // in largest radii

static void order_along_fault(LSM::Packing &packing, double rmax)
{
  const int n = static_cast<int>(packing.discs.size());
  std::vector<int> order(n), place(n);
  const double stretch = STRETCH * rmax;
  const auto key = [stretch](const LSM::Disc &d) {
    return std::make_tuple(static_cast<int>(d.x / stretch), d.plate ? 2 : (d.fault ? 0 : 1), d.x,
                           d.y);
  };
  std::iota(order.begin(), order.end(), 0);
  std::sort(order.begin(), order.end(),
            [&](int a, int b) { return key(packing.discs[a]) < key(packing.discs[b]); });
  std::vector<LSM::Disc> discs;
  discs.reserve(n);
  for (int i = 0; i < n; i++) {
    place[order[i]] = i;
    discs.push_back(packing.discs[order[i]]);
  }
  packing.discs.swap(discs);
  for (auto &link : packing.links) {
    const auto ends = std::minmax(place[link.first], place[link.second]);
    link = {ends.first, ends.second};
  }
  std::sort(packing.links.begin(), packing.links.end());
}

// the disc that stores a link when each link is stored once: the smaller disc has fewer links,
// which keeps the largest number of links per atom, and so memory and messages, small

static std::pair<int, int> owner_first(const LSM::Packing &packing, const std::pair<int, int> &link)
{
  if (packing.discs[link.second].r < packing.discs[link.first].r) return {link.second, link.first};
  return link;
}

/* ---------------------------------------------------------------------- */

CreateLSMFault::CreateLSMFault(LAMMPS *lmp_in) :
    Command(lmp_in), mass_power(2), mass_scale(1.0), mass_floor(0.0), step(0.0), step_kt(0.0),
    margin(2.0), stiffness(1.0), lattice(false), types(NTYPES)
{
}

/* ---------------------------------------------------------------------- */

void CreateLSMFault::command(int narg, char **arg)
{
  lattice = narg > 0 && strcmp(arg[0], "lattice") == 0;
  check_setup();
  MPI_Barrier(world);
  const double time1 = platform::walltime();

  LSM::Packing packing;
  LSM::PackingSettings random;
  std::vector<double> masses;
  double time2;
  if (lattice) {
    LSM::LatticeSettings regular;
    parse(narg - 1, arg + 1, regular);
    pack([&regular] { return LSM::make_lattice(regular); }, packing);
    time2 = platform::walltime();
    masses = masses_of(packing);
    const double x = regular.half_length(), y = regular.half_width() + margin;
    const double lo[] = {-x, -y, -0.5 * regular.spacing}, hi[] = {x, y, 0.5 * regular.spacing};
    create(lo, hi, packing, masses);
  } else {
    parse(narg, arg, random);
    pack(
        [&random] {
          LSM::Packing one = LSM::make_packing(random);
          order_along_fault(one, random.rmax);
          return one;
        },
        packing);
    time2 = platform::walltime();
    masses = masses_of(packing);
    if (step > 0.0) {
      const auto enough = LSM::masses_for_step(packing, random.length, step, stiffness, step_kt);
      for (std::size_t i = 0; i < masses.size(); i++) masses[i] = std::max(masses[i], enough[i]);
    }
    // LAMMPS wants no box that is much thinner than the range of the contacts
    const double thick = 0.5 * std::max(1.0, random.rmax);
    const double lo[] = {0.0, -margin, -thick},
                 hi[] = {random.length, random.width + margin, thick};
    create(lo, hi, packing, masses);
  }
  MPI_Barrier(world);
  if (comm->me == 0) {
    report_types(packing);
    if (!lattice) report(random, packing, masses);
    utils::logmesg(lmp, "  create_lsm_fault CPU = {:.3f} seconds (packing {:.3f})\n",
                   platform::walltime() - time1, time2 - time1);
  }
}

/* ---------------------------------------------------------------------- */

void CreateLSMFault::create(const double *lo, const double *hi, const LSM::Packing &packing,
                            const std::vector<double> &masses)
{
  std::vector<int> stored(packing.discs.size(), 0);
  for (const auto &link : packing.links) {
    ++stored[owner_first(packing, link).first];
    if (!force->newton_bond) ++stored[owner_first(packing, link).second];
  }
  const int most = stored.empty() ? 0 : *std::max_element(stored.begin(), stored.end());

  create_box(lo, hi, most);
  add_particles(packing, masses, stored);

  Special special(lmp);
  special.build();
}

/* ----------------------------------------------------------------------
   a disc in a straight border of a lattice represents half the area of the others
------------------------------------------------------------------------- */

std::vector<double> CreateLSMFault::masses_of(const LSM::Packing &packing) const
{
  std::vector<double> masses;
  masses.reserve(packing.discs.size());
  for (const auto &disc : packing.discs)
    masses.push_back((lattice && (disc.fault || disc.plate) ? 0.5 : 1.0) *
                     std::max(mass_of(disc.r), mass_floor));
  return masses;
}

/* ---------------------------------------------------------------------- */

double CreateLSMFault::mass_of(double radius) const
{
  return mass_scale * radius * radius * (mass_power == 3 ? radius : 1.0);
}

/* ----------------------------------------------------------------------
   requirements on the scene before the box exists
------------------------------------------------------------------------- */

void CreateLSMFault::check_setup()
{
  if (domain->box_exist)
    error->all(FLERR, "Create_lsm_fault creates the simulation box, but one exists already");
  if (strcmp(update->unit_style, "lj") != 0)
    error->all(FLERR, "Create_lsm_fault requires units lj, found units {}", update->unit_style);
  if (domain->dimension != 2)
    error->all(FLERR, "Create_lsm_fault requires dimension 2, found dimension {}",
               domain->dimension);
  if ((!lattice && !domain->xperiodic) || domain->yperiodic || !domain->zperiodic)
    error->all(FLERR,
               "Create_lsm_fault requires boundary p f p: periodic in x and z, not periodic in y{}",
               lattice ? "; or f f p" : "");
  if (atom->molecular != Atom::MOLECULAR || !atom->avec->bonds_allow || !atom->radius_flag ||
      !atom->rmass_flag)
    error->all(FLERR,
               "Create_lsm_fault requires an atom style with bonds, radius and mass of each "
               "particle, such as hybrid bond sphere, found atom style {}",
               atom->get_style());

  const double *lj = force->special_lj, *coul = force->special_coul;
  const bool as_needed =
      lj[1] == 0.0 && lj[2] == 1.0 && lj[3] == 1.0 && coul[2] == 1.0 && coul[3] == 1.0;
  if (comm->me == 0 && !as_needed)
    error->warning(FLERR, "Linked particles must not be contact pairs and all others must be: "
                          "use special_bonds lj/coul 0 1 1 before create_lsm_fault");
}

/* ---------------------------------------------------------------------- */

void CreateLSMFault::parse(int narg, char **arg, LSM::PackingSettings &settings)
{
  bool have_length = false, have_width = false, have_seed = false;
  int iarg = 0;
  while (iarg < narg) {
    const std::string key = arg[iarg];
    const int values = (key == "mass" || key == "massstep") ? 2 : 1;
    if (iarg + values >= narg) utils::missing_cmd_args(FLERR, "create_lsm_fault " + key, error);
    const char *value = arg[iarg + 1];
    if (key == "length") {
      settings.length = utils::numeric(FLERR, value, false, lmp);
      have_length = true;
    } else if (key == "width") {
      settings.width = utils::numeric(FLERR, value, false, lmp);
      have_width = true;
    } else if (key == "seed") {
      const bigint seed = utils::bnumeric(FLERR, value, false, lmp);
      if (seed < 0) error->all(FLERR, "Create_lsm_fault: seed = {}, expected 0 or more", seed);
      settings.seed = static_cast<uint64_t>(seed);
      have_seed = true;
    } else if (key == "rmin") {
      settings.rmin = utils::numeric(FLERR, value, false, lmp);
    } else if (key == "rmax") {
      settings.rmax = utils::numeric(FLERR, value, false, lmp);
    } else if (key == "failures") {
      settings.max_failures = utils::inumeric(FLERR, value, false, lmp);
    } else if (key == "tolerance") {
      settings.tolerance = utils::numeric(FLERR, value, false, lmp);
    } else if (key == "linkgap") {
      settings.link_gap = utils::numeric(FLERR, value, false, lmp);
    } else if (key == "faultzone") {
      settings.fault_zone = utils::numeric(FLERR, value, false, lmp);
    } else if (key == "loose") {
      if (strcmp(value, "remove") == 0)
        settings.remove_loose = true;
      else if (strcmp(value, "keep") == 0)
        settings.remove_loose = false;
      else
        error->all(FLERR, "Create_lsm_fault: loose = {}, expected remove or keep", value);
    } else if (key == "mirror") {
      if (strcmp(value, "yes") == 0)
        settings.mirror = true;
      else if (strcmp(value, "no") == 0)
        settings.mirror = false;
      else
        error->all(FLERR, "Create_lsm_fault: mirror = {}, expected yes or no", value);
    } else if (key == "mass") {
      parse_mass(value, arg[iarg + 2]);
    } else if (key == "massfloor") {
      mass_floor = utils::numeric(FLERR, value, false, lmp);
      if (!(mass_floor >= 0.0) || !std::isfinite(mass_floor))
        error->all(FLERR, "Create_lsm_fault: massfloor = {}, expected 0 or a positive number",
                   mass_floor);
    } else if (key == "massstep") {
      step = utils::numeric(FLERR, value, false, lmp);
      step_kt = utils::numeric(FLERR, arg[iarg + 2], false, lmp);
      if (!(step >= 0.0) || !std::isfinite(step) || !(step_kt >= 0.0) || !std::isfinite(step_kt))
        error->all(FLERR,
                   "Create_lsm_fault: massstep = {} {}, expected a time step and a tangential "
                   "stiffness, both 0 or a positive number",
                   step, step_kt);
    } else if (key == "margin") {
      margin = positive(key, value);
    } else if (key == "stiffness") {
      stiffness = positive(key, value);
    } else if (key == "types") {
      parse_types(value);
    } else
      error->all(FLERR,
                 "Create_lsm_fault: unknown keyword {}, expected length, width, seed, rmin, rmax, "
                 "failures, tolerance, linkgap, faultzone, loose, mirror, mass, massfloor, "
                 "massstep, margin, stiffness or types",
                 key);
    iarg += 1 + values;
  }
  const char *missing = !have_length ? "length"
                                     : (!have_width ? "width" : (!have_seed ? "seed" : nullptr));
  if (missing)
    error->all(FLERR, "Create_lsm_fault: {} is missing, expected length L width W seed S", missing);
}

/* ---------------------------------------------------------------------- */

double CreateLSMFault::positive(const std::string &what, const char *text) const
{
  const double value = utils::numeric(FLERR, text, false, lmp);
  if (!(value > 0.0) || !std::isfinite(value))
    error->all(FLERR, "Create_lsm_fault: {} = {}, expected a positive number", what, value);
  return value;
}

void CreateLSMFault::parse_mass(const char *power, const char *scale)
{
  if (strcmp(power, "r2") == 0)
    mass_power = 2;
  else if (strcmp(power, "r3") == 0)
    mass_power = 3;
  else
    error->all(FLERR, "Create_lsm_fault: mass = {}, expected r2 or r3 and a number", power);
  mass_scale = positive(std::string("mass ") + power, scale);
}

void CreateLSMFault::parse_types(const char *text)
{
  types = utils::inumeric(FLERR, text, false, lmp);
  if (types < NTYPES)
    error->all(FLERR, "Create_lsm_fault: types = {}, expected at least {}", types, NTYPES);
}

void CreateLSMFault::parse(int narg, char **arg, LSM::LatticeSettings &settings)
{
  settings.ring = domain->xperiodic;
  margin = 0.0;
  int iarg = 0;
  while (iarg < narg) {
    const std::string key = arg[iarg];
    const int values = (key == "mass") ? 2 : 1;
    if (iarg + values >= narg) utils::missing_cmd_args(FLERR, "create_lsm_fault " + key, error);
    const char *value = arg[iarg + 1];
    if (key == "length")
      settings.length = positive(key, value);
    else if (key == "width")
      settings.width = positive(key, value);
    else if (key == "spacing")
      settings.spacing = positive(key, value);
    else if (key == "mass")
      parse_mass(value, arg[iarg + 2]);
    else if (key == "margin")
      margin = positive(key, value);
    else if (key == "types")
      parse_types(value);
    else
      error->all(FLERR,
                 "Create_lsm_fault lattice: unknown keyword {}, expected length, width, spacing, "
                 "mass, margin or types",
                 key);
    iarg += 1 + values;
  }
  const char *missing =
      settings.length == 0.0
          ? "length"
          : (settings.width == 0.0 ? "width" : (settings.spacing == 0.0 ? "spacing" : nullptr));
  if (missing)
    error->all(FLERR,
               "Create_lsm_fault: {} is missing, expected lattice length L width W spacing D",
               missing);
  if (margin == 0.0) margin = settings.spacing;
}

/* ----------------------------------------------------------------------
   rank 0 packs and sends its result to all others: the same scene on any number of ranks,
   even if their processors round differently
------------------------------------------------------------------------- */

template <class Make> void CreateLSMFault::pack(Make &&make, LSM::Packing &packing)
{
  std::string problem;
  if (comm->me == 0) {
    try {
      packing = make();
      if (packing.discs.size() > static_cast<std::size_t>(std::numeric_limits<int>::max()) / 8)
        problem = "too many particles: " + std::to_string(packing.discs.size());
    } catch (std::exception &e) {
      problem = e.what();
    }
  }

  int size = static_cast<int>(problem.size());
  MPI_Bcast(&size, 1, MPI_INT, 0, world);
  if (size > 0) {
    problem.resize(size);
    MPI_Bcast(&problem[0], size, MPI_CHAR, 0, world);
    // settings by their keywords
    const std::pair<const char *, const char *> names[] = {
        {"max_failures", "failures"},
        {"link_gap", "linkgap"},
        {"fault_zone", "faultzone"},
        {"remove_loose = yes", "loose = remove"}};
    for (const auto &name : names)
      for (auto at = problem.find(name.first); at != std::string::npos;
           at = problem.find(name.first, at))
        problem.replace(at, strlen(name.first), name.second);
    error->all(FLERR, "Create_lsm_fault: {}", problem);
  }

  int counts[4] = {static_cast<int>(packing.discs.size()), static_cast<int>(packing.links.size()),
                   packing.fault_tangent[0], packing.fault_tangent[1]};
  MPI_Bcast(counts, 4, MPI_INT, 0, world);
  const int n = counts[0], m = counts[1];
  std::vector<double> xyr(3 * static_cast<std::size_t>(n));
  std::vector<char> flags(n);
  std::vector<int> ends(2 * static_cast<std::size_t>(m));
  if (comm->me == 0) {
    for (int i = 0; i < n; i++) {
      const LSM::Disc &disc = packing.discs[i];
      xyr[3 * i] = disc.x;
      xyr[3 * i + 1] = disc.y;
      xyr[3 * i + 2] = disc.r;
      flags[i] = static_cast<char>(disc.block | (disc.fault ? 2 : 0) | (disc.plate ? 4 : 0));
    }
    for (int i = 0; i < m; i++) {
      ends[2 * i] = packing.links[i].first;
      ends[2 * i + 1] = packing.links[i].second;
    }
  }
  MPI_Bcast(xyr.data(), 3 * n, MPI_DOUBLE, 0, world);
  MPI_Bcast(flags.data(), n, MPI_CHAR, 0, world);
  MPI_Bcast(ends.data(), 2 * m, MPI_INT, 0, world);
  if (comm->me != 0) {
    packing.fault_tangent[0] = counts[2];
    packing.fault_tangent[1] = counts[3];
    packing.discs.resize(n);
    for (int i = 0; i < n; i++)
      packing.discs[i] = {xyr[3 * i],   xyr[3 * i + 1],      xyr[3 * i + 2],
                          flags[i] & 1, (flags[i] & 2) != 0, (flags[i] & 4) != 0};
    packing.links.resize(m);
    for (int i = 0; i < m; i++) packing.links[i] = {ends[2 * i], ends[2 * i + 1]};
  }
}

/* ----------------------------------------------------------------------
   words of a command as LAMMPS passes them
------------------------------------------------------------------------- */

template <class Command> static void with_words(const std::string &line, Command &&command)
{
  std::vector<std::string> words = utils::split_words(line);
  std::vector<char *> pointers;
  for (std::string &word : words) pointers.push_back(&word[0]);
  command(static_cast<int>(pointers.size()), pointers.data());
}

/* ----------------------------------------------------------------------
   by the commands region and create_box; 17 digits give the same number back
------------------------------------------------------------------------- */

void CreateLSMFault::create_box(const double *lo, const double *hi, int bonds_per_atom)
{
  const std::string region = "create_lsm_fault_box";
  with_words(fmt::format("{} block {:.17g} {:.17g} {:.17g} {:.17g} {:.17g} {:.17g} units box",
                         region, lo[0], hi[0], lo[1], hi[1], lo[2], hi[2]),
             [this](int narg, char **arg) { domain->add_region(narg, arg); });
  with_words(fmt::format("{} {} bond/types {} extra/bond/per/atom {}", types, region,
                         lattice ? BORDER_LINK_TYPE : LINK_TYPE, bonds_per_atom),
             [this](int narg, char **arg) { CreateBox(lmp).command(narg, arg); });
  domain->delete_region(region);

  // the order of the particles suits links and contacts better than that of LAMMPS' sorting

  atom->sortfreq = 0;

  // never used, as each particle has its own mass, but write_data writes these masses as well
  // and read_data refuses zeros

  if (atom->mass)
    for (int itype = 1; itype <= types; itype++) atom->set_mass(FLERR, itype, 1.0);
}

/* ----------------------------------------------------------------------
   each rank adds the particles in its sub-domain and their links
   a particle's ID is its place in the packing + 1
------------------------------------------------------------------------- */

void CreateLSMFault::add_particles(const LSM::Packing &packing, const std::vector<double> &masses,
                                   const std::vector<int> &stored)
{
  const int n = static_cast<int>(packing.discs.size());
  for (int i = 0; i < n; i++)
    if (stored[i] > atom->bond_per_atom)
      error->all(FLERR, "Create_lsm_fault: {} links of particle {} do not fit", stored[i], i + 1);
  std::vector<int> local(n, -1);
  const double *sublo = domain->sublo, *subhi = domain->subhi;

  atom->nghost = 0;
  atom->avec->clear_bonus();

  for (int i = 0; i < n; i++) {
    const LSM::Disc &disc = packing.discs[i];
    double x[3] = {disc.x, disc.y, 0.0};
    if (x[0] < sublo[0] || x[0] >= subhi[0] || x[1] < sublo[1] || x[1] >= subhi[1]) continue;
    atom->avec->create_atom(type_of(disc), x);
    const int m = atom->nlocal - 1;
    local[i] = m;
    atom->tag[m] = i + 1;
    atom->radius[m] = disc.r;
    atom->rmass[m] = masses[i];
    if (atom->molecule_flag) atom->molecule[m] = disc.block + 1;
  }

  for (const auto &link : packing.links) {
    const auto ends = owner_first(packing, link);
    const int i = local[ends.first], j = local[ends.second];
    const int type = lattice && LSM::in_border(packing, link) ? BORDER_LINK_TYPE : LINK_TYPE;
    if (i >= 0) {
      atom->bond_type[i][atom->num_bond[i]] = type;
      atom->bond_atom[i][atom->num_bond[i]++] = ends.second + 1;
    }
    if (!force->newton_bond && j >= 0) {
      atom->bond_type[j][atom->num_bond[j]] = type;
      atom->bond_atom[j][atom->num_bond[j]++] = ends.first + 1;
    }
  }

  atom->data_fix_compute_variable(0, atom->nlocal);

  bigint nblocal = atom->nlocal;
  MPI_Allreduce(&nblocal, &atom->natoms, 1, MPI_LMP_BIGINT, MPI_SUM, world);
  if (atom->natoms != n)
    error->all(FLERR, "Create_lsm_fault: {} of {} particles have an owner", atom->natoms, n);
  atom->nbonds = static_cast<bigint>(packing.links.size());

  atom->tag_check();
  if (atom->map_style != Atom::MAP_NONE) {
    atom->map_init();
    atom->map_set();
  }
}

/* ---------------------------------------------------------------------- */

void CreateLSMFault::report_types(const LSM::Packing &packing)
{
  static const char *names[NTYPES] = {"lower block",      "upper block", "lower fault zone",
                                      "upper fault zone", "lower plate", "upper plate"};
  int counts[NTYPES] = {0};
  for (const auto &disc : packing.discs) ++counts[type_of(disc) - 1];

  utils::logmesg(lmp, "Created {} particles and {} links\n", packing.discs.size(),
                 packing.links.size());
  for (int i = 0; i < NTYPES; i++)
    utils::logmesg(lmp, "  type {} = {:<16} : {} particles\n", i + 1, names[i], counts[i]);
}

/* ---------------------------------------------------------------------- */

void CreateLSMFault::report(const LSM::PackingSettings &settings, const LSM::Packing &packing,
                            const std::vector<double> &masses)
{
  utils::logmesg(lmp,
                 "  coordination = {:.4f}, area fraction = {:.4f}, smallest radius = {:.6f}\n"
                 "  particles tangent to the fault line = {} below, {} above\n",
                 packing.coordination, packing.area_fraction, packing.rmin_found,
                 packing.fault_tangent[0], packing.fault_tangent[1]);
  utils::logmesg(
      lmp,
      "  loose particles (fewer than {} links) = {} {}, {} of them tangent to the fault line; "
      "softest support of the others = {:.4f} of a link\n",
      LSM::HELD_LINKS, packing.loose, settings.remove_loose ? "removed" : "kept",
      packing.loose_tangent, packing.weakest);

  if (mass_floor > 0.0 || step > 0.0) {
    double sum = 0.0, raised = 0.0;
    bigint count = 0;
    for (std::size_t i = 0; i < masses.size(); i++) {
      const double own = mass_of(packing.discs[i].r);
      sum += own;
      if (masses[i] > own) {
        raised += masses[i] - own;
        ++count;
      }
    }
    std::string what;
    if (mass_floor > 0.0) what = fmt::format("mass floor {:g}", mass_floor);
    if (step > 0.0)
      what +=
          fmt::format("{}time step {:g} stable with any contacts", what.empty() ? "" : ", ", step);
    utils::logmesg(lmp, "  {}: {} particles raised, {:.2f} % more mass in all\n", what, count,
                   100.0 * raised / sum);
  }
}
