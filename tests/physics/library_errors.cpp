// SPDX-License-Identifier: GPL-2.0-or-later
// LAMMPS as a library on several ranks: an error on one of them must stop the commands on all, and
// the program must be able to continue.
// usage: mpirun -np N library_errors
#include <mpi.h>
#include <signal.h>
#include <sys/resource.h>

#include <cstdio>
#include <cstdlib>
#include <string>

#define LAMMPS_LIB_MPI
#include "library.h"

namespace {

int rank = 0, failures = 0;

void check(bool good, const std::string &what) {
  int mine = good ? 0 : 1, bad = 0;
  MPI_Allreduce(&mine, &bad, 1, MPI_INT, MPI_SUM, MPI_COMM_WORLD);
  if (bad == 0) return;
  ++failures;
  if (rank == 0) std::fprintf(stderr, "FAILED on %d ranks: %s\n", bad, what.c_str());
}

const char *const scene = R"(
units           lj
dimension       2
boundary        p p p
newton          off
atom_style      hybrid bond sphere
atom_modify     map array
comm_modify     cutoff 4
special_bonds   lj/coul 0 1 1
region          box block 0 40 0 40 -0.5 0.5
create_box      1 box bond/types 1 extra/bond/per/atom 6 extra/special/per/atom 6
lattice         hex $(1/(2*sqrt(3)):%.17g)
region          patch block 4 30 4 30 -0.2 0.2
create_atoms    1 region patch
set             type 1 diameter 2.0
set             type 1 mass 1.0
bond_style      lsm/linked
bond_coeff      1 1.0
pair_style      lsm/free
pair_coeff      * * 1.0
create_bonds    many all all 1 1.99 2.01
velocity        all create 0.001 77 loop geom
timestep        0.05
thermo          1000
)";

class Session {
 public:
  Session() {
    const char *words[] = {"library_errors", "-log", "none", "-screen", "none"};
    lammps_ = lammps_open(5, const_cast<char **>(words), MPI_COMM_WORLD, nullptr);
    lammps_commands_string(lammps_, scene);
    check(!lammps_has_error(lammps_), "the scene itself: " + error());
  }
  ~Session() { lammps_close(lammps_); }

  void run(const std::string &commands) { lammps_commands_string(lammps_, commands.c_str()); }
  double thermo(const char *name) { return lammps_get_thermo(lammps_, name); }
  std::string error() {
    char text[1024] = "";
    if (lammps_has_error(lammps_)) lammps_get_last_error_message(lammps_, text, sizeof text);
    return text;
  }
  /// Expects the commands to end with an error on all ranks, whose message contains the given text.
  void fails(const std::string &commands, const std::string &expected) {
    run(commands);
    const std::string found = error();
    check(found.find(expected) != std::string::npos,
          commands + "\n  gives '" + found + "', expected '" + expected + "'");
  }

 private:
  void *lammps_;
};

}  // namespace

int main(int argc, char **argv) {
  MPI_Init(&argc, &argv);
  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  signal(SIGXFSZ, SIG_IGN);
  if (rank == 0) std::remove("full.pe");
  MPI_Barrier(MPI_COMM_WORLD);
  const std::string start = "fix move all lsm/nve\n";

  // Files that cannot be written, which the first run finds.
  for (const char *files :
       {"catalogue no/folder/c.csv", "series no/folder/s.pe", "catalogue /dev/full"})
    Session().fails(start + "compute events all lsm/events " + files + "\nrun 10\n", "cannot");
  for (const char *file : {"no/file.in", "."})
    Session().fails(std::string("include_beside ") + file + "\n", "cannot read file");
  Session().fails(
      "fix plates all lsm/nve\nchange_box all boundary p f p\ngroup a id 1 2\ngroup b id 2 3\nfix "
      "p all lsm/plates a b "
      "stress 1\nrun 1\n",
      "is in both plates");

  // A disk that becomes full during a run, which only rank 0 notices.
  {
    Session session;
    if (rank == 0) {
      struct rlimit limit = {20000, RLIM_INFINITY};
      setrlimit(RLIMIT_FSIZE, &limit);
    }
    session.fails(start + "compute events all lsm/events series full.pe\nrun 5000\n",
                  "cannot write");
    if (rank == 0) {
      struct rlimit limit = {RLIM_INFINITY, RLIM_INFINITY};
      setrlimit(RLIMIT_FSIZE, &limit);
    }
  }
  // A value that is not finite, which rank 0 finds when the block arrives.
  Session().fails(
      start +
          "compute events all lsm/events check 1000000\nrun 100\nvelocity all set 1e200 0 0\n"
          "neigh_modify every 1000000 delay 1000000 check no\ntimestep 1e200\nfix move all lsm/nve "
          "dtcheck off\nrun 250\n",
      "not finite");
  // A block of samples is in transit when another command fails between two steps.
  {
    Session session;
    session.fails(start +
                      "compute events all lsm/events block 10\nvariable bad equal 1/(step<115)\n"
                      "fix print all print 5 '${bad}' screen no\nrun 1000\n",
                  "Divide by 0");
  }
  // Fix lsm/nve clears forces itself until a run ends, also in an error: forces after that are the
  // same.
  double forces[2];
  for (const char *how : {"soft message no", "hard"}) {
    Session session;
    session.run(start + "variable n equal step\nfix stop all halt 1 v_n >= 20 error " + how +
                "\nrun 100\n");
    session.error();
    session.run("unfix stop\nfix push all addforce 0 0 0\nrun 0\n");
    forces[*how == 'h'] = session.thermo("fnorm");
  }
  check(forces[0] > 0.0 && forces[0] == forces[1], "forces after an error within a run");
  // The program continues.
  {
    Session session;
    session.run(start + "compute events all lsm/events\nrun 200\n");
    check(session.error().empty(), "a run after all that: " + session.error());
  }
  int all = 0;
  MPI_Allreduce(&failures, &all, 1, MPI_INT, MPI_MAX, MPI_COMM_WORLD);
  MPI_Finalize();
  if (rank == 0 && all == 0) std::printf("errors of one rank reach all: passed\n");
  return all == 0 ? 0 : 1;
}
