#!/bin/bash
# SPDX-License-Identifier: GPL-2.0-or-later
# How long does the first command of the README take where nothing is installed? Makes a bare Debian 12 in FOLDER with
# debootstrap, from the mirror of this machine, puts the last commit there, and runs inputs/first-catalogue.sh in it, which
# prints how long its parts took. As root; needs the network and 4 GB.
# usage: first-command.sh FOLDER
set -euo pipefail
[ $# -eq 1 ] && [ ! -e "$1" ] || {
  echo "usage: first-command.sh FOLDER, which must not be there yet" >&2
  exit 2
}
[ "$(id -u)" = 0 ] || {
  echo "first-command.sh: changes the root folder, which only root may" >&2
  exit 1
}
root=$(cd "$(dirname "$0")/../.." && pwd)
. "$root/lammps-pkg/cmake/debian-packages.sh"
command -v debootstrap >/dev/null || install_debian_packages debootstrap
mirror=$(apt-get indextargets --format '$(SITE)' 'Created-By: Packages' 'Codename: bookworm' | head -n 1)
debootstrap --variant=minbase --include=ca-certificates bookworm "$1" ${mirror:+"$mirror"} >"$1.log"
bare=$(cd "$1" && pwd)
cp /etc/resolv.conf /etc/hosts "$bare/etc/"
mkdir "$bare/checkout"
git -C "$root" archive HEAD | tar -x -C "$bare/checkout"
# Without its own process and mount namespaces what is mounted would have to be unmounted by hand.
time env -i PATH=/usr/sbin:/usr/bin:/sbin:/bin HOME=/root TERM="${TERM:-dumb}" unshare --mount --pid --fork bash -c "
  mount -t proc proc '$bare/proc' && mount --rbind /dev '$bare/dev' && exec chroot '$bare' /checkout/inputs/first-catalogue.sh"
