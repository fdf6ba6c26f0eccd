#!/bin/bash
# SPDX-License-Identifier: GPL-2.0-or-later
# The Debian package, unpacked into an empty root and used from there: programs, plugin, scenes,
# headers, manual pages.
# usage: check-install.sh BUILD STOCK_LMP CXX VERSION
set -euo pipefail
export LC_ALL=C
build=$1 stock=$2 cxx=$3 version=$4
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
here=$(cd "$(dirname "$0")" && pwd)
cd "$work"
fail() { echo "FAILED: $*"; [ ! -f out ] || tail -n 20 out; exit 1; }

cpack --config "$build/CPackConfig.cmake" -B packages >out 2>&1 || fail "cpack"
deb=(packages/*.deb)
[ "$(dpkg-deb -f "${deb[0]}" Version)" = "$version" ] || fail "the package is of version $(dpkg-deb -f "${deb[0]}" Version), not $version"
for library in libgsl libopenmpi libfftw3; do
  [[ $(dpkg-deb -f "${deb[0]}" Depends) == *$library* ]] || fail "the package does not depend on $library"
done
dpkg-deb -x "${deb[0]}" root
[ "$(ls root)" = usr ] || fail "the package has files outside /usr: $(ls root)"
bin=$work/root/usr/bin share=$work/root/usr/share
! grep -rlI -e "$build" root >out || fail "files name the build folder"

# programs as installed: nothing of the build folder in the environment
clean() { env -i PATH="$bin:/usr/bin:/bin" HOME="$work" "${mpi[@]}" "$@" >out 2>&1 </dev/null || fail "$*"; }
mpi=()
while read -r setting; do mpi+=("$setting"); done < <(env | grep '^OMP' || true)
for program in slider_cli postproc; do
  clean $program --version
  [[ $(cat out) =~ (^| )$version$ ]] || fail "$program --version says '$(cat out)', not $version"
  page=$share/man/man1/$program.1
  [ -f "$page.gz" ] && gunzip "$page.gz"
  grep -q "^\.SH OPTIONS\|^\.SS \"Options" "$page" || grep -qi "options" "$page" || fail "manual page of $program"
  grep -q "$program \\\\- " "$page" || fail "manual page of $program has no name"
done
clean slider_cli --blocks 64 --steps 400000 --catalogue slider.csv
clean lmp -in "$share/lsm-fault/inputs/fault_120.in" -log none -var length 20 -var settle 100 -var steps 200 -var prefix fault
[ -s fault.catalogue.csv ] && [ -s fault.pe.bin ] || fail "the fault left no catalogue or series"
[ "$(grep -cv '^[#e]' slider.csv)" -gt 2 ] || fail "the slider made no events"
clean postproc export slider.csv -o table.csv
[ "$(wc -l <table.csv)" -gt 2 ] || fail "the table is empty"
clean postproc explore slider.csv -o page.html
grep -q 'Dygraph' page.html || fail "the page is without its library"

# the plugin, in a stock lmp
plugin=$(find root -name lsmplugin.so)
printf 'plugin load %s\ninclude %s\n' "$work/$plugin" "$share/lsm-fault/inputs/two_body_collision.in" >in.plugin
clean "$stock" -in in.plugin -log none
grep -q 'Loading plugin: .*lsm/free' out || fail "the plugin was not loaded"

# LAMMPS as a library, from Python
"$here/check-python.sh" "$work/root/usr/lib/python3/dist-packages" "$bin/lmp" "$share/lsm-fault/inputs" >out 2>&1 ||
  fail "the Python module"

# headers of the core
cat >program.cpp <<'END'
#include <lsm/lsm_event_picker.h>
#include <lsm/lsm_packing.h>
int main() {
  LSM::EventPicker picker({});
  LSM::Event event;
  int events = 0;
  for (int step = 0; step < 400; ++step) events += picker.push(step, step, step < 200 ? step : 400 - step, event);
  return picker.in_event() && events == 0 ? 0 : 1;
}
END
"$cxx" -std=c++17 -Iroot/usr/include -Iroot/usr/include/lsm -o program program.cpp >out 2>&1 || fail "a program with the headers of the core"
./program || fail "the picker of the installed headers"
echo "$(basename "${deb[0]}"): $(du -k "${deb[0]}" | cut -f1) kB, used from an empty root"
