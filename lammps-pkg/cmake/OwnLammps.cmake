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
add_custom_command(
  OUTPUT ${lammps_stamp}
  BYPRODUCTS ${lammps_library} ${LSM_STOCK_LMP}
  COMMAND ${CMAKE_COMMAND} -DSOURCE=${lammps_source} -DBUILD=${lammps_build} -DCXX=${CMAKE_CXX_COMPILER}
          "-DOPTIONS=${lammps_options_word}" -P ${CMAKE_CURRENT_LIST_DIR}/BuildLammps.cmake
  COMMENT "Stock LAMMPS"
  USES_TERMINAL VERBATIM)

# ---- lists of styles with the package's own -------------------------------------------------------
set(style_stamp ${style_folder}/lsm-styles)
add_custom_command(
  OUTPUT ${style_stamp}
  BYPRODUCTS ${style_lists}
  COMMAND ${CMAKE_COMMAND} -DFROM=${lammps_build}/styles -DTO=${style_folder} -DPACKAGE=LSM ${style_arguments} -P
          ${CMAKE_CURRENT_LIST_DIR}/ExtendStyleLists.cmake
  COMMAND ${CMAKE_COMMAND} -E touch ${style_stamp}
  DEPENDS ${lammps_stamp} ${CMAKE_CURRENT_LIST_DIR}/ExtendStyleLists.cmake
  COMMENT "Lists of styles"
  VERBATIM)
add_custom_target(lammps_stock DEPENDS ${lammps_stamp} ${style_stamp})


# ---- lmp with the package -------------------------------------------------------------------------
# The LAMMPS sources that include a list of styles are compiled again with the longer lists. They
# stand among the objects of the program, so the linker takes nothing of the kind from the archive.
add_library(lammps_with_lsm OBJECT ${lammps_source}/src/force.cpp ${lammps_source}/src/modify.cpp
                                   ${lammps_source}/src/input.cpp ${lammps_source}/src/lammps.cpp)
target_include_directories(lammps_with_lsm BEFORE PRIVATE ${style_folder} LSM LSM/scene LSM/speed LSM/support)
target_include_directories(lammps_with_lsm SYSTEM PRIVATE ${lammps_build}/styles)
target_link_libraries(lammps_with_lsm PRIVATE lammps_headers lsm_core)
target_compile_options(lammps_with_lsm PRIVATE -fno-semantic-interposition)
set_target_properties(lammps_with_lsm PROPERTIES POSITION_INDEPENDENT_CODE ON)
add_dependencies(lammps_with_lsm lammps_stock)

# LAMMPS with the package as a library, for lmp and for tests; the first part without the lists of styles.
add_library(lammps_parts INTERFACE)
target_sources(lammps_parts INTERFACE $<TARGET_OBJECTS:lsm_styles>)
target_link_libraries(lammps_parts INTERFACE lammps_headers lsm_core ${lammps_library} PNG::PNG ZLIB::ZLIB m ${CMAKE_DL_LIBS})
add_library(lammps_program INTERFACE)
target_sources(lammps_program INTERFACE $<TARGET_OBJECTS:lammps_with_lsm>)
target_link_libraries(lammps_program INTERFACE lammps_parts)

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

