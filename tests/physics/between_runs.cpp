// SPDX-License-Identifier: GPL-2.0-or-later
// Commands between two runs that change nothing, for each style and law, in two and three
// dimensions: motion, forces and records of the second run are those without the command, also with
// `pre no`.
// usage: mpirun -np N between_runs
#include <mpi.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <map>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "facing_spheres.h"

#define LAMMPS_LIB_MPI
#include "library.h"

namespace {

int rank = 0, ranks = 1, failures = 0, done = 0;

struct Scene {
  const char *name;
  std::string script;
  bool links, records, friction;
};

// Two linked pairs, of which the second link may break, and a sphere that is thrown at them.
std::string links(int dimension, const std::string &ratio, const std::string &pair) {
  const std::string z = dimension == 3 ? "-10 10" : "-0.5 0.5";
  return "dimension " + std::to_string(dimension) + "\nboundary f f " +
         (dimension == 3 ? "f" : "p") + R"(
newton off
atom_style hybrid bond sphere
atom_modify map array
comm_modify mode single cutoff 4.5
neighbor 0.4 bin
special_bonds lj/coul 0 1 1
region box block -30 30 -10 10 )" +
         z + R"(
create_box 2 box bond/types 2 extra/bond/per/atom 6 extra/special/per/atom 12
create_atoms 1 single -1 0 0
create_atoms 1 single 1.05 0 0
create_atoms 2 single -1 1.99 0
create_atoms 2 single 1.02 1.98 0
create_atoms 2 single 3.6 1.2 0
set group all diameter 2
set group all mass 1
create_bonds single/bond 1 1 2
create_bonds single/bond 2 3 4
bond_style lsm/linked
bond_coeff 1 1.0 )" +
         std::string(pair.find("kelvin") == std::string::npos ? "" : "kelvin-voigt 0.1") + R"(
bond_coeff 2 1.0 )" +
         ratio + "\n" + pair +
         R"(
timestep 0.1
fix move all lsm/nve viscosity 0.01
group top type 2
group thrown id 5
velocity top set 0.02 -0.01 0
velocity thrown set -0.1 0.02 0
)" + (dimension == 3 ? "velocity top set NULL NULL 0.01\n" : "");
}

// Upper spheres that slide over lower ones, which face them and are held.
std::string sliding(int dimension, const std::string &law) {
  const bool space = dimension == 3;
  return physics::facing_spheres(
             8, space ? 1 : 0,
             "dimension " + std::to_string(dimension) + "\nboundary p f " + (space ? "f" : "p"),
             space ? "0 16 -10 10 -4 4" : "0 16 -10 10 -0.5 0.5") +
         "velocity above set 0.01 -0.002 0\n" +
         (space ? "velocity above set NULL NULL 0.004\n" : "") + "pair_style lsm/friction " +
         law.substr(0, law.find(' ')) + "\npair_coeff * * off\npair_coeff 1 2 1.0 1.0 " +
         law.substr(law.find(' ') + 1) + "\nfix move above lsm/nve viscosity 0.01\n";
}

const char *const slip =
    "compute e all lsm/events ledger yes overwrite yes sides below above faces below above driving "
    "0.01 modulus 0.5 interval 10 bin 2 block 7 ruptures b.csv history b.slip series b.pe\n";

const char *const fault = R"(
dimension 2
boundary p f p
newton off
atom_style hybrid bond sphere
atom_modify map array
special_bonds lj/coul 0 1 1
create_lsm_fault length 12 width 8 seed 1 failures 200
comm_modify mode single cutoff 3.6
neighbor 0.4 bin
group lower type 5
group upper type 6
group plates union lower upper
group blocks subtract all plates
group below type 1 3 5
group above type 2 4 6
bond_style lsm/linked
bond_coeff 1 1.0
pair_style lsm/friction slip-weakening
pair_coeff * * 1.0 0.5 mu 0.5 mu_static 0.6 dc 0.001 heal 0.01
timestep 0.05
fix move blocks lsm/nve viscosity 0.05
fix plates all lsm/plates lower upper stress 0.025 impedance 0.6 velocity 0.0002
)";

// A lattice under traction that radiates into absorbing borders.
std::string radiating(int dimension) {
  const bool space = dimension == 3;
  return "dimension " + std::to_string(dimension) + "\nboundary f f " + (space ? "f" : "p") + R"(
newton off
atom_style hybrid bond sphere
atom_modify map array
comm_modify mode single cutoff 2.3
neighbor 0.1 bin
special_bonds lj/coul 0 1 1
)" +
         (space ? "create_lsm_fault lattice cubic length 6 width 8 depth 4 spacing 1 mass r3 8\n"
                : "create_lsm_fault lattice length 12 width 8 spacing 1 mass r2 8\n") +
         "bond_style lsm/linked\n" +
         (space ? "bond_coeff 1 1.0 kelvin-voigt 0.02\nbond_coeff 2 0.5 kelvin-voigt 0.02\n"
                  "bond_coeff 3 0.25 kelvin-voigt 0.02\nbond_coeff 4 1.0 rest $(sqrt(2):%.17g)\n"
                  "bond_coeff 5 0.5 rest $(sqrt(2):%.17g)\n"
                : "bond_coeff * 1.0 kelvin-voigt 0.02\n") +
         R"(pair_style lsm/friction slip-weakening
pair_coeff * * off
pair_coeff 3 4 1.0 1.5 mu 0.5 mu_static 0.7 dc 1e-4
group lower type 3
group upper type 4
group below type 1 3 5
group above type 2 4 6
group caps type 5 6
variable shear atom 5.5e-4+3e-4*(abs(x)<3)
fix load all lsm/traction lower upper 1e-3 v_shear )" +
         std::string(space ? "dip 1e-4 " : "") + R"(per/mass 2
fix caps caps lsm/absorb y $(sqrt(3)) 1.0 per/mass 2
fix move all lsm/nve
timestep 0.1
compute e all lsm/events ledger yes overwrite yes sides below above faces lower upper driving 1e-5 modulus 1 interval 5 block 7 ruptures b.csv history b.slip series b.pe
)";
}

struct Command {
  std::string text;
  enum { ANY, LINKS, FREE, PLAIN, ALONE, ONE_RANK, SETUP } needs = ANY;
};

// FREE: neither friction nor records; PLAIN: no dashpots either, whose forces follow from the
// velocities that rerun sets; ALONE: not within a run; ONE_RANK: LAMMPS itself needs `pre yes`
// after it on several ranks; SETUP: always
const std::vector<Command> commands = {
    {"write_restart b.restart"},
    {"write_data b.data"},
    {"write_data b.data nocoeff"},
    {"write_coeff b.coeff"},
    {"write_dump all custom b.dump id x y"},
    {"pair_write 1 2 10 r 0.5 2 b.pair K"},
    {"bond_write 1 10 0.5 2 b.bond K", Command::LINKS},
    {"info all out overwrite b.info"},
    {"print 'at step $(step)'"},
    {"reset_atoms image all", Command::LINKS},
    {"reset_atoms mol all", Command::LINKS},
    {"delete_bonds nobody multi", Command::LINKS},
    {"create_bonds many nobody nobody 1 0.1 0.2", Command::LINKS},
    {"delete_atoms overlap 1e-9 all all", Command::ONE_RANK},
    {"delete_atoms group nobody", Command::ONE_RANK},
    {"displace_atoms all move 0 0 0", Command::ONE_RANK},
    {"displace_atoms nobody move 1 0 0", Command::ONE_RANK},
    {"velocity nobody set 1 0 0"},
    {"velocity all set NULL NULL NULL"},
    {"set group nobody diameter 3"},
    {"set group nobody bond 1", Command::LINKS},
    {"change_box all x delta 0 0", Command::ONE_RANK},
    {"balance 1.0 shift x 5 1.0"},
    {"minimize 0 0 0 0", Command::FREE},
    {"write_dump all custom b.dump id x y vx vy modify format float %.17g\n"
     "rerun b.dump dump x y vx vy",
     Command::PLAIN},
    {"write_dump all custom b.dump id x y vx vy modify format float %.17g\n"
     "read_dump b.dump $(step) x y vx vy",
     Command::SETUP},
    {"group more id 1\ngroup more delete"},
    {"fix p all print 5 x screen no\nunfix p"},
    {"compute ke all ke/atom\nuncompute ke"},
    {"dump d all atom 100 b.dump\nundump d"},
    {"restart 1000 b.restart\nrestart 0"},
    {"thermo 7\nthermo_modify norm no"},
    {"neigh_modify every 1"},
    {"comm_modify vel no"},
    {"run_style verlet", Command::SETUP},
    {"timestep $(dt)"},
    {"reset_timestep $(step)"},
    {"run 0", Command::ALONE},
    {"run 0 pre no post no", Command::ALONE},
    {"include_beside b.empty"},
    {"write_coeff b.coeff\npair_write 1 2 10 r 0.5 2 b.pair K\nwrite_restart b.restart"},
};

class Session {
 public:
  explicit Session(const std::string &script) {
    const char *words[] = {"between_runs", "-log", "none", "-screen", "none"};
    lammps_ = lammps_open(5, const_cast<char **>(words), MPI_COMM_WORLD, nullptr);
    run("units lj\n" + script + "group nobody empty\nthermo_style custom step\n");
  }
  ~Session() { lammps_close(lammps_); }
  void run(const std::string &text) {
    if (!error.empty()) return;
    lammps_commands_string(lammps_, text.c_str());
    char message[1024] = "";
    if (lammps_has_error(lammps_)) {
      lammps_get_last_error_message(lammps_, message, sizeof message);
      error = message;
    }
  }
  std::string error;

  using State = std::map<std::string, std::vector<double>>;
  State state(bool records) {
    State all;
    if (!error.empty()) return all;
    const auto atoms = static_cast<std::size_t>(lammps_get_natoms(lammps_));
    for (const char *of : {"x", "v", "f"}) {
      all[of].resize(3 * atoms);
      lammps_gather_atoms(lammps_, const_cast<char *>(of), 1, 3, all[of].data());
    }
    if (!records) return all;
    int *const size =
        static_cast<int *>(lammps_extract_compute(lammps_, "e", LMP_STYLE_GLOBAL, LMP_SIZE_VECTOR));
    const double *const values = static_cast<double *>(
        lammps_extract_compute(lammps_, "e", LMP_STYLE_GLOBAL, LMP_TYPE_VECTOR));
    for (int n = 0; n < *size; n++) all["records " + std::to_string(n + 1)] = {values[n]};
    run("uncompute e\n");
    for (const char *file : {"b.pe", "b.slip"}) {
      std::ifstream in(file, std::ios::binary | std::ios::ate);
      all[std::string("bytes of ") + file] = {in ? static_cast<double>(in.tellg()) : 0.0};
    }
    return all;
  }

 private:
  void *lammps_;
};

constexpr double CLOSE = 1e-11;

void check(bool good, const std::string &what) {
  int mine = good ? 0 : 1, bad = 0;
  MPI_Allreduce(&mine, &bad, 1, MPI_INT, MPI_MAX, MPI_COMM_WORLD);
  ++done;
  if (!bad) return;
  ++failures;
  if (rank == 0) std::fprintf(stderr, "FAILED: %s\n", what.c_str());
}

Session::State after(const Scene &scene, const std::string &command, const std::string &how,
                     std::string &error) {
  Session one(scene.script);
  if (how.find("every") == std::string::npos)
    one.run("run 33\n" + command + "\nthermo_style custom step\nrun 60 " + how + "\n");
  else {
    std::string words;
    std::istringstream lines(command);
    for (std::string line; std::getline(lines, line);) words += " \"" + line + "\"";
    one.run("run 66 " + how + (words.empty() ? " NULL" : words) + "\n");
  }
  const auto state = one.state(scene.records);
  error = one.error;
  return state;
}

void compare(const Scene &scene, const char *only) {
  std::vector<std::string> hows = {"pre no"};
  if (ranks == 1) hows.insert(hows.end(), {"pre yes", "every 33", "pre no every 33"});
  for (const std::string &how : hows) {
    std::string error;
    const auto right = after(scene, "", how, error);
    check(error.empty(), std::string(scene.name) + ": " + error);
    double moved = 0.0;
    for (double v : right.count("v") ? right.at("v") : std::vector<double>())
      moved = std::max(moved, std::fabs(v));
    check(moved > 1e-6, std::string(scene.name) + ": something moves");
    for (const Command &command : commands) {
      if (only && command.text.find(only) == std::string::npos) continue;
      if (command.needs == Command::LINKS && !scene.links) continue;
      const bool alone = how.find("every") == std::string::npos;
      const bool free = alone && !scene.records && !scene.friction;
      if (command.needs == Command::ALONE && !alone) continue;
      if (command.needs == Command::ONE_RANK && ranks > 1) continue;
      if (command.needs == Command::FREE && !free) continue;
      if (command.needs == Command::PLAIN && !(free && std::strstr(scene.name, "elastic")))
        continue;
      if (command.needs == Command::SETUP && how != "pre yes") continue;
      const auto found = after(scene, command.text, how, error);
      std::string what = error;
      if (how.find("no every") != std::string::npos &&
          error.find("has initialized LAMMPS") != std::string::npos)
        what.clear();
      else if (error.empty())
        for (const auto &[name, values] : right) {
          const auto at = found.find(name);
          double worst = 0.0, scale = 0.0;
          for (std::size_t n = 0; n < values.size(); n++) {
            worst = std::max(worst, std::fabs(values[n] - at->second.at(n)));
            scale = std::max(scale, std::fabs(values[n]));
          }
          if (!(worst <= CLOSE * std::max(scale, 0.1)))
            what += " " + name + " differs by " + std::to_string(worst) + " of " +
                    std::to_string(scale);
        }
      check(what.empty(),
            std::string(scene.name) + ": " + command.text + "; run " + how + ": " + what);
    }
  }
}

// Dashpots act with the velocities of each snapshot.
void rerun_has_velocities() {
  Session one(links(2, "", "pair_style lsm/free\npair_coeff * * 1.0\n"));
  one.run(
      "bond_coeff 1 1.0 kelvin-voigt 0.5\nvelocity top set 0 0 0\nset atom 2 vx 0.2\n"
      "pair_coeff 1 2 off\ndump d all custom 10 b.dump id x y vx vy\n"
      "dump_modify d sort id format float %.17g\nrun 40\nundump d\n");
  double least = 1.0, most = 0.0;
  for (int step = 0; step <= 40; step += 10) {
    const std::string at = std::to_string(step);
    one.run("rerun b.dump first " + at + " last " + at + " dump x y vx vy\n");
    if (!one.error.empty()) break;
    auto now = one.state(false);
    const double right =
        -1.0 * (now["x"][3] - now["x"][0] - 2.0 + 0.5 * (now["v"][3] - now["v"][0]));
    check(std::fabs(now["f"][3] - right) < 1e-12, "rerun of step " + at + ": force " +
                                                      std::to_string(now["f"][3]) + ", right is " +
                                                      std::to_string(right));
    least = std::min(least, right);
    most = std::max(most, right);
  }
  check(one.error.empty() && most - least > 0.05,
        one.error + "rerun: the forces differ from snapshot to snapshot");
}

// Whatever the number of steps of the run before was.
void rerun_is_refused() {
  for (const char *last : {"20", "30"}) {
    Session one(sliding(2, "coulomb 0.3"));
    one.run(std::string("run 20\nwrite_dump all custom b.dump id x y\nrun ") +
            (last[0] == '2' ? "0" : "10") + "\nreset_timestep 20\nrerun b.dump first 20 last " +
            last + " dump x y\n");
    check(one.error.find("does not work with rerun") != std::string::npos,
          std::string("rerun until ") + last + ": " + one.error);
  }
}

// Faces that are pressed on each other move together across borders of ranks and of the period, and
// a restart file is written after each three steps of `run N every 3`, when particles have left
// their ranks or were wrapped since the list was built. Neither that run nor one that continues
// from a file is another motion.
void restart_files_between_pieces() {
  const std::string load = R"(
comm_modify mode single cutoff 4.5
neighbor 0.4 bin
fix press above addforce 0 -0.05 0
fix hold below addforce 0 0.05 0
fix go all lsm/nve
)";
  const std::string begin =
      sliding(2, "slip-weakening mu 0.3 mu_static 0.5 dc 0.01 heal 0.1") +
      "unfix move\ndisplace_atoms below move 0.85 0 0\ndisplace_atoms above move 1.15 0 0\n"
      "velocity all set 0.3 0 0\nvelocity above set 0.31 0 0\n" +
      load;
  std::string error;
  const auto motion = [&error](const std::string &script) {
    Session one(script);
    const auto state = one.state(false);
    error = one.error;
    return state;
  };
  const auto right = motion(begin + "run 18 every 3 NULL\n");
  check(error.empty(), "pieces: " + error);
  const auto same = [&](const std::string &script, const std::string &what) {
    auto found = motion(script);
    double worst = 0.0;
    if (error.empty())
      for (const char *of : {"x", "v", "f"})
        for (std::size_t n = 0; n < right.at(of).size(); n++)
          worst = std::max(worst, std::fabs(std::remainder(found[of].at(n) - right.at(of)[n],
                                                           *of == 'x' ? 16.0 : 1e9)));
    check(error.empty() && worst < 1e-9, what + ": " + error + " " + std::to_string(worst));
  };
  same(begin + "run 18 every 3 \"write_restart b.*.restart\"\n", "restart files between pieces");
  for (int step : {6, 9})
    same("read_restart b." + std::to_string(step) + ".restart\n" + load +
             "run 18 upto every 3 NULL\n",
         "a run from step " + std::to_string(step) + " between pieces");
}

// A fault that slides keeps the forces of its contacts when fix lsm/traction adds nothing to them.
void traction_keeps_contacts() {
  std::vector<double> forces[2];
  for (const char *fix : {"", "fix load all lsm/traction lower upper 0.0 0.0\n"}) {
    Session one(
        physics::lattice_fault("create_lsm_fault lattice length 12 width 16 spacing 1 mass r2 8") +
        "unfix load\ngroup above type 2 4 6\nvelocity above set 0.01 -0.005 0\nrun 20\n");
    one.run(fix + std::string("run 0\n"));
    check(one.error.empty(), one.error);
    forces[*fix != '\0'] = one.state(false)["f"];
  }
  double most = 0.0, worst = 0.0;
  for (std::size_t n = 0; n < forces[0].size(); n += 3) {
    most = std::max(most, std::fabs(forces[0][n]));
    for (std::size_t c = n; c < n + 2; c++)
      worst = std::max(worst, std::fabs(forces[1].at(c) - forces[0][c]));
  }
  check(most > 1e-3 && worst < 1e-12, "fix lsm/traction changes contacts by " +
                                          std::to_string(worst) + " of " + std::to_string(most));
}

// Once fix lsm/traction is gone, contacts have the radii of particles at once.
void contacts_without_traction() {
  double most[2] = {0.0, 0.0};
  for (const char *command : {"", "\"unfix load\" "}) {
    Session one(radiating(2));
    one.run(
        "compute p all pair/local force\ncompute most all reduce max c_p inputs local\n"
        "displace_atoms above move 0 -1e-3 0\nrun 1 every 1 " +
        std::string(command) + "\"print '$(c_most)' file b.force screen no\"\n");
    check(one.error.empty(), "unfix of fix lsm/traction: " + one.error);
    std::ifstream("b.force") >> most[*command != '\0'];
  }
  check(rank || (most[0] > 1.5e-3 && std::fabs(most[1] - 1e-3) < 1e-4),
        "contacts after unfix of fix lsm/traction: " + std::to_string(most[0]) + " " +
            std::to_string(most[1]));
}

void bond_write_knows_the_rest_length() {
  std::remove("b.bond");
  Session one(links(2, "", "pair_style lsm/free\npair_coeff * * 1.0\n"));
  one.run("bond_write 1 10 0.5 2 b.bond K\n");
  std::ifstream in("b.bond");
  const std::string table((std::istreambuf_iterator<char>(in)), {});
  check(one.error.empty() && (rank || table.find("N 10 EQ 2\n") != std::string::npos),
        "bond_write before the first run: " + one.error + table);
}

// pair_write knows types and distances: neither dashpots nor friction nor lists, and of each type
// the largest radius, on whichever rank; before a run, after one, and between its pieces.
void tables_of_types() {
  for (const char *how : {"", "run 2\n", "run 4 every 2 "}) {
    std::remove("b.pair");
    Session one(sliding(2, "coulomb 0.3"));
    const std::string write = "pair_write 1 2 3 r 1 2 b.pair K";
    one.run(
        "set type 2 diameter 1\nset atom 12 diameter 3\nvelocity above set 0.1 0 0\n"
        "pair_coeff 1 2 1.0 1.0 0.3 kelvin-voigt 0.5\n" +
        std::string(how) + (std::strstr(how, "every") ? '"' + write + '"' : write) + "\n");
    std::ifstream in("b.pair");
    std::string line, table;
    while (std::getline(in, line))
      if (line.find("       2 ") == 0) table = line;
    std::istringstream words(table);
    double n = 0.0, r = 0.0, energy = 0.0, force = 0.0;
    words >> n >> r >> energy >> force;
    check(one.error.empty() &&
              (rank || (std::fabs(energy - 0.5) < 1e-9 && std::fabs(force - 1.0) < 1e-9)),
          std::string(how) + "pair_write: " + one.error + table);
  }
}

}  // namespace

int main(int argc, char **argv) {
  MPI_Init(&argc, &argv);
  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  MPI_Comm_size(MPI_COMM_WORLD, &ranks);
  if (rank == 0) std::ofstream("b.empty") << "\n";
  MPI_Barrier(MPI_COMM_WORLD);
  const std::string ledger = "compute e all lsm/events ledger yes series b.pe overwrite yes\n";
  const std::string free = "pair_style lsm/free\npair_coeff * * 1.0 kelvin-voigt 0.05\n";
  const std::string rough =
      "pair_style lsm/friction\npair_coeff * * 1.0 1.0 0.4 kelvin-voigt 0.05\n";
  std::vector<Scene> scenes;
  for (int d : {2, 3}) {
    scenes.push_back({"elastic links", links(d, "", "pair_style lsm/free\npair_coeff * * 1.0\n"),
                      true, false, false});
    scenes.push_back({"links alone", links(d, "", free), true, false, false});
    scenes.push_back({"links", links(d, "1.05", free) + ledger, true, true, false});
    scenes.push_back({"links and friction", links(d, "1.05", rough) + ledger, true, true, true});
    for (const char *law :
         {"coulomb 0.3", "coulomb 0.3 0.4", "slip-weakening mu 0.3 mu_static 0.5 dc 0.01 heal 0.1",
          "velocity-weakening mu 0.5 vc 0.01",
          "rate-state-ageing mu 0.3 a 0.01 b 0.02 dc 0.01 v0 0.01",
          "rate-state-slip mu 0.3 a 0.01 b 0.02 dc 0.01 v0 0.01"})
      scenes.push_back({law, sliding(d, law) + slip, false, true, true});
    scenes.push_back({"traction", radiating(d), true, true, true});
  }
  const std::string recorded =
      "compute e all lsm/events ledger yes overwrite yes sides below above faces below above "
      "interval 10 memory 1 block 7 ruptures b.csv series b.pe\n";
  scenes.push_back({"plates", fault + recorded, true, true, true});
  scenes.push_back(
      {"leaps",
       fault +
           std::string(
               "fix leap all lsm/leap plates fast 0.005 calm 0.2 rest 1e9 look 0.25 ramp 1\n") +
           recorded,
       true, true, true});
  if (argc < 2) {
    rerun_has_velocities();
    rerun_is_refused();
    traction_keeps_contacts();
    contacts_without_traction();
    restart_files_between_pieces();
    bond_write_knows_the_rest_length();
    tables_of_types();
  }
  // On several ranks, a scene in a plane, one in space, and the fault.
  if (ranks > 1) scenes = {scenes[2], scenes[scenes.size() - 4], scenes.back()};
  for (const Scene &scene : scenes)
    if (argc < 2 || std::strstr(scene.name, argv[1])) compare(scene, argc > 2 ? argv[2] : nullptr);
  MPI_Finalize();
  if (rank == 0) std::printf("%d checks of commands between runs, %d failed\n", done, failures);
  return failures == 0 ? 0 : 1;
}
