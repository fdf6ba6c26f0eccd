# SPDX-License-Identifier: GPL-2.0-or-later
# LAMMPS built from its source: a stock build once, in the cache, and the few sources that include a list of styles again
# with the package's. Targets: lammps_stock, lammps_parts, lammps_program, lammps_shared.

# ---- stock LAMMPS ---------------------------------------------------------------------------------
set(lammps_options
    -DCMAKE_BUILD_TYPE=Release
    -DCMAKE_CXX_STANDARD=17
    -DBUILD_SHARED_LIBS=off
    -DCMAKE_POSITION_INDEPENDENT_CODE=on
    -DCMAKE_CXX_FLAGS=-fno-semantic-interposition
    -DBUILD_MPI=on
    -DBUILD_OMP=off
    -DLAMMPS_SIZES=${LSM_LAMMPS_SIZES}
    -DPKG_BPM=on
    -DPKG_GRANULAR=on
    -DPKG_MOLECULE=on
    -DPKG_PLUGIN=on
    -DFFT=KISS
    -DWITH_JPEG=off
    -DWITH_PNG=on
    -DWITH_GZIP=on
    -DWITH_FFMPEG=off
    -DDOWNLOAD_POTENTIALS=off
    ${LSM_LAMMPS_OPTIONS})
# Whatever changes the objects of LAMMPS is part of the key; another key is another folder.
set(precompile ${CMAKE_CURRENT_LIST_DIR}/PrecompileLammps.cmake)
set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${precompile})
file(SHA256 ${precompile} how_compiled)
string(SHA256 key "${lammps_id};${lammps_options};${how_compiled};${CMAKE_CXX_COMPILER};${CMAKE_CXX_COMPILER_VERSION};${MPI_CXX_LIBRARIES}")
string(SUBSTRING ${key} 0 12 key)
set(lammps_build ${LSM_LAMMPS_CACHE}/stock-${key})
set(lammps_stamp ${lammps_build}/lsm-complete)
set(lammps_library ${lammps_build}/liblammps.a)
set(LSM_STOCK_LMP ${lammps_build}/lmp CACHE INTERNAL "Stock lmp that loads the plugin")
set(LSM_LAMMPS_STYLES ${lammps_build}/styles CACHE INTERNAL "LAMMPS' own lists of styles")
message(STATUS "LAMMPS stock build: ${lammps_build}")

string(REPLACE ";" "|" lammps_options_word "${lammps_options}")
set(build_lammps ${CMAKE_COMMAND} -DSOURCE=${lammps_source} -DBUILD=${lammps_build} -DCXX=${CMAKE_CXX_COMPILER}
                 "-DOPTIONS=${lammps_options_word}")
set(build_scripts ${CMAKE_CURRENT_LIST_DIR}/BuildLammps.cmake ${CMAKE_CURRENT_LIST_DIR}/FaultStyles.cmake)
add_custom_command(
  OUTPUT ${lammps_stamp}
  BYPRODUCTS ${lammps_library} ${LSM_STOCK_LMP}
  COMMAND ${build_lammps} -P ${CMAKE_CURRENT_LIST_DIR}/BuildLammps.cmake
  COMMENT "Stock LAMMPS"
  USES_TERMINAL VERBATIM)
# What lmp_fault needs of it. The first command of the README builds no more.
set(lammps_fault_library ${CMAKE_CURRENT_BINARY_DIR}/liblammps_fault.a)
add_custom_command(
  OUTPUT ${lammps_fault_library}
  COMMAND ${build_lammps} -DARCHIVE=${lammps_fault_library} -DAR=${CMAKE_AR} -P ${CMAKE_CURRENT_LIST_DIR}/BuildLammps.cmake
  DEPENDS ${build_scripts}
  COMMENT "Stock LAMMPS, as far as a fault needs it"
  USES_TERMINAL VERBATIM)

# ---- lmp with the package -------------------------------------------------------------------------
# The LAMMPS sources that include a list of styles are compiled again with longer lists, which have the package's own, and
# for lmp_fault with shorter ones. They stand among the objects of the program, so the linker takes nothing of the kind
# from the archive.
add_library(lammps_parts INTERFACE)
target_sources(lammps_parts INTERFACE $<TARGET_OBJECTS:lsm_styles>)
target_link_libraries(lammps_parts INTERFACE lammps_headers lsm_core ${lammps_library} ${lammps_threads} PNG::PNG ZLIB::ZLIB m
                                              ${CMAKE_DL_LIBS})
include(${CMAKE_CURRENT_LIST_DIR}/FaultStyles.cmake)
# Of two sources with the list of commands, the one that makes them: see left_out.h.
set_source_files_properties(${lammps_source}/src/input.cpp PROPERTIES COMPILE_DEFINITIONS LSM_COMMAND_MAP)
foreach(fault IN ITEMS "" _fault)
  set(folder ${style_folder}${fault})
  string(REPLACE "${style_folder}/" "${folder}/" lists "${style_lists}")
  set(made_from ${lammps_stamp})
  set(sources force modify input lammps)
  if(fault)
    set(made_from ${lammps_fault_library})
    list(APPEND sources ${lsm_shorter_sources})
    list(TRANSFORM lsm_shorter_categories REPLACE "(.+)" "${folder}/style_\\1.h" OUTPUT_VARIABLE shorter)
    list(APPEND lists ${shorter})
  endif()
  list(TRANSFORM sources REPLACE "(.+)" "${lammps_source}/src/\\1.cpp")
  add_custom_command(
    OUTPUT ${folder}/lsm-styles
    BYPRODUCTS ${lists}
    COMMAND ${CMAKE_COMMAND} -DFROM=${lammps_build}/styles -DTO=${folder} -DPACKAGE=LSM -DFAULT=${fault} ${style_arguments} -P
            ${CMAKE_CURRENT_LIST_DIR}/ExtendStyleLists.cmake
    COMMAND ${CMAKE_COMMAND} -E touch ${folder}/lsm-styles
    DEPENDS ${made_from} ${build_scripts} ${CMAKE_CURRENT_LIST_DIR}/ExtendStyleLists.cmake
    COMMENT "Lists of styles"
    VERBATIM)
  add_custom_target(lammps_stock${fault} DEPENDS ${made_from} ${folder}/lsm-styles)
  set(with_lists lammps_with_lsm${fault})
  add_library(${with_lists} OBJECT EXCLUDE_FROM_ALL ${sources})
  target_include_directories(${with_lists} BEFORE PRIVATE ${folder} LSM LSM/scene LSM/speed LSM/support)
  target_include_directories(${with_lists} SYSTEM PRIVATE ${lammps_build}/styles)
  target_link_libraries(${with_lists} PRIVATE lammps_headers lsm_core)
  # -O1 as in PrecompileLammps.cmake.
  target_compile_options(${with_lists} PRIVATE -fno-semantic-interposition $<$<CONFIG:Release>:-O1>)
  if(fault)
    target_compile_options(${with_lists} PRIVATE -include ${CMAKE_CURRENT_LIST_DIR}/left_out.h)
  endif()
  set_target_properties(${with_lists} PROPERTIES POSITION_INDEPENDENT_CODE ON)
  add_dependencies(${with_lists} lammps_stock${fault})
endforeach()
add_library(lammps_program INTERFACE)
target_sources(lammps_program INTERFACE $<TARGET_OBJECTS:lammps_with_lsm>)
target_link_libraries(lammps_program INTERFACE lammps_parts)
add_executable(lmp_fault EXCLUDE_FROM_ALL ${lammps_source}/src/main.cpp $<TARGET_OBJECTS:lsm_styles>
                                          $<TARGET_OBJECTS:lammps_with_lsm_fault>)
target_link_libraries(lmp_fault PRIVATE lammps_headers lsm_core ${lammps_fault_library} ${lammps_threads} PNG::PNG ZLIB::ZLIB m
                                        ${CMAKE_DL_LIBS})
add_dependencies(lmp_fault lammps_stock_fault)
if(LSM_BUILD_TESTS AND CMAKE_GENERATOR MATCHES "Ninja")
  set_target_properties(lmp_fault PROPERTIES EXCLUDE_FROM_ALL OFF)
endif()

# ---- liblammps.so with the package, and LAMMPS' Python module beside it ----------------------------
# All of the archive but what is compiled again: programs may call what lmp itself does not need.
set(lammps_rest ${CMAKE_CURRENT_BINARY_DIR}/liblammps_rest.a)
add_custom_command(
  OUTPUT ${lammps_rest}
  COMMAND ${CMAKE_COMMAND} -E copy ${lammps_library} ${lammps_rest}
  COMMAND ${CMAKE_AR} d ${lammps_rest} force.cpp.o modify.cpp.o input.cpp.o lammps.cpp.o
  DEPENDS ${lammps_stamp}
  VERBATIM)
add_library(lammps_shared SHARED $<TARGET_OBJECTS:lsm_styles> $<TARGET_OBJECTS:lammps_with_lsm> ${lammps_rest})
target_link_libraries(lammps_shared PRIVATE lsm_core -Wl,--whole-archive ${lammps_rest} -Wl,--no-whole-archive MPI::MPI_CXX PNG::PNG
                                            ZLIB::ZLIB m ${CMAKE_DL_LIBS})
set_target_properties(lammps_shared PROPERTIES OUTPUT_NAME lammps LINKER_LANGUAGE CXX)

