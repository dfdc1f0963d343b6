# Compiler settings and the two shapes a folder can have: a room of the engine, and a test executable.
set(CMAKE_CXX_STANDARD 20)
set(CMAKE_CXX_STANDARD_REQUIRED ON)
set(CMAKE_CXX_EXTENSIONS OFF)
set(CMAKE_C_STANDARD 11)
set(CMAKE_POSITION_INDEPENDENT_CODE ON)
set(CMAKE_CXX_VISIBILITY_PRESET hidden)
set(CMAKE_VISIBILITY_INLINES_HIDDEN ON)
if(NOT CMAKE_BUILD_TYPE)
  set(CMAKE_BUILD_TYPE Release)
endif()
set(CMAKE_RUNTIME_OUTPUT_DIRECTORY ${PROJECT_BINARY_DIR}/bin)

add_library(vitrine_flags INTERFACE)
# No contraction into fused multiply-adds, no fast-math, no -march=native: the same input has to give the same bytes on
# every x86-64 machine and at every optimisation level. Nobody reads floating-point traps or errno after a square root;
# without them, loops with a comparison or a root are computed several numbers at a time.
target_compile_options(vitrine_flags INTERFACE -ffp-contract=off -fno-trapping-math -fno-math-errno -Wall -Wextra
  $<$<COMPILE_LANGUAGE:CXX>:-Wconversion -Wno-sign-conversion> $<$<BOOL:${VITRINE_WERROR}>:-Werror>)
# GCC 12 warns of overlapping copies inside std::string's own operator+ at -O3 (GCC bug 105651).
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU" AND CMAKE_CXX_COMPILER_VERSION VERSION_LESS 13)
  target_compile_options(vitrine_flags INTERFACE $<$<COMPILE_LANGUAGE:CXX>:-Wno-restrict>)
endif()
if(VITRINE_SANITIZE)
  target_compile_options(vitrine_flags INTERFACE -fsanitize=address,undefined -fno-sanitize-recover=undefined -fno-omit-frame-pointer)
  target_link_options(vitrine_flags INTERFACE -fsanitize=address,undefined)
endif()
if(VITRINE_LIBFUZZER)
  target_compile_options(vitrine_flags INTERFACE -fsanitize=fuzzer-no-link)
endif()

# vitrine_room(NAME [SEES room...] [LIBS target...]): a room is its folder: every .cpp in it, and include/ as its only
# public face. SEES are the rooms to its left that its own header needs; LIBS stay private to its .cpp files.
function(vitrine_room name)
  cmake_parse_arguments(ARG "" "" "SEES;LIBS" ${ARGN})
  file(GLOB sources CONFIGURE_DEPENDS *.cpp)
  list(TRANSFORM ARG_SEES PREPEND vitrine_)
  if(sources)
    add_library(vitrine_${name} STATIC ${sources})
    target_include_directories(vitrine_${name} PUBLIC include)
    target_link_libraries(vitrine_${name} PUBLIC ${ARG_SEES} PRIVATE vitrine_flags ${ARG_LIBS})
    # Third-party headers are not ours to keep free of warnings.
    foreach(lib IN LISTS ARG_LIBS)
      if(TARGET ${lib})
        get_target_property(dirs ${lib} INTERFACE_INCLUDE_DIRECTORIES)
        if(dirs AND NOT ${lib} MATCHES "^vitrine_")
          target_include_directories(vitrine_${name} SYSTEM PRIVATE ${dirs})
        endif()
      endif()
    endforeach()
  else()
    add_library(vitrine_${name} INTERFACE)
    target_include_directories(vitrine_${name} INTERFACE include)
    target_link_libraries(vitrine_${name} INTERFACE ${ARG_SEES})
  endif()
endfunction()

# vitrine_test(NAME [LIBS target...] [LABELS l...]): one GoogleTest executable of every .cpp in the folder.
function(vitrine_test name)
  cmake_parse_arguments(ARG "" "" "LIBS;LABELS" ${ARGN})
  file(GLOB sources CONFIGURE_DEPENDS *.cpp)
  if(NOT sources)
    return()
  endif()
  add_executable(test_${name} ${sources})
  target_link_libraries(test_${name} PRIVATE vitrine_flags ${ARG_LIBS} GTest::gtest_main GTest::gmock)
  # A test's own code runs for a moment; building it at -O3 takes half as long again. What it tests is built as shipped.
  target_compile_options(test_${name} PRIVATE $<$<CONFIG:Release>:-O1>)
  target_compile_definitions(test_${name} PRIVATE VITRINE_SOURCE_DIR="${PROJECT_SOURCE_DIR}" VITRINE_BINARY_DIR="${PROJECT_BINARY_DIR}")
  include(GoogleTest)
  gtest_discover_tests(test_${name} DISCOVERY_TIMEOUT 60 PROPERTIES TIMEOUT 900 LABELS "${ARG_LABELS}")
endfunction()
