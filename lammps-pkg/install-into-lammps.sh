#!/bin/bash
# SPDX-License-Identifier: GPL-2.0-or-later
# Copies the package into a LAMMPS source tree as package LSM, its pages into doc/src, and the scenes into
# examples/PACKAGES/lsm. Can be repeated: files are replaced.
# usage: install-into-lammps.sh LAMMPS_FOLDER
set -euo pipefail
here=$(cd "$(dirname "$0")" && pwd)
if [ $# -ne 1 ]; then
  echo "usage: $0 LAMMPS_FOLDER   (the top folder of a LAMMPS source tree)" >&2
  exit 2
fi
lammps=$1
list=$lammps/cmake/CMakeLists.txt
for f in "$lammps/src/version.h" "$list"; do
  [ -f "$f" ] || {
    echo "install-into-lammps: $f not found; expected the top folder of a LAMMPS source tree" >&2
    exit 1
  }
done
version=$(sed -n 's/.*LAMMPS_VERSION *"\(.*\)".*/\1/p' "$lammps/src/version.h")
case $version in
  "4 Feb 2025" | "4 Jul 2026") ;;
  *) echo "install-into-lammps: warning: LAMMPS $version, the package is written for 4 Feb 2025 and 4 Jul 2026" >&2 ;;
esac
grep -q '^set(STANDARD_PACKAGES' "$list" ||
  {
    echo "install-into-lammps: $list: no line 'set(STANDARD_PACKAGES'" >&2
    exit 1
  }

# A file of an older version of the package that is gone since must not stay behind.
rm -rf "$lammps/src/LSM"
mkdir "$lammps/src/LSM"
# LAMMPS compiles what lies in the folder of the package itself, and refuses names that its own sources have; headers are
# found in folders below. The plugin's entry point has no place in a package that is compiled in.
cp "$here"/LSM/*.h "$here"/LSM/*.cpp "$here"/LSM/support/* "$here"/LSM/speed/*.{h,cpp} "$here"/LSM/scene/* "$lammps/src/LSM/"
for room in "$here"/core/*/; do
  name=$(basename "$room")
  mkdir "$lammps/src/LSM/$name"
  cp "$room"*.h "$lammps/src/LSM/$name"
done
for source in "$here"/core/*/*.cpp; do
  cp "$source" "$lammps/src/LSM/lsm_core_${source##*/}"
done
own=$(sed -n 's/^  VERSION \([0-9.]*\)$/\1/p' "$here/../CMakeLists.txt")
[ -n "$own" ] || {
  echo "install-into-lammps: no version in $here/../CMakeLists.txt" >&2
  exit 1
}
echo "#define LSM_VERSION \"$own\"" >"$lammps/src/LSM/lsm_version.h"
mkdir -p "$lammps/doc/src" "$lammps/examples/PACKAGES/lsm"
for page in "$here"/doc/*.rst; do
  [ "${page##*/}" = index.rst ] || cp "$page" "$lammps/doc/src/"
done
cp "$here"/../inputs/*.in "$here"/../inputs/*.variables "$lammps/examples/PACKAGES/lsm/"
if ! grep -q '^  LSM$' "$list"; then
  sed -i 's/^set(STANDARD_PACKAGES$/&\n  LSM/' "$list"
fi
grep -q '^  LSM$' "$list" || {
  echo "install-into-lammps: $list could not be changed" >&2
  exit 1
}
# The checksums of restart files are zlib's.
grep -q 'ZLIB::ZLIB)  *# LSM' "$list" || cat >>"$list" <<'EOF'
if(PKG_LSM)
  find_package(ZLIB REQUIRED)
  target_link_libraries(lammps PRIVATE ZLIB::ZLIB)  # LSM
endif()
EOF
cat <<EOF
Package LSM is in $lammps/src/LSM, its pages in doc/src, its scenes in examples/PACKAGES/lsm. Build for example with
  cmake -S $lammps/cmake -B lammps-build -D CMAKE_BUILD_TYPE=Release -D CMAKE_CXX_FLAGS="-ffp-contract=off -fno-math-errno" \\
        -D PKG_LSM=on -D PKG_MOLECULE=on -D PKG_GRANULAR=on -D PKG_BPM=on
  cmake --build lammps-build --parallel
EOF
