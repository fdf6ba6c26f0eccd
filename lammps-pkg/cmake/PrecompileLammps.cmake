# SPDX-License-Identifier: GPL-2.0-or-later
# Given to LAMMPS' own build as CMAKE_PROJECT_INCLUDE: precompiled headers, which halve the time of compiling.
if(PROJECT_NAME STREQUAL "lammps")
  cmake_language(
    DEFER CALL target_precompile_headers lammps PRIVATE
    "$<$<COMPILE_LANGUAGE:CXX>:pointers.h;atom.h;atom_vec.h;bond.h;comm.h;compute.h;domain.h;error.h;fix.h;force.h;group.h;input.h;memory.h;modify.h;neigh_list.h;neighbor.h;pair.h;update.h;variable.h;<algorithm$<ANGLE-R>;<cmath$<ANGLE-R>;<cstring$<ANGLE-R>;<map$<ANGLE-R>;<set$<ANGLE-R>;<unordered_map$<ANGLE-R>;<unordered_set$<ANGLE-R>>")
endif()
