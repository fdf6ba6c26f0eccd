// SPDX-License-Identifier: GPL-2.0-or-later

#include "create_lsm_fault.h"

#include "fault/cubic_lattice.h"
#include "fault/lattice.h"
#include "fault/packing.h"
#include "lsm_keyword_reader.h"
#include "lsm_ranks.h"

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
#include <stdexcept>
#include <string>
#include <utility>

using namespace LAMMPS_NS;
using LSM::Must;
using LSM::Words;

// atom types: block, plus an offset for the fault zone and for the plate
static constexpr int NTYPES = 6;
static constexpr int BULK = 1;
static constexpr int FAULT_ZONE = 3;
static constexpr int PLATE = 5;
static constexpr int LINK_TYPE = 1;
static constexpr int BORDER_LINK_TYPE = 2;    // links in the border of a lattice

static int type_of(bool plate, bool fault, int block)
{
  return (plate ? PLATE : (fault ? FAULT_ZONE : BULK)) + block;
}

// returns the disc that stores the link first: the smaller one, which has fewer links, so that the
// largest number of links per atom, and with it memory and messages, stays small
static std::pair<int, int> owner_first(const LSM::Packing &packing, const std::pair<int, int> &link)
{
  if (packing.discs[link.second].r < packing.discs[link.first].r) return {link.second, link.first};
  return link;
}

CreateLSMFault::CreateLSMFault(LAMMPS *lmp_in) : Command(lmp_in), types(NTYPES) {}

void CreateLSMFault::command(int narg, char **arg)
{
  lattice = narg > 0 && strcmp(arg[0], "lattice") == 0;
  cubic = lattice && narg > 1 && strcmp(arg[1], "cubic") == 0;
  check_setup();
  MPI_Barrier(world);
  const double begun = platform::walltime();

  if (cubic) {
    create_cubic(parse_cubic(narg, arg));
    if (comm->me == 0)
      utils::logmesg(lmp, "  create_lsm_fault CPU = {:.3f} seconds\n",
                     platform::walltime() - begun);
    return;
  }

  LSM::Packing packing;
  LSM::PackingSettings random;
  LSM::LatticeSettings regular;
  if (lattice) {
    parse(narg, arg, regular);
    pack(packing, [&regular] {
      return LSM::make_lattice(regular);
    });
  } else {
    parse(narg, arg, random);
    pack(packing, [&random] {
      return LSM::make_packing(random);
    });
  }
  const double packed = platform::walltime();

  const std::vector<double> masses = masses_of(packing, random.length);
  create_box(lattice ? box_of(regular) : box_of(random), lattice ? BORDER_LINK_TYPE : LINK_TYPE,
             most_links_stored(packing));
  add_particles(packing, masses);
  Special(lmp).build();
  MPI_Barrier(world);
  if (comm->me == 0) {
    std::vector<bigint> counts(NTYPES, 0);
    for (const auto &disc : packing.discs)
      ++counts[type_of(disc.plate, disc.fault, disc.block) - 1];
    report_types(static_cast<bigint>(packing.links.size()), counts);
    if (!lattice) report(random, packing);
    report_masses(packing, masses);
    utils::logmesg(lmp, "  create_lsm_fault CPU = {:.3f} seconds (packing {:.3f})\n",
                   platform::walltime() - begun, packed - begun);
  }
}

// checks that the scene is as required before the box exists
void CreateLSMFault::check_setup()
{
  if (domain->box_exist)
    error->all(FLERR, "Create_lsm_fault creates the simulation box, but one exists already");
  if (strcmp(update->unit_style, "lj") != 0)
    error->all(FLERR, "Create_lsm_fault requires units lj, found units {}", update->unit_style);
  check_box_and_dimension();
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
    error->warning(FLERR,
                   "Linked particles must not be contact pairs and all others must be: "
                   "use special_bonds lj/coul 0 1 1 before create_lsm_fault");
}

void CreateLSMFault::check_box_and_dimension()
{
  if (cubic) {
    if (domain->dimension != 3)
      error->all(FLERR, "Create_lsm_fault lattice cubic requires dimension 3, found dimension {}",
                 domain->dimension);
    if (domain->yperiodic)
      error->all(FLERR,
                 "Create_lsm_fault lattice cubic requires a boundary that is not periodic "
                 "in y, and in x and z f or p");
    return;
  }
  if (domain->dimension != 2)
    error->all(FLERR,
               "Create_lsm_fault requires dimension 2, found dimension {}; in dimension 3 "
               "use create_lsm_fault lattice cubic",
               domain->dimension);
  if ((!lattice && !domain->xperiodic) || domain->yperiodic || !domain->zperiodic)
    error->all(FLERR,
               "Create_lsm_fault requires boundary p f p: periodic in x and z, not periodic in y{}",
               lattice ? "; or f f p" : "");
}

void CreateLSMFault::read(LSMKeywordReader in, LSM::Keywords keywords,
                          const std::vector<const char *> &required)
{
  for (const LSM::Keyword &of_both :
       LSM::Keywords{{"mass", Words{&cubed, {"r2", "r3"}}, Must::positive, &mass_scale},
                     {"margin", &margin, Must::positive},
                     {"types", &types}})
    keywords.push_back(of_both);
  in.read_all(keywords);
  in.require(required);
  if (types < NTYPES) in.stop(fmt::format("types is {}, but must be at least {}", types, NTYPES));
}

void CreateLSMFault::parse(int narg, char **arg, LSM::PackingSettings &settings)
{
  int removed = settings.remove_loose, faces = settings.random_faces, seeds = settings.random_seeds;
  read({lmp, "Create_lsm_fault", 0, narg, arg},
       {{"length", &settings.length},
        {"width", &settings.width},
        {"seed", &settings.seed},
        {"rmin", &settings.rmin},
        {"rmax", &settings.rmax},
        {"faceradii", &settings.face_rmin, Must::not_negative, &settings.face_rmax},
        {"failures", &settings.max_failures},
        {"tolerance", &settings.tolerance},
        {"linkgap", &settings.link_gap},
        {"linkratio", &settings.link_ratio},
        {"faces", Words{&faces, {"none", "random"}}},
        {"seeds", Words{&seeds, {"grid", "random"}}},
        {"faultzone", &settings.fault_zone},
        {"loose", Words{&removed, {"keep", "remove"}}},
        {"mirror", &settings.mirror},
        {"massstep", &step, Must::not_negative, &step_kt},
        {"stiffness", &stiffness, Must::positive}},
       {"length", "width", "seed"});
  settings.remove_loose = removed != 0;
  settings.random_faces = faces != 0;
  settings.random_seeds = seeds != 0;
}

void CreateLSMFault::parse(int narg, char **arg, LSM::LatticeSettings &settings)
{
  settings.ring = domain->xperiodic;
  margin = 0.0;
  read({lmp, "Create_lsm_fault lattice", 1, narg, arg},
       {{"length", &settings.length, Must::positive},
        {"width", &settings.width, Must::positive},
        {"spacing", &settings.spacing, Must::positive}},
       {"length", "width", "spacing"});
  if (margin == 0.0) margin = settings.spacing;
}

LSM::CubicLattice CreateLSMFault::parse_cubic(int narg, char **arg)
{
  LSM::CubicLattice::Sizes sizes;
  sizes.ring_x = domain->xperiodic;
  sizes.ring_z = domain->zperiodic;
  margin = 0.0;
  read({lmp, "Create_lsm_fault lattice cubic", 2, narg, arg},
       {{"length", &sizes.length, Must::positive},
        {"width", &sizes.width, Must::positive},
        {"depth", &sizes.depth, Must::positive},
        {"spacing", &sizes.spacing, Must::positive}},
       {"length", "width", "depth", "spacing"});
  diameter = sizes.spacing;
  if (margin == 0.0) margin = diameter;
  try {
    return LSM::CubicLattice(sizes);
  } catch (std::invalid_argument &problem) {
    error->all(FLERR, "Create_lsm_fault lattice cubic: {}", problem.what());
  }
  return {};
}

// Each rank places the nodes of its sub-domain: the lattice is not stored anywhere.
void CreateLSMFault::create_cubic(const LSM::CubicLattice &nodes)
{
  std::string limits;
  for (int axis = 0; axis < 3; axis++) {
    auto [low, high] = nodes.limits(axis);
    if (axis == 1) {
      low += 0.5 * diameter - margin;
      high += margin - 0.5 * diameter;
    }
    limits += fmt::format("{:.17g} {:.17g} ", low, high);
  }
  const bool half = force->newton_bond;
  create_box(limits, LSM::CubicLattice::LINK_TYPES, LSM::CubicLattice::LINKS / (half ? 2 : 1));

  const double inside = mass_of(0.5 * diameter);
  bigint mine[NTYPES + 1] = {};    // particles of each type, and links
  LSM::CubicLattice::Node n;
  for (n.y = 0; n.y < nodes.count(1); n.y++)
    for (n.z = 0; n.z < nodes.count(2); n.z++)
      for (n.x = 0; n.x < nodes.count(0); n.x++) {
        const auto x = nodes.place(n);
        if (!is_mine(x.data())) continue;
        const int type = type_of(nodes.in_plate(n), nodes.in_fault(n), nodes.block(n));
        add_particle(nodes.id(n), type, x.data(), 0.5 * diameter, nodes.share(n) * inside,
                     nodes.block(n));
        mine[type - 1]++;
        const int i = atom->nlocal - 1;
        nodes.for_links(n, half, [&](const LSM::CubicLattice::Node &to, int link) {
          atom->bond_type[i][atom->num_bond[i]] = link;
          atom->bond_atom[i][atom->num_bond[i]++] = static_cast<tagint>(nodes.id(to));
        });
        mine[NTYPES] += atom->num_bond[i];
      }
  bigint all[NTYPES + 1];
  MPI_Allreduce(mine, all, NTYPES + 1, MPI_LMP_BIGINT, MPI_SUM, world);
  const bigint links = half ? all[NTYPES] : all[NTYPES] / 2;
  finish_particles(nodes.size(), links);
  Special(lmp).build();
  if (comm->me == 0) report_types(links, {all, all + NTYPES});
}

// Rank 0 packs and sends its result to all others: the same scene on any number of ranks, even if
// their processors round differently.
void CreateLSMFault::pack(LSM::Packing &packing, const std::function<LSM::Packing()> &make)
{
  const std::string problem = lsm_on_0(world, [&packing, &make] {
    packing = make();
    if (packing.discs.size() > MAXSMALLINT / 8)
      throw std::length_error("too many particles: " + std::to_string(packing.discs.size()));
  });
  if (!problem.empty()) error->all(FLERR, "Create_lsm_fault: {}", problem);
  lsm_share(packing.discs, world);
  lsm_share(packing.links, world);
}

double CreateLSMFault::mass_of(double radius) const
{
  return mass_scale * radius * radius * (cubed ? radius : 1.0);
}

std::vector<double> CreateLSMFault::masses_of(const LSM::Packing &packing, double length) const
{
  std::vector<double> masses;
  masses.reserve(packing.discs.size());
  for (const auto &disc : packing.discs) {
    // a disc in a straight border of a lattice represents half the area of the others
    const double part = lattice && (disc.fault || disc.plate) ? 0.5 : 1.0;
    masses.push_back(part * mass_of(disc.r));
  }
  if (step > 0.0) {
    const auto enough = LSM::masses_for_step(packing, length, step, stiffness, step_kt);
    for (std::size_t i = 0; i < masses.size(); i++) masses[i] = std::max(masses[i], enough[i]);
  }
  return masses;
}

// returns the largest number of links that a particle stores
int CreateLSMFault::most_links_stored(const LSM::Packing &packing) const
{
  std::vector<int> stored(packing.discs.size(), 0);
  for (const auto &link : packing.links) {
    const auto ends = owner_first(packing, link);
    ++stored[ends.first];
    if (!force->newton_bond) ++stored[ends.second];
  }
  return *std::max_element(stored.begin(), stored.end());
}

// formats a box for the command region; 17 digits preserve the numbers
static std::string box(double xlo, double xhi, double ylo, double yhi, double thick)
{
  return fmt::format("{:.17g} {:.17g} {:.17g} {:.17g} {:.17g} {:.17g}", xlo, xhi, ylo, yhi, -thick,
                     thick);
}

std::string CreateLSMFault::box_of(const LSM::LatticeSettings &settings) const
{
  const double x = settings.half_length(), y = settings.half_width() + margin;
  return box(-x, x, -y, y, 0.5 * settings.spacing);
}

std::string CreateLSMFault::box_of(const LSM::PackingSettings &settings) const
{
  // LAMMPS does not accept a box that is much thinner than the range of the contacts
  return box(0.0, settings.length, -margin, settings.width + margin,
             0.5 * std::max(1.0, settings.rmax));
}

// calls a command with its words as LAMMPS passes them
template <class Command> static void with_words(const std::string &line, Command &&command)
{
  std::vector<std::string> words = utils::split_words(line);
  std::vector<char *> pointers;
  for (std::string &word : words) pointers.push_back(&word[0]);
  command(static_cast<int>(pointers.size()), pointers.data());
}

void CreateLSMFault::create_box(const std::string &limits, int link_types, int bonds_per_atom)
{
  const std::string region = "create_lsm_fault_box";
  with_words(region + " block " + limits + " units box", [this](int narg, char **arg) {
    domain->add_region(narg, arg);
  });
  with_words(fmt::format("{} {} bond/types {} extra/bond/per/atom {}", types, region, link_types,
                         bonds_per_atom),
             [this](int narg, char **arg) {
               CreateBox(lmp).command(narg, arg);
             });
  domain->delete_region(region);

  // the order of the particles suits links and contacts better than that of LAMMPS' sorting
  atom->sortfreq = 0;

  atom->nghost = 0;
  atom->avec->clear_bonus();

  // never used, as each particle has its own mass, but write_data writes these masses as well
  // and read_data refuses zeros
  if (atom->mass)
    for (int itype = 1; itype <= types; itype++) atom->set_mass(FLERR, itype, 1.0);
}

bool CreateLSMFault::is_mine(const double *x) const
{
  const double *sublo = domain->sublo, *subhi = domain->subhi;
  for (int c = 0; c < domain->dimension; c++)
    if (x[c] < sublo[c] || x[c] >= subhi[c]) return false;
  return true;
}

void CreateLSMFault::add_particle(bigint id, int type, const double *x, double radius, double mass,
                                  int block)
{
  double place[3] = {x[0], x[1], x[2]};
  atom->avec->create_atom(type, place);
  const int m = atom->nlocal - 1;
  atom->tag[m] = static_cast<tagint>(id);
  atom->radius[m] = radius;
  atom->rmass[m] = mass;
  if (atom->molecule_flag) atom->molecule[m] = block + 1;
}

// completes what LAMMPS knows of the particles and links that were added
void CreateLSMFault::finish_particles(bigint count, bigint links)
{
  atom->nbonds = links;
  atom->data_fix_compute_variable(0, atom->nlocal);

  atom->natoms = lsm_total(static_cast<bigint>(atom->nlocal), world);
  if (atom->natoms != count)
    error->all(FLERR, "Create_lsm_fault: {} of {} particles have an owner", atom->natoms, count);

  atom->tag_check();
  if (atom->map_style != Atom::MAP_NONE) {
    atom->map_init();
    atom->map_set();
  }
}

// Each rank adds the particles in its sub-domain and their links. A particle's ID is its place in
// the packing + 1.
void CreateLSMFault::add_particles(const LSM::Packing &packing, const std::vector<double> &masses)
{
  const int n = static_cast<int>(packing.discs.size());
  std::vector<int> local(n, -1);
  for (int i = 0; i < n; i++) {
    const LSM::Disc &disc = packing.discs[i];
    const double x[3] = {disc.x, disc.y, 0.0};
    if (!is_mine(x)) continue;
    local[i] = atom->nlocal;
    add_particle(i + 1, type_of(disc.plate, disc.fault, disc.block), x, disc.r, masses[i],
                 disc.block);
  }
  add_links(packing, local);
  finish_particles(n, static_cast<bigint>(packing.links.size()));
}

// local holds the local index of each particle, or -1 if it is on another rank
void CreateLSMFault::add_links(const LSM::Packing &packing, const std::vector<int> &local)
{
  for (const auto &link : packing.links) {
    const int type = lattice && LSM::in_border(packing, link) ? BORDER_LINK_TYPE : LINK_TYPE;
    const auto add = [this, type, &local](int from, int to) {
      const int i = local[from];
      if (i < 0) return;
      atom->bond_type[i][atom->num_bond[i]] = type;
      atom->bond_atom[i][atom->num_bond[i]++] = to + 1;
    };
    const auto ends = owner_first(packing, link);
    add(ends.first, ends.second);
    if (!force->newton_bond) add(ends.second, ends.first);
  }
}

void CreateLSMFault::report_types(bigint links, const std::vector<bigint> &of_types)
{
  static const char *names[NTYPES] = {"lower block",      "upper block", "lower fault zone",
                                      "upper fault zone", "lower plate", "upper plate"};
  utils::logmesg(lmp, "Created {} particles and {} links\n", atom->natoms, links);
  for (int i = 0; i < NTYPES; i++)
    utils::logmesg(lmp, "  type {} = {:<16} : {} particles\n", i + 1, names[i], of_types[i]);
}

void CreateLSMFault::report(const LSM::PackingSettings &settings, const LSM::Packing &packing)
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
      LSM::ENOUGH_LINKS, packing.loose, settings.remove_loose ? "removed" : "kept",
      packing.loose_tangent, packing.weakest);
}

// 8 % at the time step for statistics (*)
static constexpr double MUCH_MASS = 20.0;

void CreateLSMFault::report_masses(const LSM::Packing &packing, const std::vector<double> &masses)
{
  if (step <= 0.0) return;
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
  const std::string by = fmt::format("time step {:g} stable with any contacts", step);
  const double percent = 100.0 * raised / sum;
  utils::logmesg(lmp, "  {}: {} particles raised, {:.2f} % more mass in all\n", by, count, percent);
  if (percent > MUCH_MASS && comm->me == 0)
    error->warning(FLERR,
                   "create_lsm_fault: {} makes the fault {:.0f} % heavier, above {:.0f} %: it is "
                   "another model; use a shorter time step",
                   by, percent, MUCH_MASS);
}
