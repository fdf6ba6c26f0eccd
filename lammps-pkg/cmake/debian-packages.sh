# SPDX-License-Identifier: GPL-2.0-or-later
# To be sourced. install_debian_packages NAME... installs those that are missing, as root or with
# sudo; on a system without dpkg it only says what is expected to be there.
install_debian_packages() {
  if ! command -v dpkg-query >/dev/null || ! command -v apt-get >/dev/null; then
    echo "Not a Debian system: these are expected to be installed: $*" >&2
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
      echo "These Debian packages are missing and neither root nor sudo is at hand: ${missing[*]}" >&2
      return 1
    fi
    as_root=(sudo)
  fi
  echo "Installing Debian packages: ${missing[*]}"
  "${as_root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get -q -q update </dev/null
  "${as_root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get -q -q install -y --no-install-recommends \
    "${missing[@]}" </dev/null >/dev/null
}

# What the build of the LAMMPS part needs, the fetching of LAMMPS included.
lammps_packages="build-essential cmake ninja-build libopenmpi-dev openmpi-bin libpng-dev zlib1g-dev
  gzip xz-utils ca-certificates git"
plot_packages="gnuplot-nox fonts-dejavu-core"
postproc_packages="libcli11-dev libfmt-dev nlohmann-json3-dev libgsl-dev libfftw3-dev zlib1g-dev
  liblzma-dev libjs-dygraphs libpugixml-dev libhowardhinnant-date-dev"
