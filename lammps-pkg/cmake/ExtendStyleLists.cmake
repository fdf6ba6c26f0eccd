# SPDX-License-Identifier: GPL-2.0-or-later
# Script (cmake -P): copies LAMMPS' generated lists of styles and appends a package's headers.
# Variables: FROM (folder styles of the LAMMPS build), TO, PACKAGE (name of the package), and one
# list per category with '|' between the headers: HEADERS_pair, HEADERS_bond, HEADERS_fix,
# HEADERS_compute, HEADERS_command.

file(MAKE_DIRECTORY ${TO})
foreach(category IN ITEMS pair bond fix compute command)
  file(READ ${FROM}/style_${category}.h list)
  string(REPLACE "|" ";" headers "${HEADERS_${category}}")
  foreach(header IN LISTS headers)
    string(APPEND list "#include \"${header}\"\n")
  endforeach()
  file(CONFIGURE OUTPUT ${TO}/style_${category}.h CONTENT "${list}" @ONLY)
endforeach()

# What 'lmp -h' names as installed packages.
file(READ ${FROM}/lmpinstalledpkgs.h list)
string(REPLACE "nullptr" "\"${PACKAGE}\", nullptr" list "${list}")
string(REPLACE "NULL" "\"${PACKAGE}\", NULL" list "${list}")
file(CONFIGURE OUTPUT ${TO}/lmpinstalledpkgs.h CONTENT "${list}" @ONLY)
