# SPDX-License-Identifier: MIT
# vitrine_add_plugin(NAME SOURCES file...): builds NAME.vitrine.so, a library that exports vitrine_plugin_entry and
# nothing else, into VITRINE_PLUGIN_OUTPUT_DIRECTORY (default: the current folder of the build tree). The target is
# vitrine_plugin_NAME.
function(vitrine_add_plugin name)
  cmake_parse_arguments(ARG "" "" "SOURCES" ${ARGN})
  if(NOT name MATCHES "^[a-z][a-z0-9_-]*$")
    message(FATAL_ERROR "vitrine_add_plugin(${name}): a name is small letters, digits, _ and -, and begins with a letter")
  endif()
  if(NOT ARG_SOURCES)
    message(FATAL_ERROR "vitrine_add_plugin(${name}): SOURCES is missing")
  endif()
  if(NOT VITRINE_PLUGIN_OUTPUT_DIRECTORY)
    set(VITRINE_PLUGIN_OUTPUT_DIRECTORY ${CMAKE_CURRENT_BINARY_DIR})
  endif()
  # A target name of its own, so that a plugin may be called like a target of the project around it.
  set(target vitrine_plugin_${name})
  add_library(${target} MODULE ${ARG_SOURCES})
  set_target_properties(${target} PROPERTIES
    PREFIX "" OUTPUT_NAME ${name} SUFFIX ".vitrine.so" LIBRARY_OUTPUT_DIRECTORY ${VITRINE_PLUGIN_OUTPUT_DIRECTORY}
    C_STANDARD 11 CXX_STANDARD 20 CXX_STANDARD_REQUIRED ON
    C_VISIBILITY_PRESET hidden CXX_VISIBILITY_PRESET hidden VISIBILITY_INLINES_HIDDEN ON)
  target_link_libraries(${target} PRIVATE Vitrine::sdk)
  target_compile_options(${target} PRIVATE -Wall -Wextra)
  # An undefined symbol is the author's error, to be found here and not when a shop loads the plugin. Hidden visibility
  # does not reach what a static library brings along; --exclude-libs does. Tables need no library at all: --as-needed
  # leaves out what the compiler would add, so that a plugin does not ask for one C++ runtime or the other.
  target_link_options(${target} PRIVATE -Wl,--no-undefined -Wl,--exclude-libs,ALL -Wl,--as-needed)
  # The host refuses a plugin that others could change; a umask of 002 would make one.
  add_custom_command(TARGET ${target} POST_BUILD COMMAND chmod go-w $<TARGET_FILE:${target}>
                     $<TARGET_FILE_DIR:${target}> VERBATIM)
endfunction()
