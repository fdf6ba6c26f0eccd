#!/bin/bash
# SPDX-License-Identifier: GPL-2.0-or-later
# usage: every_suite.sh PROGRAM SUITE...: the suites of a GoogleTest program are those named, no more and no less
set -euo pipefail
program=$1
shift
diff <(printf '%s\n' "$@" | sort) <("$program" --gtest_list_tests | sed -n 's/^\([A-Za-z]*\)\.$/\1/p' | sort) ||
  { echo "the suites of CMakeLists.txt (<) are not those of the program (>)"; exit 1; }
