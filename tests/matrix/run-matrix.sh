#!/bin/bash
# SPDX-License-Identifier: GPL-2.0-or-later
# Builds and runs the package with other versions of LAMMPS, compilers and integers, and in each way it can be used, and
# compares a short fault with the reference, byte by byte. README.md in this folder tells what each column does.
#
# usage: tests/matrix/run-matrix.sh [--folder FOLDER] [--jobs N] all|COLUMN...
#   --folder FOLDER   where everything is built (default build-matrix; some GB)
#   --jobs N          processes for compiling (default: number of cores)
#   COLUMN...         reference clang bigbig jul2026 plugin installed testers testers-jul2026 aarch64 debian-12 debian-12-tests
#                     debian-13 debian-13-tests sanitize sanitize-thread mutations, or all, in this order; those with a fault,
#                     except in a Debian of its own, need the reference done before; debian-* need root
# LSM_LAMMPS_CACHE is used as by the build; default FOLDER/cache. LSM_MATRIX_FLAGS are the flags for LAMMPS' own sources in
# all columns but the reference (default -O1). LSM_MATRIX_CTEST are arguments for ctest in debian-*-tests, such as -L unit.
# Each row is written into FOLDER and into README.md under "Last run".
set -euo pipefail
root=$(cd "$(dirname "$0")/../.." && pwd)
folder=$root/build-matrix
jobs=$(nproc)
all="reference clang bigbig jul2026 plugin installed testers testers-jul2026 aarch64 debian-12 debian-12-tests debian-13 debian-13-tests sanitize sanitize-thread mutations"
columns=()
fail() {
  echo "run-matrix: $*" >&2
  exit 1
}
while [ $# -gt 0 ]; do
  case $1 in
    --folder)
      [ $# -ge 2 ] || fail "--folder needs a folder"
      mkdir -p "$2"
      folder=$(cd "$2" && pwd)
      shift 2
      ;;
    --jobs)
      [[ ${2:-} =~ ^[1-9][0-9]*$ ]] || fail "--jobs needs a number of at least 1"
      jobs=$2
      shift 2
      ;;
    -h | --help)
      sed -n '3,15s/^# \{0,1\}//p' "$0"
      exit
      ;;
    all)
      read -ra columns <<<"$all"
      shift
      ;;
    *)
      [[ " $all " == *" $1 "* ]] || fail "unknown column '$1', expected one of: $all"
      columns+=("$1")
      shift
      ;;
  esac
done
[ ${#columns[@]} -gt 0 ] || fail "expected all, or one or more of: $all"
mkdir -p "$folder"
export LSM_LAMMPS_CACHE=${LSM_LAMMPS_CACHE:-$folder/cache}
export CMAKE_BUILD_PARALLEL_LEVEL=$jobs
. "$root/inputs/mpi-settings.sh"
flags="-DCMAKE_CXX_FLAGS_RELEASE=${LSM_MATRIX_FLAGS:--O1} -DNDEBUG"
precompile=-DCMAKE_PROJECT_INCLUDE=$root/lammps-pkg/cmake/PrecompileLammps.cmake

. "$root/lammps-pkg/cmake/debian-packages.sh"
[[ ${columns[*]/#debian-*/} != *[a-z]* ]] ||
  install_debian_packages $lammps_packages clang libgtest-dev libgmock-dev libyaml-dev

# The fault of every column: short, fast plates, with events, energies and the places of events.
scene=(-var length 30 -var width 16 -var seed 3 -var settle 2000 -var steps 6000 -var checkpoint 3000 -var velocity 0.01
  -var thermo 3000 -var location yes -var ledger yes)

# run_fault COLUMN LMP [PLUGIN]: on 1 and 2 ranks, in FOLDER/COLUMN/fault
run_fault() {
  local name=$1 lmp=$2 plugin=${3:-} at=$folder/$1/fault ranks
  rm -rf "$at"
  mkdir -p "$at"
  {
    [ -z "$plugin" ] || echo "plugin load $plugin"
    echo "include $root/inputs/fault_120.in"
  } >"$at/in.fault"
  for ranks in 1 2; do
    (cd "$at" && mpirun -np $ranks "$lmp" -in in.fault -log none "${scene[@]}" -var prefix on_$ranks >out_$ranks.txt 2>&1) ||
      {
        tail -n 5 "$at/out_$ranks.txt"
        return 1
      }
  done
}

# compare_fault COLUMN [OTHER]: what a fault has in common with that of another column, the reference, in words
compare_fault() {
  local ours=$folder/$1/fault theirs=$folder/${2:-reference}/fault ranks file words=""
  for ranks in 1 2; do
    local events difference="same bytes"
    events=$(grep -vc '^[#e]' "$ours/on_$ranks.catalogue.csv" || true)
    [ "$events" -ge 5 ] || {
      echo "FAILED: $events events on $ranks ranks say nothing"
      return 1
    }
    # the headers name the version of LAMMPS
    for file in pe.bin catalogue.csv; do
      cmp -s <(LC_ALL=C sed 's/LAMMPS 4 Jul 2026/LAMMPS 4 Feb 2025/' "$ours/on_$ranks.$file") "$theirs/on_$ranks.$file" ||
        difference="$file differs"
    done
    words="$words${words:+; }$ranks rank$([ $ranks = 1 ] || echo s): $events events, $difference"
  done
  echo "$words"
  [[ $words != *differs* ]]
}

# configure COLUMN OPTIONS...: the project
configure() {
  local log=$folder/$1.configure.log at
  at=$(realpath -m "$folder/$1")
  shift
  cmake -S "$root" -B "$at" -G Ninja -DLSM_BUILD_SLIDER=OFF -DLSM_BUILD_POSTPROC=OFF "$@" >"$log" 2>&1 ||
    {
      tail -n 20 "$log"
      return 1
    }
}

# build COLUMN TARGETS...: appends to the log, so that no warning is lost if only a part is built again
build() {
  local log=$folder/$1.build.log at=$folder/$1
  shift
  cmake --build "$at" --parallel "$jobs" --target "$@" >>"$log" 2>&1 || {
    tail -n 30 "$log"
    return 1
  }
  ! grep "^$root/\(lammps-pkg\|slider\|postproc\|tests\)/.*warning:" "$log"
}

# counted LOG: the summary of ctest, in words
counted() { sed -n 's/^\([0-9]*%\) tests passed, \([0-9]*\) tests failed out of \([0-9]*\)/\3 run, \2 failed/p' "$1"; }

# run_tests COLUMN PATTERN LOG [EXCEPT]: how many passed, in words
run_tests() {
  local rc=0 log=$folder/$3.tests.log
  ctest --test-dir "$folder/$1" -R "$2" ${4:+-E "$4"} --no-tests=error --output-on-failure --repeat after-timeout:3 >"$log" 2>&1 || rc=$?
  counted "$log"
  return $rc
}

# Installs the libraries of 64-bit ARM in their own folder, with an apt that is independent of this system: some could not
# be installed next to those of the system. Absolute links would lead out of the folder.
arm_libraries() {
  local at=$1 apt=$1.apt options package link
  [ ! -d "$at" ] || return 0
  mkdir -p "$apt/state/lists/partial" "$apt/cache/archives/partial"
  : >"$apt/status"
  options=(-q -q -y -o APT::Architecture=arm64 -o APT::Architectures=arm64 -o APT::Install-Recommends=0 -o Debug::NoLocking=1
    -o "Dir::State=$apt/state" -o "Dir::State::status=$apt/status" -o "Dir::Cache=$apt/cache")
  apt-get "${options[@]}" update
  apt-get "${options[@]}" --download-only install zlib1g-dev libgsl-dev libfftw3-dev libfmt-dev liblzma-dev libpugixml-dev \
    libgtest-dev libgmock-dev libcli11-dev nlohmann-json3-dev libhowardhinnant-date-dev libjs-dygraphs
  rm -rf "$at.part"
  for package in "$apt"/cache/archives/*.deb; do dpkg-deb -x "$package" "$at.part"; done
  find "$at.part" -type l -lname '/*' | while read -r link; do
    ln -sfn "$(realpath -m --relative-to "$(dirname "$link")" "$at.part$(readlink "$link")")" "$link"
  done
  mv "$at.part" "$at"
}

# compare_sliders OURS THEIRS: compares the output files of short runs of two programs byte by byte, in words. They include
# positions of ruptures, which depend on sines and logarithms of the C library.
compare_sliders() {
  local at=$folder/aarch64/sliders name program file words="" same=0 differ=0
  local -A runs=([verlet]="--time 9000" [printed]="--scheme printed --dt 0.01 --time 7000"
    [implicit]="--scheme semi-implicit --time 9000" [coulomb]="--law coulomb --time 6000"
    [weakening]="--law slip-weakening --time 9000"
    [ruptures]="--events ruptures --columns centroid,length --time 6000"
    [leaps]="--velocity 1e-4 --leap 1e-3 --time 1e6" [long]="--blocks 20000 --time 80 --velocity 1")
  rm -rf "$at"
  mkdir -p "$at/ours" "$at/theirs"
  for name in "${!runs[@]}"; do
    # shellcheck disable=SC2086
    for program in "$1 $at/ours" "$2 $at/theirs"; do
      (cd "${program#* }" && "${program% *}" --blocks 100 --velocity 0.02 --warmup 0 --pe-stride 20 \
        ${runs[$name]} --catalogue "$name.csv" --pe-series "$name.pe" --checkpoint "$name.chk" >"$name.out") || return 1
    done
    for file in "$name".csv "$name".pe "$name".chk; do
      if cmp -s "$at/ours/$file" "$at/theirs/$file"; then same=$((same + 1)); else differ=$((differ + 1)) words="$words $file"; fi
    done
  done
  echo "$same files of ${#runs[@]} runs with the same bytes${words:+, other bytes:$words}"
  [ $differ = 0 ]
}

# compare_postprocs OURS THEIRS: compares the output for the same catalogues and a PE series of the slider byte by byte, in
# words; if bytes differ, by how much the numbers do. GSL and the C library are different builds.
compare_postprocs() {
  local at=$folder/aarch64/postprocs name file words="" same=0 differ=0
  local results=$root/results/catalogues
  local one=$results/fault_120.catalogue.csv.xz chain=$results/slider_ours_256_seed_1.catalogue.csv.xz
  local series=$folder/aarch64/sliders/theirs/verlet.pe
  local -A runs=([histograms]="$one $chain --no-picture -o o" [intervals]="$one $chain --replicas 2 --no-picture -o o"
    [likelihood]="$chain --method likelihood --replicas 2 --no-picture -o o"
    [fit]="$one --range 1e-4:0.1 --replicas 2 --no-picture -o o" [magnitudes]="$one --magnitude-bin 0.1 --no-picture -o o"
    [aftershocks]="$chain --replicas 2 --no-picture -o o" [count]="$one" [compare]="$one $chain --rescale --replicas 10 -o o"
    [spectrum]="$series --no-picture -o o" [series]="$series --no-picture -o o"
    [pick]="$series -o o.csv" [select]="$one --min-size 1e-3 -o o.csv" [export]="$chain --time-unit second --start-date 2000-01-01 --magnitude-constant 0 -o o.csv")
  rm -rf "$at"
  for name in "${!runs[@]}"; do
    for program in "$1 $at/ours" "$2 $at/theirs"; do
      mkdir -p "${program#* }/$name"
      # shellcheck disable=SC2086
      (cd "${program#* }/$name" && "${program% *}" ${name/likelihood/intervals} ${runs[$name]} >out 2>"$at/err") ||
        {
          echo "$name: $(cat "$at/err")"
          return 1
        }
    done
    for file in "$at/theirs/$name"/*; do
      file=$name/${file##*/}
      if cmp -s "$at/ours/$file" "$at/theirs/$file"; then
        same=$((same + 1))
        continue
      fi
      differ=$((differ + 1))
      words="$words $file ($(largest_difference "$at/ours/$file" "$at/theirs/$file"))"
    done
  done
  echo "$same files of ${#runs[@]} commands with the same bytes${words:+, $differ others by:$words}"
}

# largest_difference A B: largest relative difference of the numbers in two texts; "text" if anything else differs
largest_difference() {
  python3 - "$@" <<'END'
import re, sys
number = r"[-+]?(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?"
a, b = (open(path).read() for path in sys.argv[1:])
pairs = list(zip(map(float, re.findall(number, a)), map(float, re.findall(number, b))))
same_text = re.sub(number, "0", a).split() == re.sub(number, "0", b).split()
print("%.1e" % max(abs(x - y) / max(abs(x), abs(y), 1e-300) for x, y in pairs) if same_text else "text")
END
}

# run_pytest FILE EXPRESSION: tests of the programs given in the environment, in words
run_pytest() {
  local log=$folder/aarch64.pytest.log rc=0
  /usr/bin/python3 -m pytest -q "$root/tests/$1" -k "$2" >>"$log" 2>&1 || rc=$?
  echo "${1##*/}: $(tail -n 1 "$log" | sed 's/ in .*//')"
  return $rc
}

compiler_of() { "$1" --version | sed -n 1p; }

# row COLUMN LAMMPS COMPILER INTEGERS BUILD TESTS FAULT
row() { printf '| %s | %s | %s | %s | %s | %s | %s | %s |\n' "$1" "$2" "$3" "$4" "$5" "$6" "$7" "$(date +%F)" >"$folder/$1.row"; }

# The source of a version, with LAMMPS' testers: FOLDER/unittest-NAME
testers_of() {
  local tarball=$1 at=$2
  [ -d "$at/force-styles" ] && return
  rm -rf "$at.part"
  mkdir -p "$at.part"
  tar -xf "$tarball" -C "$at.part" --wildcards '*unittest/*'
  mv "$(find "$at.part" -maxdepth 2 -type d -name unittest)" "$at"
  rm -rf "$at.part"
}

# bare_debian COLUMN: a Debian in which nothing is installed, FOLDER/COLUMN-root, from the mirror of this machine
bare_debian() {
  local at=$folder/$1-root mirror suite=bookworm
  [ "$1" = debian-12 ] || suite=trixie
  install_debian_packages debootstrap
  mirror=$(apt-get indextargets --format '$(REPO_URI)' 'Created-By: Packages' 'Label: Debian' | sed -n 1p)
  rm -rf --one-file-system "$at"
  debootstrap --variant=minbase "$suite" "$at" ${mirror:+"$mirror"} >"$folder/$1.debootstrap.log"
  cp /etc/resolv.conf /etc/hosts "$at/etc/"
}

# in_debian COLUMN BUILD COMMAND: in the Debian of a column, with the sources in /lsm and the build folder /build/BUILD
in_debian() {
  unshare --mount --pid --fork --kill-child bash -euc '
    at=$1 root=$2
    mkdir -p "$at/lsm" "$at/build"
    mount -t proc proc "$at/proc"
    mount --rbind /dev "$at/dev"
    mount --bind "$root" "$at/lsm"
    exec chroot "$at" env -i PATH=/usr/sbin:/usr/bin:/sbin:/bin HOME=/root LSM_BUILD_DIR="/build/$3" bash -c "cd /lsm; $4"
  ' in_debian "$folder/$1-root" "$root" "$2" "$3"
}

# timed COMMAND...: runs it and writes the time that it took into FOLDER/took
timed() {
  local TIMEFORMAT='%0R s, %0U + %0S s of CPU'
  { time "$@" 2>&1; } 2>"$folder/took"
}

# command_in_debian COLUMN DEBIAN BUILD COMMAND: runs it, and the short fault with the programs it has built; sets warned
command_in_debian() {
  local name=$1 log=$folder/$1.log ranks rc=0
  timed in_debian "$2" "$3" "$4" >"$log" || {
    tail -n 20 "$log"
    rc=1
  }
  echo "$4: $(cat "$folder/took")"
  warned="no warning"
  ! grep -E 'warning: |CMake [A-Za-z() ]*Warning' "$log" || rc=1 warned="**warnings**"
  rm -rf "${folder:?}/$name"
  mkdir -p "$folder/$name"
  for ranks in 1 2; do
    in_debian "$2" "$3" ". inputs/mpi-settings.sh; mkdir -p /build/$3/fault; cd /build/$3/fault; mpirun -np $ranks ../bin/lmp \
      -in /lsm/inputs/fault_120.in -log none ${scene[*]} -var overwrite yes -var prefix on_$ranks" >"$folder/$name/out_$ranks.txt" 2>&1 || {
      tail -n 5 "$folder/$name/out_$ranks.txt"
      return 1
    }
  done
  cp -r "$folder/$2-root/build/$3/fault" "$folder/$name/"
  return $rc
}

# whole COLUMN LAMMPS INTEGERS COMPILER OPTIONS...: project, tests and fault
whole() {
  local name=$1 lammps=$2 integers=$3 compiler=$4 tests fault ok=0
  shift 4
  configure "$name" "$@"
  case $name in
    reference | clang)
      build "$name" all
      tests=$(run_tests "$name" '^(unit|physics|package)\.' "$name") || ok=1
      tests="unit, physics, package: $tests"
      ;;
    *)
      # Unit tests do not depend on LAMMPS; those of physics start the program of this column.
      build "$name" lmp lsmplugin lsmplugin_other_integers lammps_shared lsm_library_errors lsm_foreign_fix
      tests=$(run_tests "$name" '^(package\.|physics\.library)' "$name") || ok=1
      tests="package, library: $tests; physics: $(LSM_LMP=$folder/$name/bin/lmp \
        LSM_FOREIGN_FIX=$folder/$name/lib/lsm_foreign_fix.so run_tests reference '^physics\.[A-Z]' "$name.physics")" || ok=1
      ;;
  esac
  run_fault "$name" "$folder/$name/bin/lmp"
  fault=$(compare_fault "$name") || ok=1
  row "$name" "$lammps" "$compiler" "$integers" "no warning" "$tests" "$fault"
  return $ok
}

do_column() {
  local name=$1 gxx clang tests fault ok=0
  gxx=$(compiler_of g++)
  clang=$(compiler_of clang++)
  case $name in
    reference) whole reference "4 Feb 2025" smallbig "$gxx" ;;
    clang) whole clang "4 Feb 2025" smallbig "$clang" -DCMAKE_CXX_COMPILER=clang++ "-DLSM_LAMMPS_OPTIONS=$flags" ;;
    bigbig) whole bigbig "4 Feb 2025" bigbig "$gxx" -DLSM_LAMMPS_SIZES=bigbig "-DLSM_LAMMPS_OPTIONS=$flags" ;;
    jul2026) whole jul2026 "4 Jul 2026" smallbig "$gxx" "-DLSM_LAMMPS_VERSION=4 Jul 2026" "-DLSM_LAMMPS_OPTIONS=$flags" ;;
    plugin)
      local stock
      stock=$(sed -n 's/^LSM_STOCK_LMP:INTERNAL=//p' "$folder/reference/CMakeCache.txt")
      ! grep -q 'lsm/' <<<"$("$stock" -h)" || {
        echo "the stock lmp has the styles already"
        return 1
      }
      run_fault plugin "$stock" "$folder/reference/lib/lsmplugin.so"
      fault=$(compare_fault plugin) || ok=1
      row plugin "4 Feb 2025, stock lmp" "$gxx" smallbig "that of the reference" "those of the reference (package.plugin)" "$fault"
      return $ok
      ;;
    installed)
      # The package is installed into a copy of the source; LAMMPS' own CMake builds the program, with warnings shown.
      local tree=$folder/installed-lammps at=$folder/installed
      if [ ! -d "$tree" ]; then
        # Links are copied as they are, as one of them, in an example, is dangling.
        rm -rf "$tree.part" && mkdir "$tree.part" && cp -a "$LSM_LAMMPS_CACHE/lammps-4Feb2025/." "$tree.part"
        mv "$tree.part" "$tree"
      fi
      "$root/lammps-pkg/install-into-lammps.sh" "$tree" >"$folder/installed.configure.log"
      cmake -S "$tree/cmake" -B "$at" -G Ninja "$precompile" -DCMAKE_BUILD_TYPE=Release "$flags" \
        "-DCMAKE_CXX_FLAGS=-ffp-contract=off -fno-math-errno -Wall -Wextra" -DPKG_LSM=on -DPKG_MOLECULE=on -DPKG_GRANULAR=on \
        -DPKG_BPM=on -DBUILD_OMP=off -DWITH_JPEG=off -DWITH_FFMPEG=off -DDOWNLOAD_POTENTIALS=off \
        >>"$folder/installed.configure.log" 2>&1
      cmake --build "$at" --parallel "$jobs" >>"$at.build.log" 2>&1 || {
        tail -n 30 "$at.build.log"
        return 1
      }
      ! grep "src/LSM/.*warning:" "$at.build.log" || return 1
      grep -q '\bLSM\b' <<<"$("$at/lmp" -h)" || {
        echo "lmp -h does not name the package"
        return 1
      }
      run_fault installed "$at/lmp"
      fault=$(compare_fault installed) || ok=1
      row installed "4 Feb 2025, package copied into its tree" "$gxx" smallbig "full link, no warning" "none: LAMMPS' own build" "$fault"
      return $ok
      ;;
    aarch64)
      # without LAMMPS
      install_debian_packages g++-aarch64-linux-gnu qemu-user libfmt-dev libcli11-dev nlohmann-json3-dev libgsl-dev libfftw3-dev \
        liblzma-dev libpugixml-dev libhowardhinnant-date-dev libjs-dygraphs
      local on=(-DLSM_BUILD_LAMMPS=OFF -DLSM_BUILD_SLIDER=ON -DLSM_BUILD_POSTPROC=ON) program
      export LSM_ARM_SYSROOT=$folder/aarch64-libraries
      arm_libraries "$LSM_ARM_SYSROOT"
      configure aarch64-native "${on[@]}" -DLSM_BUILD_TESTS=OFF
      build aarch64-native slider_cli postproc
      configure aarch64 "-DCMAKE_TOOLCHAIN_FILE=$root/tests/matrix/aarch64.cmake" "${on[@]}"
      build aarch64 slider_cli postproc lsm_unit_tests lsm_slider_tests lsm_postproc_tests
      local qemu=$folder/aarch64/by-qemu
      mkdir -p "$qemu"
      for program in slider_cli postproc; do
        printf '#!/bin/sh\nexec qemu-aarch64 -L "%s" "%s" "$@"\n' "$LSM_ARM_SYSROOT" "$folder/aarch64/bin/$program" \
          >"$qemu/$program"
        chmod +x "$qemu/$program"
      done
      # Only the faster tests: others take many minutes.
      tests=$(run_tests aarch64 '^(unit|postproc\.[A-Z]|SliderParameters|SliderKernels\.(OtherLaws|ActiveSet|InstructionSets))' aarch64 \
        'Omori.ErrorsCoverTheTruth') || ok=1
      tests="$tests; $(LSM_SLIDER_CLI=$qemu/slider_cli run_pytest slider/test_slider_cli.py "header or paper or config or bad")" || ok=1
      tests="$tests; $(LSM_POSTPROC=$qemu/postproc LSM_SLIDER_CLI=$qemu/slider_cli run_pytest postproc/test_postproc_cli.py \
        "not pictures and not faults and not progress")" || ok=1
      fault=$(compare_sliders "$qemu/slider_cli" "$folder/aarch64-native/bin/slider_cli") || ok=1
      fault="$fault; postproc: $(compare_postprocs "$qemu/postproc" "$folder/aarch64-native/bin/postproc")" || ok=1
      row aarch64 "none" "$(compiler_of aarch64-linux-gnu-g++), run by $(qemu-aarch64 --version | sed -n 1p)" "-" "no warning" \
        "unit, slider, postproc: $tests" "slider on ARM beside x86-64: $fault"
      return $ok
      ;;
    debian-12 | debian-13)
      bare_debian "$name"
      command_in_debian "$name" "$name" first inputs/first-catalogue.sh || ok=1
      fault="the reference was not built"
      [ ! -d "$folder/reference/fault" ] || fault=$(compare_fault "$name") || ok=1
      row "$name" "4 Feb 2025$([ $name = debian-12 ] || echo " of the distribution")" "$(in_debian "$name" first 'g++ --version' | sed -n 1p)" \
        smallbig "$warned" "\`inputs/first-catalogue.sh\` where nothing is installed: $(cat "$folder/took")" "$fault"
      return $ok
      ;;
    debian-*-tests)
      # with our own build of LAMMPS, and in debian-13 also the distribution's
      local first=${name%-tests}
      [ -d "$folder/$first/fault" ] || fail "$name is compared with $first, which is not done yet"
      command_in_debian "$name" "$first" all "tests/run-all.sh ${LSM_MATRIX_CTEST:-}" || ok=1
      fault="beside $first: $(compare_fault "$name" "$first")" || ok=1
      row "$name" "4 Feb 2025" "$(in_debian "$first" all 'g++ --version' | sed -n 1p)" smallbig "$warned" \
        "\`tests/run-all.sh${LSM_MATRIX_CTEST:+ $LSM_MATRIX_CTEST}\`: $(counted "$folder/$name.log"), $(cat "$folder/took")" "$fault"
      return $ok
      ;;
    sanitize | sanitize-thread)
      # Folders and environment are those of CMakePresets.json.
      local log=$folder/$name.log
      (cd "$root" && cmake --preset "$name" && cmake --build --preset "$name" --parallel "$jobs") >"$log" 2>&1 || {
        tail -n 30 "$log"
        return 1
      }
      (cd "$root" && ctest --preset "$name" --repeat after-timeout:3) >"$folder/$name.tests.log" 2>&1 || ok=1
      row "$name" "4 Feb 2025" "$gxx" smallbig "with its checks" "$(counted "$folder/$name.tests.log")" "-"
      return $ok
      ;;
    mutations)
      LSM_MUTATIONS_DIR=$folder/mutations LSM_MUTATIONS_JOBS=$jobs "$root/tests/mutations/run.sh" >"$folder/mutations.log" 2>&1 || ok=1
      row mutations "4 Feb 2025" "$gxx" smallbig "one for each mutation" "$(tail -n 1 "$folder/mutations.log")" "-"
      return $ok
      ;;
    testers | testers-jul2026)
      local base=reference version="4 Feb 2025" tarball=lammps-4Feb2025.tar.xz
      [ $name = testers ] || { base=jul2026 version="4 Jul 2026" tarball=lammps-4Jul2026.tar.gz; }
      [ -f "$LSM_LAMMPS_CACHE/$tarball" ] || {
        echo "no $tarball in $LSM_LAMMPS_CACHE: it holds the testers"
        return 1
      }
      testers_of "$LSM_LAMMPS_CACHE/$tarball" "$folder/unittest-$base"
      configure "$base" "-DLSM_LAMMPS_UNITTEST=$(realpath "$folder/unittest-$base")"
      build "$base" test_bond_style test_pair_style test_fix_timestep
      tests=$(run_tests "$base" '^force-styles\.' "$name") || ok=1
      row "$name" "$version, its own testers of styles" "$gxx" smallbig "no warning" "$tests" "-"
      return $ok
      ;;
  esac
}

bad=()
for name in "${columns[@]}"; do
  [[ $name == debian-* || " reference aarch64 sanitize sanitize-thread mutations " == *" $name "* ]] || [ -f "$folder/reference.row" ] || fail "$name is compared with the reference, which is not done yet"
  echo "== $name ($(date '+%F %T'))"
  rm -f "$folder/$name.row"
  set +e
  (
    set -e
    do_column "$name"
  )
  rc=$?
  set -e
  if [ $rc -ne 0 ]; then
    bad+=("$name")
    [ -f "$folder/$name.row" ] || row "$name" "" "" "" "**failed**" "" ""
  fi
done
{
  echo "| column | LAMMPS | compiler | integers | build | tests | fault beside the reference | date |"
  echo "|---|---|---|---|---|---|---|---|"
  for name in $all; do
    [ ! -f "$folder/$name.row" ] || cat "$folder/$name.row"
  done
} >"$folder/table.md"
cat "$folder/table.md"
# The rows replace those of the same columns under "Last run"; what precedes it is kept.
page=$root/tests/matrix/README.md
for name in "${columns[@]}"; do
  ROW=$(cat "$folder/$name.row") awk -v name="$name" '
    /^## Last run/ { here = 1 }
    here && index($0, "| " name " |") == 1 { print ENVIRON["ROW"]; done = 1; next }
    { print }
    END { if (!done) print ENVIRON["ROW"] }' "$page" >"$folder/page.md"
  cp "$folder/page.md" "$page"
done
[ ${#bad[@]} -eq 0 ] || fail "failed: ${bad[*]}"
