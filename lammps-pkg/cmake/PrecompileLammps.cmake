# SPDX-License-Identifier: GPL-2.0-or-later
# Given to LAMMPS' own build as CMAKE_PROJECT_INCLUDE: what shortens its compilation.
#  - Precompiled headers, which halve it.
#  - Sources that no loop over particles in each step comes from (reading, writing, commands, variables, most fixes and
#    computes) are optimised less: -O1 takes 0.6 of the time of -O3. Interactions, neighbor lists, communication, storage
#    and integration keep what the build type says. The digits are the same.
set(lsm_lammps_hot "^(pair|bond|angle|dihedral|improper|gran_|npair|nbin|nstencil|ntopo|atom|comm|verlet|respa|min|domain|neigh|my_|fix_nve|fix_nh|fix_neigh|fix_langevin|fix_viscous|fix_update|fix_bond_history|fix_wall)")

function(lsm_shorten_compilation)
  target_precompile_headers(
    lammps PRIVATE
    "$<$<COMPILE_LANGUAGE:CXX>:pointers.h;atom.h;atom_vec.h;bond.h;comm.h;compute.h;domain.h;error.h;fix.h;force.h;group.h;input.h;memory.h;modify.h;neigh_list.h;neighbor.h;pair.h;update.h;variable.h;<algorithm$<ANGLE-R>;<cmath$<ANGLE-R>;<cstring$<ANGLE-R>;<map$<ANGLE-R>;<set$<ANGLE-R>;<unordered_map$<ANGLE-R>;<unordered_set$<ANGLE-R>>")
  get_target_property(sources lammps SOURCES)
  foreach(source IN LISTS sources)
    get_filename_component(name ${source} NAME)
    if(name MATCHES "\\.cpp$" AND NOT name MATCHES "${lsm_lammps_hot}")
      set_property(SOURCE ${source} APPEND PROPERTY COMPILE_OPTIONS $<$<CONFIG:Release>:-O1>)
    endif()
  endforeach()
endfunction()

if(PROJECT_NAME STREQUAL "lammps")
  cmake_language(DEFER CALL lsm_shorten_compilation)
endif()
