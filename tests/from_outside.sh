# SPDX-License-Identifier: GPL-2.0-or-later
# Functions of the tests from outside, sourced with the program as first argument: a separate folder
# for the test, and ways to run the program there.
set -u
program=$1
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder" || exit 1

fail() {
  echo "FAILED: $*" >&2
  exit 1
}
run() { "$program" "$@" > out.txt 2> err.txt; }
must_run() { run "$@" || fail "$* ended with $?: $(cat err.txt)"; }

# need_strace: ends the test, skipped, where strace is missing or may not trace.
need_strace() {
  command -v strace > /dev/null || { echo "skipped: no strace"; exit 77; }
  strace -o /dev/null true 2> /dev/null || { echo "skipped: strace may not trace here"; exit 77; }
}
# system_calls PATTERN ARGUMENTS...: runs the program and prints those of its system calls that
# change files, as NAME N, the N-th of its name, from the first on that names PATTERN.
system_calls() {
  local pattern=$1
  shift
  strace -f -o calls.log -e trace=openat,write,pwrite64,rename,unlink,unlinkat,fsync,truncate,ftruncate,flock,close \
    "$program" "$@" > out.txt 2> err.txt || fail "$* ended with $? under strace: $(cat err.txt)"
  awk -v pattern="$pattern" '{ sub(/^[0-9]+ +/, ""); name = $0; sub(/\(.*/, "", name) }
    name !~ /^[a-z0-9]+$/ { next }
    { ++n[name] }
    index($0, pattern) { seen = 1 }
    seen { print name, n[name] }' calls.log
}
# with_fault NAME N WHAT ARGUMENTS...: the program, where the N-th call of that name meets WHAT
# (signal=KILL, error=ENOSPC).
with_fault() {
  local where="$1:$3:when=$2"
  shift 3
  strace -f -o /dev/null -e trace="${where%%:*}" -e inject="$where" "$program" "$@" > out.txt 2> err.txt
}
