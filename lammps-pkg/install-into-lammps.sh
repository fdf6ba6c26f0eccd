#!/bin/bash
# SPDX-License-Identifier: GPL-2.0-or-later
# Copies the package into a LAMMPS source tree as package LSM, its pages into doc/src, and the scenes into
# examples/PACKAGES/lsm, each in the form that LAMMPS asks of contributions: its notice in sources, version tags in
# pages, entries in all lists of packages and styles. Can be repeated: files and entries are replaced.
# LMP is a program with the package, to write the logs of examples on one and four ranks with.
# usage: install-into-lammps.sh LAMMPS_FOLDER [LMP]
set -euo pipefail
here=$(cd "$(dirname "$0")" && pwd)
if [ $# -lt 1 ] || [ $# -gt 2 ]; then
  echo "usage: $0 LAMMPS_FOLDER [LMP]   (the top folder of a LAMMPS source tree; a program to write logs of examples with)" >&2
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
[ -z "${2:-}" ] || [ -x "$2" ] || {
  echo "install-into-lammps: $2 is not a program; expected an lmp with the package" >&2
  exit 1
}
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
docs=$lammps/doc/src
forms=$here/doc/lammps
cannot() {
  echo "install-into-lammps: warning: $1: no entry made, as $2" >&2
}

# before FILE LINE: puts what is read before the first line that is LINE; what was put there earlier goes.
before() {
  local new
  new=$(cat)
  case $new in
    *----------) new+=$'\n' ;; # and the blank line after the rule
  esac
  [ -f "$1" ] && grep -qxF -e "$2" "$1" || {
    cannot "$1" "there is no line '$2'"
    return
  }
  NEW=$new AT=$2 awk '
    BEGIN { count = split(ENVIRON["NEW"], line, "\n") }
    { text[NR] = $0 }
    END {
      for (i = 1; i <= NR; i++) {
        for (j = 1; j <= count && text[i + j - 1] == line[j]; j++);
        if (j > count) { i += count - 1; continue }
        if (text[i] == ENVIRON["AT"] && !done++) print ENVIRON["NEW"]
        print text[i]
      }
    }' "$1" >"$1.lsm"
  mv "$1.lsm" "$1"
}

# sorted FILE INDENT PAGES NAME ENTRY: puts an entry after the last one of a list in the order of the alphabet whose name
# comes before, among those with this indentation and pages that begin with PAGES.
sorted() {
  [ -f "$1" ] || {
    cannot "$1" "there is no such file"
    return
  }
  INDENT=$2 PAGES=$3 NAME=$4 ENTRY=$2$5 LC_ALL=C awk '
    function name_of(row) {
      if (index(row, ENVIRON["INDENT"] "* :doc:`") != 1 || !index(row, "<" ENVIRON["PAGES"])) return ""
      sub(/^[^`]*`/, "", row)
      sub(/ .*/, "", row)
      return row
    }
    {
      name = name_of($0)
      if (name == ENVIRON["NAME"]) next
      text[++lines] = $0
      if (name != "" && name < ENVIRON["NAME"]) last = lines
    }
    END { for (i = 1; i <= lines; i++) { print text[i]; if (i == last) print ENVIRON["ENTRY"] } }' "$1" >"$1.lsm"
  mv "$1.lsm" "$1"
  grep -qxF -e "$2$5" "$1" || cannot "$1" "there is no list of entries '* :doc:\`NAME <$3'"
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
cp "$forms/README" "$lammps/src/LSM/"
echo "#define LSM_VERSION \"$own\"" >"$lammps/src/LSM/lsm_version.h"
for source in "$lammps"/src/LSM/{*.cpp,*.h,*/*.h}; do
  sed -i "1e cat '$forms/notice'" "$source"
done
rm -rf "$lammps/examples/PACKAGES/lsm"
mkdir -p "$docs" "$lammps/examples/PACKAGES/lsm"
for page in "$here"/doc/*.rst; do
  [ "${page##*/}" = index.rst ] ||
    sed -e '/^Description$/,/^$/s/^$/\n.. versionadded:: '"${version// /}"'\n/' "$page" >"$docs/${page##*/}"
done
cp "$here"/../inputs/*.variables "$lammps/examples/PACKAGES/lsm/"
for scene in "$here"/../inputs/*.in; do
  name=${scene##*/}
  sed -E 's/([[:alnum:]_*${}]+)\.in\b/in.\1/g' "$scene" >"$lammps/examples/PACKAGES/lsm/in.${name%.in}"
done
if [ $# = 2 ]; then
  . "$here/../inputs/mpi-settings.sh"
  lmp=$(realpath "$2")
  work=$(mktemp -d)
  trap 'rm -rf "$work"' EXIT
  while read -r name options; do
    for ranks in 1 4; do
      rm -rf "$work/lsm"
      cp -r "$lammps/examples/PACKAGES/lsm" "$work"
      # shellcheck disable=SC2086
      (cd "$work/lsm" && mpirun -np $ranks "$lmp" -in "in.$name" $options -log log -screen none </dev/null) || {
        echo "install-into-lammps: in.$name does not run on $ranks ranks with $2" >&2
        exit 1
      }
      of=$(sed -n '1s/LAMMPS (\([^-)]*\).*/\1/p' "$work/lsm/log")
      sed "s|$work/lsm/||g" "$work/lsm/log" >"$lammps/examples/PACKAGES/lsm/log.${of// /}.$name.g++.$ranks"
    done
  done <"$forms/logs"
  {
    echo "The logs are of runs with these options:"
    sed 's/^\([^ ]*\)/  -in in.\1/' "$forms/logs"
  } >"$lammps/examples/PACKAGES/lsm/README"
fi
if ! grep -q '^  LSM$' "$list"; then
  sed -i 's/^set(STANDARD_PACKAGES$/&\n  LSM/' "$list"
fi
grep -q '^  LSM$' "$list" || {
  echo "install-into-lammps: $list could not be changed" >&2
  exit 1
}
for preset in "$lammps"/cmake/presets/all_{on,off}.cmake; do
  before "$preset" "  MACHDYN" <<<"  LSM"
done
before "$list" "pkg_depends(SCAFACOS MPI)" <<<"pkg_depends(LSM MOLECULE)"
# The checksums of restart files are zlib's.
grep -q 'ZLIB::ZLIB)  *# LSM' "$list" || cat >>"$list" <<'EOF'
if(PKG_LSM)
  find_package(ZLIB REQUIRED)
  target_link_libraries(lammps PRIVATE ZLIB::ZLIB)  # LSM
endif()
EOF
if [ -f "$docs/Commands_all.rst" ]; then
  while read -r kind page name what; do
    case $kind in
      command)
        sorted "$docs/Commands_all.rst" "   " "" "$name" "* :doc:\`$name <$page>\`"
        before "$docs/commands_list.rst" "   $what" <<<"   $page"
        ;;
      *)
        sorted "$docs/Commands_$kind.rst" "   " "${kind}_" "$name" "* :doc:\`$name <$page>\`"
        styles=$docs/$kind.rst
        [ -f "$styles" ] || styles=$docs/${kind}_style.rst
        sorted "$styles" "" "${kind}_" "$name" "* :doc:\`$name <$page>\` - $what"
        ;;
    esac
  done <"$forms/lists"
  before "$docs/Howto.rst" "   Howto_spins" <<<"   Howto_lsm_ruptures"
  table=$docs/Packages_list.rst # later versions have it within another page
  [ -f "$table" ] || table=$docs/Packages.rst
  before "$table" '   * - :ref:`MACHDYN <PKG-MACHDYN>`' <"$forms/packages"
  before "$docs/Packages_details.rst" '   * :ref:`MACHDYN <PKG-MACHDYN>`' <<<'   * :ref:`LSM <PKG-LSM>`'
  before "$docs/Packages_details.rst" '.. _PKG-MACHDYN:' <"$forms/details"
  for page in Build_extras Build_package; do
    before "$docs/$page.rst" '   * :ref:`MACHDYN <machdyn>`' <<<'   * :ref:`LSM <lsm>`'
  done
  before "$docs/Build_extras.rst" '.. _machdyn:' <"$forms/extras"
fi
cat <<EOF
Package LSM is in $lammps/src/LSM, its pages in doc/src, its scenes in examples/PACKAGES/lsm. Build for example with
  cmake -S $lammps/cmake -B lammps-build -D CMAKE_BUILD_TYPE=Release -D CMAKE_CXX_FLAGS="-ffp-contract=off -fno-math-errno" \\
        -D PKG_LSM=on -D PKG_MOLECULE=on -D PKG_GRANULAR=on -D PKG_BPM=on
  cmake --build lammps-build --parallel
EOF
