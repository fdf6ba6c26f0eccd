# SPDX-License-Identifier: GPL-2.0-or-later
# Script (cmake -P): copies LAMMPS' generated lists of styles and appends a package's headers.
# Variables: FROM (folder styles of the LAMMPS build), TO, PACKAGE (name of the package), and one
# list per category with '|' between the headers: HEADERS_pair, HEADERS_bond, HEADERS_fix,
# HEADERS_compute, HEADERS_command; FAULT: without the styles that lmp_fault does without.

include(${CMAKE_CURRENT_LIST_DIR}/FaultStyles.cmake)
file(MAKE_DIRECTORY ${TO})
set(categories pair bond angle dihedral improper fix compute command)
if(FAULT)
  list(APPEND categories ${lsm_shorter_categories})
endif()
foreach(category IN LISTS categories)
  file(READ ${FROM}/style_${category}.h list)
  set(without "")
  string(REGEX MATCHALL "#include \"[^\n]*\n" lines "${list}")
  foreach(line IN LISTS lines)
    string(REGEX REPLACE ".*\"(.*)\\.h\".*" "\\1" name "${line}")
    lsm_is_left_out(${name} left_out)
    if(FAULT AND left_out)
      string(REPLACE "${line}" "" list "${list}")
      string(APPEND without "${line}")
    endif()
  endforeach()
  string(REPLACE "|" ";" headers "${HEADERS_${category}}")
  foreach(header IN LISTS headers)
    string(APPEND list "#include \"${header}\"\n")
  endforeach()
  if(FAULT AND category STREQUAL "command") # these say so, see left_out.h
    string(APPEND list "#if defined(COMMAND_CLASS) && defined(LSM_COMMAND_MAP)\n#undef CommandStyle\n#define CommandStyle(key, Class) "
           "(*command_map)[#key] = &command_creator<LSMLeftOut>;\n${without}#endif\n")
  endif()
  file(CONFIGURE OUTPUT ${TO}/style_${category}.h CONTENT "${list}" @ONLY)
endforeach()

# What 'lmp -h' names as installed packages.
file(READ ${FROM}/lmpinstalledpkgs.h list)
string(REPLACE "nullptr" "\"${PACKAGE}\", nullptr" list "${list}")
string(REPLACE "NULL" "\"${PACKAGE}\", NULL" list "${list}")
file(CONFIGURE OUTPUT ${TO}/lmpinstalledpkgs.h CONTENT "${list}" @ONLY)
