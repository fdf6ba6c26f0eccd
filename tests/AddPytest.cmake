# SPDX-License-Identifier: GPL-2.0-or-later
# Tests of programs: files of pytest as tests of ctest. Debian's Python is preferred, as Debian's
# packages belong to it.
find_program(LSM_PYTHON NAMES python3 HINTS /usr/bin)
execute_process(COMMAND ${LSM_PYTHON} -c "import numpy, pytest" RESULT_VARIABLE failed OUTPUT_QUIET ERROR_QUIET)
if(failed)
  message(FATAL_ERROR "The tests need pytest and NumPy for ${LSM_PYTHON} (Debian packages python3-pytest, python3-numpy); "
                      "without tests: -DLSM_BUILD_TESTS=OFF")
endif()

# lsm_add_pytest(PREFIX FILE [TOGETHER NAME | ONLY NAME] [NEEDS TARGET...] [LABELS LABEL...] [TIMEOUT SECONDS] [PROCESSORS N]
#                [ENVIRONMENT NAME=VALUE...])
#
# Each function test_NAME of FILE becomes a test PREFIXNAME. With TOGETHER the whole file is one
# test, PREFIXNAME; with ONLY it is that function alone. If a target in NEEDS is missing, there is
# no test.
function(lsm_add_pytest prefix file)
  cmake_parse_arguments(arg "" "TOGETHER;ONLY;TIMEOUT;PROCESSORS" "NEEDS;LABELS;ENVIRONMENT" ${ARGN})
  foreach(target IN LISTS arg_NEEDS)
    if(NOT TARGET ${target})
      return()
    endif()
  endforeach()
  get_filename_component(path ${file} ABSOLUTE)
  set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${path})
  if(arg_TOGETHER)
    set(cases ${arg_TOGETHER})
  elseif(arg_ONLY)
    set(cases ${arg_ONLY})
  else()
    file(STRINGS ${path} cases REGEX "^def test_")
    list(TRANSFORM cases REPLACE "^def test_([a-zA-Z0-9_]+).*" "\\1")
  endif()
  if(NOT arg_TIMEOUT)
    set(arg_TIMEOUT 300)
  endif()
  set(environment PYTEST_DISABLE_PLUGIN_AUTOLOAD=1 PYTHONDONTWRITEBYTECODE=1 LSM_BUILD_DIR=${PROJECT_BINARY_DIR} ${LSM_TEST_TRANSPORT}
                  LSM_STOCK_LMP=${LSM_STOCK_LMP} LSM_CXX=${CMAKE_CXX_COMPILER} LSM_VERSION=${PROJECT_VERSION}
                  ${arg_ENVIRONMENT})
  foreach(program IN ITEMS lmp slider_cli postproc)
    string(TOUPPER ${program} name)
    # A program given in the environment is tested instead: another build, or one run by an
    # emulator.
    if(TARGET ${program})
      list(APPEND environment "LSM_BUILT_${name}=$<TARGET_FILE:${program}>")
    endif()
  endforeach()
  foreach(case IN LISTS cases)
    set(test ${path}::test_${case})
    if(arg_TOGETHER)
      set(test ${path})
    endif()
    add_test(NAME ${prefix}${case} COMMAND ${LSM_PYTHON} -m pytest -q ${test})
    set_tests_properties(${prefix}${case} PROPERTIES ENVIRONMENT "${environment}" TIMEOUT ${arg_TIMEOUT} SKIP_RETURN_CODE 77)
    if(arg_LABELS)
      set_tests_properties(${prefix}${case} PROPERTIES LABELS "${arg_LABELS}")
    endif()
    if(arg_PROCESSORS)
      set_tests_properties(${prefix}${case} PROPERTIES PROCESSORS ${arg_PROCESSORS})
    endif()
  endforeach()
endfunction()
