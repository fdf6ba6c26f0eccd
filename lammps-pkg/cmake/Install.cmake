# SPDX-License-Identifier: GPL-2.0-or-later
# cmake --install, the manual pages, and a Debian package by cpack. To be included by the root
# CMakeLists.txt, last.
include(GNUInstallDirs)
set(share ${CMAKE_INSTALL_DATADIR}/lsm-fault)
# CMake makes folders as the umask says.
install(CODE [[
  execute_process(COMMAND sh -c umask OUTPUT_VARIABLE umask OUTPUT_STRIP_TRAILING_WHITESPACE)
  if(umask MATCHES "[^02]$")
    message(WARNING "The umask is ${umask}: new folders are closed to other users, expected 022 if they are to use them")
  endif()
]])
# For all users, whatever the umask was when the checkout was made.
set(for_all OWNER_READ OWNER_WRITE OWNER_EXECUTE GROUP_READ GROUP_EXECUTE WORLD_READ WORLD_EXECUTE)
set(LSM_PYTHON_DIR lib/python3/dist-packages CACHE STRING "Folder of Python modules below the prefix; Python looks there if it is /usr")

install(TARGETS lsm_core ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR}/lsm-fault)
install(DIRECTORY lammps-pkg/core/ DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/lsm FILES_MATCHING PATTERN "*.h")
install(FILES ${CMAKE_CURRENT_BINARY_DIR}/lammps-pkg/styles/own/lsm_version.h DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/lsm OPTIONAL)
# Scenes, studies, pages and results in the folders of the checkout, so that their links hold.
install(DIRECTORY inputs DESTINATION ${share} PATTERN __pycache__ EXCLUDE REGEX "\\.(sh|py)$" PERMISSIONS ${for_all})
install(DIRECTORY python/lsm DESTINATION ${share}/python FILES_MATCHING PATTERN "*.py")
install(DIRECTORY results DESTINATION ${share} FILES_MATCHING REGEX "\\.(md|png|svg|csv|html|xz|py)$")
install(DIRECTORY lammps-pkg/doc DESTINATION ${share}/lammps-pkg FILES_MATCHING REGEX "\\.(md|rst)$")
install(FILES lammps-pkg/README.md DESTINATION ${share}/lammps-pkg)
install(FILES lammps-pkg/LSM/speed/README.md DESTINATION ${share}/lammps-pkg/LSM/speed)
install(FILES lammps-pkg/cmake/debian-packages.sh DESTINATION ${share}/lammps-pkg/cmake)
foreach(folder IN ITEMS slider postproc)
  file(GLOB pages CONFIGURE_DEPENDS ${folder}/*.md)
  install(FILES ${pages} DESTINATION ${share}/${folder})
endforeach()
install(DIRECTORY tests DESTINATION ${share} FILES_MATCHING REGEX "\\.(md|py|cmake)$")
install(FILES README.md glossary.md ARCHITECTURE.md CONTRIBUTING.md CHANGELOG.md CITATION.cff LICENSE DESTINATION ${share})
file(MAKE_DIRECTORY ${CMAKE_BINARY_DIR}/doc ${CMAKE_BINARY_DIR}/python)
file(CREATE_LINK ../lsm-fault ${CMAKE_BINARY_DIR}/doc/lsm-fault SYMBOLIC)
install(FILES ${CMAKE_BINARY_DIR}/doc/lsm-fault DESTINATION ${CMAKE_INSTALL_DATADIR}/doc)
# Python reads the files of the programs.
file(CREATE_LINK ${PROJECT_SOURCE_DIR}/python/lsm ${CMAKE_BINARY_DIR}/python/lsm SYMBOLIC)
install(DIRECTORY python/lsm DESTINATION ${LSM_PYTHON_DIR} FILES_MATCHING PATTERN "*.py")
install(FILES python/first-catalogue.ipynb DESTINATION ${share}/python)
if(TARGET lmp)
  install(TARGETS lmp RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
  install(TARGETS lsmplugin LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR}/lsm-fault)
  install(TARGETS lammps_shared LIBRARY DESTINATION ${LSM_PYTHON_DIR}/lammps)
  install(DIRECTORY ${LSM_PYTHON_MODULE} DESTINATION ${LSM_PYTHON_DIR} FILES_MATCHING PATTERN "*.py" PATTERN __pycache__ EXCLUDE)
endif()

# Manual pages are made from what --help says.
find_program(LSM_HELP2MAN help2man)
set(pages)
foreach(program IN ITEMS slider_cli postproc)
  if(NOT TARGET ${program})
    continue()
  endif()
  install(TARGETS ${program} RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
  if(NOT LSM_HELP2MAN)
    continue()
  endif()
  set(name_slider_cli "earthquake catalogues of the block-slider model")
  set(name_postproc "statistics and figures of earthquake catalogues")
  set(page ${CMAKE_BINARY_DIR}/man/${program}.1)
  file(MAKE_DIRECTORY ${CMAKE_BINARY_DIR}/man)
  add_custom_command(
    OUTPUT ${page}
    COMMAND ${LSM_HELP2MAN} --no-info --version-string=${PROJECT_VERSION} --name=${name_${program}} --output=${page}
            $<TARGET_FILE:${program}>
    DEPENDS ${program}
    COMMENT "Manual page of ${program}"
    VERBATIM)
  list(APPEND pages ${page})
  install(FILES ${page} DESTINATION ${CMAKE_INSTALL_MANDIR}/man1)
endforeach()
if(pages)
  add_custom_target(manual_pages ALL DEPENDS ${pages})
endif()

# The pages of the styles as HTML
find_program(LSM_SPHINX sphinx-build)
if(LSM_SPHINX)
  add_custom_target(
    pages
    COMMAND ${LSM_SPHINX} -q -n -W --keep-going -b html ${PROJECT_SOURCE_DIR}/lammps-pkg/doc ${CMAKE_BINARY_DIR}/pages
    COMMENT "HTML pages in ${CMAKE_BINARY_DIR}/pages"
    VERBATIM)
endif()

set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME lsm-fault)
set(CPACK_PACKAGE_CONTACT "the authors of lsm-fault <lsm-fault@localhost>")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "${PROJECT_DESCRIPTION}")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION science)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_RECOMMENDS "gnuplot-nox, openmpi-bin, python3-numpy")
# Debian's LAMMPS has a program lmp, too.
set(CPACK_DEBIAN_PACKAGE_CONFLICTS lammps)
set(CPACK_STRIP_FILES ON)
include(CPack)
