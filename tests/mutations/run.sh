#!/bin/bash
# SPDX-License-Identifier: GPL-2.0-or-later
# Breaks the code on purpose, one place at a time, and checks whether the tests notice.
# usage: tests/mutations/run.sh [-n] [REGEX]     (mutations whose name matches; all without)
#   -n  only says whether each mutation still applies to the sources
# Mutations are in list.txt. They are made in a copy of the tree under build-mutations/, never here.
# Result: one line each, and build-mutations/table.md; fails if one survived that is not expected to.
set -uof pipefail # filters of GoogleTest are not file names
root=$(cd "$(dirname "$0")/../.." && pwd)
work=${LSM_MUTATIONS_DIR:-$root/build-mutations}
list=$root/tests/mutations/list.txt
only_apply=
[ "${1:-}" = -n ] && {
  only_apply=yes
  shift
}
pattern=${1:-.}

. "$root/inputs/mpi-settings.sh"

# One mutation: name, file, from, to, test (program and filter), expect (caught, or why it may survive).
names=() files=() from=() to=() tests=() expects=()
while IFS= read -r line; do
  case $line in
    '['*']') names+=("${line:1:-1}") files+=('') from+=('') to+=('') tests+=('') expects+=('caught') ;;
    'file: '*) files[-1]=${line#file: } ;;
    'from: '*) from[-1]=${line#from: } ;;
    'to:') to[-1]='' ;;
    'to: '*) to[-1]=${line#to: } ;;
    'test: '*) tests[-1]=${line#test: } ;;
    'survives: '*) expects[-1]=${line#survives: } ;;
    '' | '#'*) ;;
    *)
      echo "$list: '$line', expected [name], file:, from:, to:, test:, survives: or #" >&2
      exit 2
      ;;
  esac
done <"$list"

# Files that have been moved to another folder are found by name.
for i in "${!files[@]}"; do
  [ -e "$root/${files[$i]}" ] && continue
  found=$(cd "$root" && find lammps-pkg slider postproc -name "${files[$i]##*/}")
  [ -n "$found" ] && [ "$(echo "$found" | wc -l)" = 1 ] && files[$i]=$found
done

# apply I FOLDER: the mutated text of mutation I on standard output
apply() {
  perl -0777 -e '
    my ($name, $folder, $file, $from, $to) = @ARGV;
    s/\\n/\n/g for $from, $to;
    open(my $in, "<", "$folder/$file") or die "$name: there is no file $file\n";
    my $text = <$in>;
    my $at = index($text, $from);
    die "$name: \x27$from\x27 is not in $file\n" if $at < 0;
    die "$name: \x27$from\x27 is in $file more than once\n" if index($text, $from, $at + 1) >= 0;
    substr($text, $at, length $from) = $to;
    print $text;' "${names[$1]}" "$2" "${files[$1]}" "${from[$1]}" "${to[$1]}"
}

chosen=() outdated=0
for i in "${!names[@]}"; do
  [[ ${names[$i]} =~ $pattern ]] || continue
  if apply "$i" "$root" >/dev/null; then
    chosen+=("$i")
  else
    outdated=$((outdated + 1))
  fi
done
[ ${#chosen[@]} -gt 0 ] || {
  echo "no mutation matches '$pattern'" >&2
  exit 2
}
if [ -n "$only_apply" ]; then
  echo "${#chosen[@]} mutations apply, $outdated do not: the list is to follow the code"
  [ $outdated = 0 ]
  exit
fi

# The copy keeps its times, so that a second run compiles only what changed.
tree=$work/tree
build=$work/build
mkdir -p "$tree" "$build"
(cd "$root" && git ls-files -z --cached --others --exclude-standard) |
  while IFS= read -r -d '' file; do
    [ -e "$root/$file" ] || continue
    cmp -s "$root/$file" "$tree/$file" || { mkdir -p "$tree/$(dirname "$file")" && cp -p "$root/$file" "$tree/$file" && touch "$tree/$file"; }
  done
(cd "$tree" && find . -type f -printf '%P\0') |
  while IFS= read -r -d '' file; do
    [ -e "$root/$file" ] || rm "$tree/$file" # it has left the sources
  done
lammps=OFF
for i in "${chosen[@]}"; do
  [[ ${tests[$i]} = lsm_physics_tests* || ${tests[$i]} = lsm_benchmark_tests* || ${tests[$i]} = lsm_keywords* ]] && lammps=ON
done
grep -q '^LSM_BUILD_LAMMPS:BOOL=ON' "$build/CMakeCache.txt" 2>/dev/null && lammps=ON
cmake -S "$tree" -B "$build" -G Ninja -DLSM_BUILD_LAMMPS=$lammps \
  -DCMAKE_CXX_FLAGS_RELEASE=-O0 >"$work/configure.log" 2>&1 || {
  cat "$work/configure.log" >&2
  exit 2
}

# run PROGRAM FILTER: 0 if the tests pass, 1 if not (names of failed ones are in $work/failed), 2 if
# they do not compile. Each file of unit tests is a separate program.
run() {
  local program=$build/bin/$1
  if [[ $1 = *.cpp ]]; then
    program=$work/unit_test
    ninja -C "$build" -j "${LSM_MUTATIONS_JOBS:-2}" lsm_core >"$work/build.log" 2>&1 || return 2
    "${CXX:-c++}" -std=c++17 -O0 -I "$tree/lammps-pkg/core" -I "$tree/tests/accuracy" -o "$program" \
      "$tree/tests/unit/$1" "$build/lib/liblsm_core.a" -lgtest -lgtest_main -lz -pthread >"$work/build.log" 2>&1 || return 2
  else
    ninja -C "$build" -j "${LSM_MUTATIONS_JOBS:-2}" "$1" >"$work/build.log" 2>&1 || return 2
  fi
  timeout "${LSM_MUTATIONS_TIMEOUT:-600}" "$program" --gtest_filter="$2" --gtest_brief=1 --gtest_fail_fast >"$work/test.log" 2>&1
  local rc=$?
  [ $rc != 124 ] || {
    echo 'ran past the time limit' >"$work/failed"
    return 1
  }
  sed -n 's/^\[  FAILED  \] \([A-Za-z0-9_/]*\.[A-Za-z0-9_/]*\).*/\1/p' "$work/test.log" | sort -u >"$work/failed"
  [ $rc = 0 ] && grep -q '^\[  PASSED  \] [1-9]' "$work/test.log" && return 0
  [ -s "$work/failed" ] || echo "ended with $rc: $(tail -n 1 "$work/test.log" | tr '|' ' ' | cut -c 1-100)" >"$work/failed"
  return 1
}

# Without a mutation all tests must pass, or the results mean nothing.
for test in $(for i in "${chosen[@]}"; do echo "${tests[$i]}"; done | sort -u | tr ' ' '@'); do
  # shellcheck disable=SC2086
  run ${test//@/ } && continue
  echo "without a mutation: ${test//@/ } fails" >&2
  cat "$work/build.log" "$work/test.log" >&2
  exit 2
done

survivors=0
table=$work/table.md
for i in "${chosen[@]}"; do
  file=${files[$i]}
  apply "$i" "$tree" >"$work/mutated" || exit 2
  cp -p "$tree/$file" "$work/original"
  cp "$work/mutated" "$tree/$file"
  # shellcheck disable=SC2086
  run ${tests[$i]}
  case $? in
    0)
      outcome=survived
      [ "${expects[$i]}" = caught ] || outcome="survived: ${expects[$i]}"
      [ "${expects[$i]}" = caught ] && survivors=$((survivors + 1))
      ;;
    1) outcome="caught by $(head -n 3 "$work/failed" | paste -sd ' ' | sed 's/ /, /g')" ;;
    *) outcome='does not compile' && survivors=$((survivors + 1)) ;;
  esac
  cat "$work/original" >"$tree/$file"
  # If a program crashed or took too long without a failed test, the cause may be the code or the
  # machine.
  if grep -q ' ' "$work/failed" && [[ $outcome = caught* ]]; then
    outcome="caught: $(cat "$work/failed")"
    # shellcheck disable=SC2086
    run ${tests[$i]} || {
      echo "${names[$i]}: $outcome, but ${tests[$i]} fails without it, too" >&2
      exit 2
    }
  fi
  echo "${names[$i]}: $outcome"
  [ -e "$table" ] && sed -i "/^| ${names[$i]} |/d" "$table"
  # shellcheck disable=SC2016
  printf '| %s | %s | `%s` | `%s` | %s |\n' "${names[$i]}" "${file##*/}" "${from[$i]//|/\\|}" "${to[$i]//|/\\|}" "$outcome" >>"$table"
done
echo "$survivors of ${#chosen[@]} mutations survived or do not compile, $outdated do not apply any more"
[ $((survivors + outdated)) = 0 ]
