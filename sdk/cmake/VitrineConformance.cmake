# SPDX-License-Identifier: MIT
# vitrine_add_conformance_tests(NAME [LEVEL n] [SEED n] [TIMEOUT seconds]): adds the test NAME.conformance, which runs
# `vitrine plugin validate` on the plugin that vitrine_add_plugin(NAME) builds. Levels: 1 load, 2 descriptor, 3 template,
# 4 pipeline (default), 5 determinism, 6 hardening; each includes the ones before. TIMEOUT (default 300) is for each
# check. VITRINE_PROGRAM names the program; without it, the one installed with this SDK and then PATH are looked at.
# A test that cannot run must not look like one that passed: without the program the configuration fails.
function(vitrine_add_conformance_tests name)
  cmake_parse_arguments(ARG "" "LEVEL;SEED;TIMEOUT" "" ${ARGN})
  if(ARG_UNPARSED_ARGUMENTS OR ARG_KEYWORDS_MISSING_VALUES)
    message(FATAL_ERROR "vitrine_add_conformance_tests(${name}): what is \"${ARG_UNPARSED_ARGUMENTS}"
                        "${ARG_KEYWORDS_MISSING_VALUES}\"? It takes LEVEL n, SEED n and TIMEOUT seconds")
  endif()
  if(NOT TARGET vitrine_plugin_${name})
    message(FATAL_ERROR "vitrine_add_conformance_tests(${name}): there is no vitrine_add_plugin(${name}) before it")
  endif()
  if(NOT DEFINED ARG_LEVEL)
    set(ARG_LEVEL 4)
  endif()
  if(NOT ARG_LEVEL MATCHES "^[1-6]$")
    message(FATAL_ERROR "vitrine_add_conformance_tests(${name}): LEVEL is ${ARG_LEVEL}, allowed is 1 to 6")
  endif()
  if(NOT DEFINED ARG_TIMEOUT)
    set(ARG_TIMEOUT 300)
  endif()
  set(options --level ${ARG_LEVEL} --timeout ${ARG_TIMEOUT})
  if(DEFINED ARG_SEED)
    list(APPEND options --seed ${ARG_SEED})
  endif()
  find_program(VITRINE_PROGRAM vitrine HINTS ${VITRINE_SDK_PROGRAM_FOLDER} DOC "Runs the conformance tests of plugins")
  if(NOT VITRINE_PROGRAM OR NOT EXISTS ${VITRINE_PROGRAM})
    message(FATAL_ERROR "vitrine_add_conformance_tests(${name}): the program vitrine is not there (VITRINE_PROGRAM is "
      "\"${VITRINE_PROGRAM}\"), so nothing could be tested. Install the package vitrine, or name the program with "
      "-DVITRINE_PROGRAM=/path/to/vitrine, or leave out vitrine_add_conformance_tests().")
  endif()
  add_test(NAME ${name}.conformance
    COMMAND ${VITRINE_PROGRAM} plugin validate $<TARGET_FILE:vitrine_plugin_${name}> ${options})
  # Exit code 0 alone would also pass a program that checked nothing.
  set_tests_properties(${name}.conformance PROPERTIES FAIL_REGULAR_EXPRESSION "(^|\n)0 passed")
endfunction()
