# SPDX-License-Identifier: GPL-2.0-or-later
# Script (cmake -P): configures and builds stock LAMMPS once, as static library and as program.
# Variables: SOURCE, BUILD (folders), CXX (compiler), OPTIONS (LAMMPS options, '|' between them).
# The file lsm-complete in BUILD says that the build is whole; with it nothing is done.

set(stamp ${BUILD}/lsm-complete)
if(EXISTS ${stamp})
  message(STATUS "Stock LAMMPS is built already: ${BUILD}")
  return()
endif()
file(MAKE_DIRECTORY ${BUILD})
file(LOCK ${BUILD}/lsm-lock TIMEOUT 3600)
if(EXISTS ${stamp})
  return()
endif()

find_program(ninja NAMES ninja ninja-build)
if(ninja)
  set(generator -G Ninja -DCMAKE_MAKE_PROGRAM=${ninja})
else()
  set(generator -G "Unix Makefiles")
endif()
string(REPLACE "|" ";" options "${OPTIONS}")
message(STATUS "Building stock LAMMPS in ${BUILD} (some minutes, once)")
execute_process(
  COMMAND ${CMAKE_COMMAND} -S ${SOURCE}/cmake -B ${BUILD} ${generator} -DCMAKE_CXX_COMPILER=${CXX}
          -DCMAKE_PROJECT_INCLUDE=${CMAKE_CURRENT_LIST_DIR}/PrecompileLammps.cmake -Wno-dev -Wno-deprecated ${options}
  OUTPUT_FILE ${BUILD}/lsm-configure.log
  RESULT_VARIABLE rc)
if(NOT rc EQUAL 0)
  message(FATAL_ERROR "LAMMPS does not configure: see above and ${BUILD}/lsm-configure.log")
endif()

set(jobs "$ENV{CMAKE_BUILD_PARALLEL_LEVEL}")
if(NOT jobs)
  cmake_host_system_information(RESULT jobs QUERY NUMBER_OF_LOGICAL_CORES)
endif()
execute_process(COMMAND ${CMAKE_COMMAND} --build ${BUILD} --parallel ${jobs} RESULT_VARIABLE rc)
if(NOT rc EQUAL 0)
  message(FATAL_ERROR "LAMMPS does not build: see above")
endif()
file(WRITE ${stamp} "${OPTIONS}\n")
