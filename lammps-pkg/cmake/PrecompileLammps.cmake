# SPDX-License-Identifier: GPL-2.0-or-later
# Given to LAMMPS' own build as CMAKE_PROJECT_INCLUDE: what shortens its compilation.
#  - Precompiled headers, which halve it.
#  - Sources that no loop over particles in each step comes from (reading, writing, commands, variables, most fixes and
#    computes) are optimised less: -O1 takes 0.6 of the time of -O3. Interactions, neighbor lists, communication, storage
#    and integration keep what the build type says. The digits are the same.
set(lsm_lammps_hot "^(pair|bond|angle|dihedral|improper|gran_|npair|nbin|nstencil|ntopo|atom|comm|verlet|respa|min|domain|neigh|my_|fix_nve|fix_nh|fix_neigh|fix_langevin|fix_viscous|fix_update|fix_bond_history|fix_wall)")

function(lsm_shorten_compilation)
  set(headers
      "$<$<COMPILE_LANGUAGE:CXX>:pointers.h;atom.h;atom_vec.h;bond.h;comm.h;compute.h;domain.h;error.h;fix.h;force.h;group.h;input.h;memory.h;modify.h;neigh_list.h;neighbor.h;pair.h;update.h;variable.h;<algorithm$<ANGLE-R>;<cmath$<ANGLE-R>;<cstring$<ANGLE-R>;<map$<ANGLE-R>;<set$<ANGLE-R>;<unordered_map$<ANGLE-R>;<unordered_set$<ANGLE-R>>")
  get_target_property(sources lammps SOURCES)
  set(hot)
  set(cold)
  foreach(source IN LISTS sources)
    get_filename_component(name ${source} NAME)
    if(name MATCHES "\\.cpp$" AND NOT name MATCHES "${lsm_lammps_hot}")
      list(APPEND cold ${source})
    else()
      list(APPEND hot ${source})
    endif()
  endforeach()
  # A target of its own, as precompiled headers hold for one level of optimisation: GCC 14 refuses those of -O3 with -O1.
  add_library(lammps_cold OBJECT ${cold})
  foreach(property IN ITEMS INCLUDE_DIRECTORIES COMPILE_DEFINITIONS COMPILE_OPTIONS)
    set_property(TARGET lammps_cold PROPERTY ${property} $<TARGET_PROPERTY:lammps,${property}>)
  endforeach()
  get_target_property(needed lammps MANUALLY_ADDED_DEPENDENCIES)
  if(needed)
    add_dependencies(lammps_cold ${needed})
  endif()
  target_compile_options(lammps_cold PRIVATE $<$<CONFIG:Release>:-O1>)
  set_property(TARGET lammps PROPERTY SOURCES ${hot} $<TARGET_OBJECTS:lammps_cold>)
  target_precompile_headers(lammps PRIVATE "${headers}")
  target_precompile_headers(lammps_cold PRIVATE "${headers}")
endfunction()

if(PROJECT_NAME STREQUAL "lammps")
  cmake_language(DEFER CALL lsm_shorten_compilation)
endif()
