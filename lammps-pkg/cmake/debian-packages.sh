# SPDX-License-Identifier: GPL-2.0-or-later
# To be sourced. install_debian_packages NAME... installs those that are missing, as root or with
# sudo. Without apt, root or sudo it says in one line what is expected, and what is there is used;
# need_programs says what is not.
install_debian_packages() {
  if ! command -v dpkg-query >/dev/null || ! command -v apt-get >/dev/null; then
    echo "No apt here. Expected to be installed, by their names in Debian: $*" >&2
    return 0
  fi
  local name missing=() as_root=()
  for name in "$@"; do
    if [ "$(dpkg-query -W -f='${db:Status-Status}' "$name" 2>/dev/null || true)" != installed ]; then
      missing+=("$name")
    fi
  done
  [ ${#missing[@]} -gt 0 ] || return 0
  if [ "$(id -u)" -ne 0 ]; then
    if ! command -v sudo >/dev/null; then
      echo "Neither root nor sudo here. Expected to be installed, and missing as Debian packages: ${missing[*]}" >&2
      return 0
    fi
    as_root=(sudo)
  fi
  echo "Installing Debian packages: ${missing[*]}"
  "${as_root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get -q -q -o DPkg::Lock::Timeout=600 update </dev/null
  "${as_root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get -q -q -o DPkg::Lock::Timeout=600 install -y --no-install-recommends \
    "${missing[@]}" </dev/null >/dev/null
}

# need_programs NAME...: ends with one line where one is not there.
need_programs() {
  local name missing=()
  for name in "$@"; do
    command -v "$name" >/dev/null || missing+=("$name")
  done
  [ ${#missing[@]} -eq 0 ] || {
    echo "Not found: ${missing[*]}; see above for what is expected" >&2
    return 1
  }
}

# debian_lammps: installs Debian's own LAMMPS where it is of the reference version (Debian 13), and
# sets lammps_library to its file; nothing of LAMMPS has to be compiled then.
debian_lammps() {
  lammps_library=
  command -v apt-cache >/dev/null && command -v dpkg-query >/dev/null || return 0
  # Not by 'grep -q', which ends at the first match and lets apt-cache fail, at times, as its pipe is gone.
  [[ $(apt-cache policy liblammps-dev 2>/dev/null) == *"Candidate: 20250204"* ]] || return 0
  install_debian_packages liblammps-dev
  lammps_library=$(dpkg-query -L liblammps-dev 2>/dev/null | grep '/liblammps\.so$') || lammps_library=
}

# configure_programs SOURCE BUILD: from a fresh checkout to a build folder in which everything can be
# made. One that is there keeps its options; one whose configuration failed is completed.
configure_programs() {
  # The lists are words on purpose.
  install_debian_packages $lammps_packages $plot_packages $postproc_packages $test_packages
  need_programs cmake ninja c++ mpirun gnuplot
  [ ! -f "$2/build.ninja" ] && [ ! -f "$2/Makefile" ] || return 0
  debian_lammps
  packages_took=$SECONDS
  cmake -S "$1" -B "$2" -G Ninja -DLSM_JOIN_SOURCES=ON ${lammps_library:+"-DLSM_LAMMPS_LIBRARY=$lammps_library"}
}

# Says in one line why BUILD cannot be a build folder of SOURCE: another checkout's would be built.
refuse_other_build() {
  local key path other
  for key in HOME:"$1" CACHEFILE:"$2"; do
    path=$(sed -n "s/^CMAKE_${key%%:*}_\(DIRECTORY\|DIR\):INTERNAL=//p" "$2/CMakeCache.txt" 2>/dev/null) || path=
    [ -z "$path" ] || [ "$path" -ef "${key#*:}" ] || {
      echo "$2 is a build folder for $path, expected one of $1 (LSM_BUILD_DIR), or none" >&2
      return 1
    }
  done
  [ -d "$2" ] || return 0
  other=$(find "$2" ! -type l ! -writable -printf '%p, which is of %u' -quit)
  [ -z "$other" ] || {
    echo "cannot write to $other, expected a folder of one user (LSM_BUILD_DIR)" >&2
    return 1
  }
}

# build_programs SOURCE BUILD TARGET...: one at a time in a build folder. What a start that was
# killed leaves behind, apt or a compiler, holds the lock as well.
build_programs() {
  local source=$1 build=$2
  shift 2
  refuse_other_build "$source" "$build" || return 1
  # Where a tool is missing, configure_programs says which.
  if mkdir -p "$build" 2>/dev/null; then exec 8<"$build"; else exec 8<"$source"; fi
  if command -v flock >/dev/null && ! flock -n 8; then
    echo "Waiting until another start has built the programs"
    flock -w 3600 8 || {
      echo "programs in $build are still being built, expected that to end within an hour" >&2
      return 1
    }
  fi
  configure_programs "$source" "$build"
  packages_took=${packages_took:-$SECONDS}
  cmake --build "$build" --target "$@"
  exec 8<&-
}

# What the build of the LAMMPS part needs, the fetching of LAMMPS included.
lammps_packages="build-essential cmake ninja-build libopenmpi-dev openmpi-bin libpng-dev zlib1g-dev
  gzip xz-utils ca-certificates git"
plot_packages="gnuplot-nox fonts-dejavu-core"
postproc_packages="libcli11-dev libfmt-dev nlohmann-json3-dev libgsl-dev libfftw3-dev zlib1g-dev
  liblzma-dev libjs-dygraphs libexpat1-dev libhowardhinnant-date-dev"
test_packages="libgtest-dev libgmock-dev python3-pytest python3-numpy"
