# SPDX-License-Identifier: GPL-2.0-or-later
# LAMMPS as a shared library that is there already, LSM_LAMMPS_LIBRARY: nothing of LAMMPS is compiled, and the package
# registers its styles as the plugin does, with every LAMMPS that is made. Same targets as OwnLammps.cmake.
set(LSM_STOCK_LMP "" CACHE INTERNAL "Stock lmp that loads the plugin")
add_custom_target(lammps_stock)
add_library(lsm_registered OBJECT LSM/plugin/lsm_plugin.cpp LSM/plugin/lsm_register.cpp)
target_include_directories(lsm_registered PRIVATE LSM LSM/scene LSM/speed LSM/support ${style_folder}/own)
target_link_libraries(lsm_registered PRIVATE lammps_headers lsm_core lsm_build_flags)
set_target_properties(lsm_registered PROPERTIES POSITION_INDEPENDENT_CODE ON)

add_library(lammps_parts INTERFACE)
target_sources(lammps_parts INTERFACE $<TARGET_OBJECTS:lsm_styles>)
target_link_libraries(lammps_parts INTERFACE lammps_headers lsm_core ${LSM_LAMMPS_LIBRARY} ${CMAKE_DL_LIBS})
add_library(lammps_program INTERFACE)
target_sources(lammps_program INTERFACE $<TARGET_OBJECTS:lsm_registered>)
target_link_libraries(lammps_program INTERFACE lammps_parts)

add_library(lammps_shared SHARED)
target_link_libraries(lammps_shared PRIVATE lammps_program)
set_target_properties(lammps_shared PROPERTIES OUTPUT_NAME lammps LINKER_LANGUAGE CXX)
add_executable(lmp_fault EXCLUDE_FROM_ALL ${lammps_source}/src/main.cpp)
target_link_libraries(lmp_fault PRIVATE lammps_program)
