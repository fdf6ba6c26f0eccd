# SPDX-License-Identifier: GPL-2.0-or-later
# lsm_find_lammps_source(<out-dir> <out-id>)
#
# Gives a LAMMPS source folder and a word that identifies it for the build cache. Order: the folder
# given as LSM_LAMMPS_SOURCE; a source or tarball already in LSM_LAMMPS_CACHE; Debian's source
# package through apt; a git clone of the version's tag.

set(LSM_LAMMPS_VERSION "4 Feb 2025")
set(LSM_LAMMPS_TAG "patch_4Feb2025")
set(LSM_LAMMPS_GIT "https://github.com/lammps/lammps.git")
set(LSM_LAMMPS_SUITE "trixie")
set(LSM_LAMMPS_TARBALL "lammps-4Feb2025.tar.xz")
set(LSM_LAMMPS_SHA256 "3671165bd52fad36734e0a9136c5bc5ecb225e03988f8c89aa13366a8b53b1c7")

# Version string of a LAMMPS source folder, empty when it is none.
function(lsm_lammps_version dir out)
  set(version "")
  if(EXISTS ${dir}/src/version.h AND EXISTS ${dir}/cmake/CMakeLists.txt)
    file(STRINGS ${dir}/src/version.h lines REGEX "define +LAMMPS_VERSION ")
    string(REGEX REPLACE ".*\"(.*)\".*" "\\1" version "${lines}")
  endif()
  set(${out} "${version}" PARENT_SCOPE)
endfunction()

# Unpacks what a build needs; the rest of the archive (documentation, examples) is left out.
function(lsm_unpack_lammps tarball dir)
  message(STATUS "Unpacking ${tarball}")
  file(REMOVE_RECURSE ${dir} ${dir}.part)
  file(MAKE_DIRECTORY ${dir}.part)
  execute_process(
    COMMAND tar -xf ${tarball} -C ${dir}.part --strip-components=1 --exclude=*/doc/* --exclude=*/examples/*
            --exclude=*/bench/* --exclude=*/unittest/*
    RESULT_VARIABLE rc)
  if(NOT rc EQUAL 0)
    file(REMOVE_RECURSE ${dir}.part)
    message(FATAL_ERROR "Cannot unpack ${tarball} (is xz-utils installed?)")
  endif()
  file(RENAME ${dir}.part ${dir})
endfunction()

function(lsm_find_lammps_source out_dir out_id)
  if(LSM_LAMMPS_SOURCE)
    get_filename_component(dir ${LSM_LAMMPS_SOURCE} ABSOLUTE BASE_DIR ${CMAKE_BINARY_DIR})
    lsm_lammps_version(${dir} version)
    if(NOT version)
      message(FATAL_ERROR "LSM_LAMMPS_SOURCE=${LSM_LAMMPS_SOURCE}: expected the top folder of a LAMMPS "
                          "source tree (with src/version.h and cmake/CMakeLists.txt)")
    endif()
    if(NOT version STREQUAL LSM_LAMMPS_VERSION)
      message(WARNING "LSM_LAMMPS_SOURCE holds LAMMPS ${version}; the package is written for and tested with "
                      "${LSM_LAMMPS_VERSION}")
    endif()
    message(STATUS "LAMMPS ${version} source: ${dir} (given)")
    set(${out_dir} ${dir} PARENT_SCOPE)
    set(${out_id} "given-${dir}-${version}" PARENT_SCOPE)
    return()
  endif()

  set(cache ${LSM_LAMMPS_CACHE})
  file(MAKE_DIRECTORY ${cache})
  set(dir ${cache}/lammps-4Feb2025)
  set(tarball ${cache}/${LSM_LAMMPS_TARBALL})
  # A source that is complete needs no lock, so that a read-only cache can be used.
  lsm_lammps_version(${dir} version)
  if(NOT version)
    file(LOCK ${cache}/lock TIMEOUT 3600)
    lsm_lammps_version(${dir} version)
  endif()
  if(NOT version)
    if(EXISTS ${tarball})
      file(SHA256 ${tarball} sum)
      if(NOT sum STREQUAL LSM_LAMMPS_SHA256)
        message(WARNING "${tarball} has SHA256 ${sum}, expected ${LSM_LAMMPS_SHA256}: fetched again")
        file(REMOVE ${tarball})
      endif()
    endif()
    if(NOT EXISTS ${tarball})
      message(STATUS "Fetching LAMMPS ${LSM_LAMMPS_VERSION} (132 MB) with apt from Debian ${LSM_LAMMPS_SUITE}")
      execute_process(COMMAND ${CMAKE_CURRENT_FUNCTION_LIST_DIR}/fetch-lammps.sh ${cache}
                              ${LSM_LAMMPS_TARBALL} ${LSM_LAMMPS_SUITE} RESULT_VARIABLE rc)
      if(rc EQUAL 0)
        file(SHA256 ${tarball} sum)
        if(NOT sum STREQUAL LSM_LAMMPS_SHA256)
          message(WARNING "apt delivered a LAMMPS source with SHA256 ${sum}, not the reference one "
                          "${LSM_LAMMPS_SHA256}: left aside")
          file(REMOVE ${tarball})
        endif()
      endif()
    endif()
    if(EXISTS ${tarball})
      lsm_unpack_lammps(${tarball} ${dir})
    else()
      message(STATUS "No source package of LAMMPS ${LSM_LAMMPS_VERSION}: cloning tag ${LSM_LAMMPS_TAG} of ${LSM_LAMMPS_GIT}")
      find_package(Git QUIET)
      if(NOT Git_FOUND)
        message(FATAL_ERROR "git not found. Install git, or give the source with -DLSM_LAMMPS_SOURCE=<folder>")
      endif()
      file(REMOVE_RECURSE ${dir}.part)
      execute_process(COMMAND ${GIT_EXECUTABLE} clone --quiet --depth 1 -b ${LSM_LAMMPS_TAG} ${LSM_LAMMPS_GIT}
                              ${dir}.part RESULT_VARIABLE rc)
      if(NOT rc EQUAL 0)
        file(REMOVE_RECURSE ${dir}.part)
        message(FATAL_ERROR "LAMMPS ${LSM_LAMMPS_VERSION} could be had neither through apt nor with git. Put "
                            "${LSM_LAMMPS_TARBALL} into ${cache}, or give an unpacked source with "
                            "-DLSM_LAMMPS_SOURCE=<folder>")
      endif()
      file(RENAME ${dir}.part ${dir})
    endif()
    lsm_lammps_version(${dir} version)
  endif()
  file(LOCK ${cache}/lock RELEASE RESULT_VARIABLE ignored)
  if(NOT version STREQUAL LSM_LAMMPS_VERSION)
    message(FATAL_ERROR "${dir} holds LAMMPS '${version}', expected ${LSM_LAMMPS_VERSION}: remove the folder")
  endif()
  message(STATUS "LAMMPS ${version} source: ${dir}")
  set(${out_dir} ${dir} PARENT_SCOPE)
  set(${out_id} "${version}" PARENT_SCOPE)
endfunction()
