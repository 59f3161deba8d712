# A folder is a layer is a target (engine/layers.txt). Two functions build them all.
option(TORQUESCOPE_TOGETHER "compile several files of most layers at a time (compile_together)" ON)

# Flags of every one of our targets. No -march, no -ffast-math: kernels choose their instruction set at run time, and
# -ffp-contract=off keeps the bits of everything else independent of it.
add_library(torquescope_flags INTERFACE)
target_compile_options(torquescope_flags INTERFACE
  -Wall -Wextra -Wpedantic -Wnon-virtual-dtor -Woverloaded-virtual -Wold-style-cast -Wcast-qual
  $<$<CXX_COMPILER_ID:GNU>:-Wdouble-promotion> -Wimplicit-fallthrough -Werror -ffp-contract=off -fno-math-errno)
# clang also warns of unnamed-namespace names of another file that is compiled together with this one
if(NOT (CMAKE_CXX_COMPILER_ID MATCHES "Clang" AND TORQUESCOPE_TOGETHER))
  target_compile_options(torquescope_flags INTERFACE -Wshadow)
endif()
# GCC 12 at -O3 sees overruns inside its own std::string and std::vector (bugs 105651, 105329, 105562): these four only
# warn of code that is not there. Later compilers and clang-tidy keep watch.
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU" AND CMAKE_CXX_COMPILER_VERSION VERSION_LESS 13)
  target_compile_options(torquescope_flags INTERFACE
    -Wno-restrict -Wno-array-bounds -Wno-stringop-overflow -Wno-maybe-uninitialized)
endif()
# GCC looks for memory to free from 256 MB on and finds little: a twentieth of the time of a file with Eigen, which
# takes 1.1 GB
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
  target_compile_options(torquescope_flags INTERFACE --param=ggc-min-heapsize=500000)
endif()
if(TORQUESCOPE_CONTRACTS)
  target_compile_definitions(torquescope_flags INTERFACE TORQUESCOPE_CONTRACTS=1)
endif()
# a library that nothing is taken from is not loaded either: libhwy, whose headers are all that release builds use
target_link_options(torquescope_flags INTERFACE -Wl,--as-needed)
# Eigen must never start threads of its own: the engine spreads runs, not matrices
target_compile_definitions(torquescope_flags INTERFACE EIGEN_DONT_PARALLELIZE EIGEN_MPL2_ONLY)

# layer(NAME SOURCES a.cpp ... USES base data ... LINKS Eigen3::Eigen ... PRIVATE_LINKS ...)
function(layer name)
  cmake_parse_arguments(LAYER "" "" "SOURCES;USES;LINKS;PRIVATE_LINKS" ${ARGN})
  set(target torquescope_${name})
  add_library(${target} STATIC ${LAYER_SOURCES})
  add_library(torquescope::${name} ALIAS ${target})
  target_compile_features(${target} PUBLIC cxx_std_20)
  target_include_directories(${target} PUBLIC $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}>
                                              $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}/torquescope>)
  target_link_libraries(${target} PRIVATE $<BUILD_INTERFACE:torquescope_flags> ${LAYER_PRIVATE_LINKS})
  foreach(used IN LISTS LAYER_USES)
    target_link_libraries(${target} PUBLIC torquescope_${used})
  endforeach()
  target_link_libraries(${target} PUBLIC ${LAYER_LINKS})
  set_target_properties(${target} PROPERTIES EXPORT_NAME ${name} POSITION_INDEPENDENT_CODE ON)
  set_property(GLOBAL APPEND PROPERTY TORQUESCOPE_LAYERS ${name})
endfunction()

# seldom_run(TARGET), seldom_run_files(FILE...): orders work, multiplies matrices by Eigen's own vector code, or reads
# and writes text, and its time is not felt; a third less time to compile than at -O3
function(seldom_run target)
  set_target_properties(${target} PROPERTIES TORQUESCOPE_SELDOM_RUN ON)
  target_compile_options(${target} PRIVATE $<$<CONFIG:Release>:-O1>)
endfunction()
function(seldom_run_files)
  set_property(SOURCE ${ARGN} APPEND PROPERTY COMPILE_OPTIONS $<$<CONFIG:Release>:-O1>)
endfunction()

# compile_together(TARGET N): N files of a target at a time, where many small ones read the same large headers and make
# the same templates. A cold build takes minutes less (a layer on Eigen half); presets dev and tidy go file by file,
# which is quicker after a change and sees every missing include. N is as large as 1.5 GB of memory allow
function(compile_together target files)
  set_target_properties(${target} PROPERTIES UNITY_BUILD ${TORQUESCOPE_TOGETHER} UNITY_BUILD_BATCH_SIZE ${files})
endfunction()

# instruction_sets_together(TARGET NAME FILE...): files that Highway compiles once per instruction set, as one. Its
# headers take 2 s of a file, for each set anew; most of such files take half a second besides
function(instruction_sets_together target name)
  if(NOT TORQUESCOPE_TOGETHER)
    target_sources(${target} PRIVATE ${ARGN})
    set_source_files_properties(${ARGN} PROPERTIES SKIP_PRECOMPILE_HEADERS ON)
    return()
  endif()
  set(all ${CMAKE_CURRENT_BINARY_DIR}/${name}_together.cpp)
  # every file names itself; the loop over the sets, which the first of them begins, must go on with all
  set(again "#undef HWY_TARGET_INCLUDE\n#define HWY_TARGET_INCLUDE \"${all}\"\n")
  set(text "${again}#include \"hwy/foreach_target.h\"\n")
  foreach(file IN LISTS ARGN)
    string(APPEND text "#include \"${CMAKE_CURRENT_SOURCE_DIR}/${file}\"\n")
  endforeach()
  file(CONFIGURE OUTPUT ${all} CONTENT "${text}${again}" @ONLY)
  target_sources(${target} PRIVATE ${all})
  set_source_files_properties(${all} PROPERTIES SKIP_UNITY_BUILD_INCLUSION ON SKIP_PRECOMPILE_HEADERS ON)
endfunction()

# headers_once(TARGET): what nearly every file of the engine reads, read once for all layers that ask for it: about 1 s
# of each file, or of each that several are compiled as. GCC takes them only with the flags they were read with (fmt's
# definition, code that can be moved), and compiles what is in them as they were: a set each for -O3 and seldom_run()
file(CONFIGURE OUTPUT ${CMAKE_BINARY_DIR}/generated/headers.cpp CONTENT "// of headers_once()\n")
foreach(headers torquescope_headers torquescope_headers_of_seldom)
  add_library(${headers} OBJECT ${CMAKE_BINARY_DIR}/generated/headers.cpp)
  target_link_libraries(${headers} PRIVATE torquescope_flags Eigen3::Eigen fmt::fmt)
  set_target_properties(${headers} PROPERTIES POSITION_INDEPENDENT_CODE ON)
  target_precompile_headers(${headers} PRIVATE <Eigen/Core> <fmt/format.h> <algorithm> <cmath> <filesystem>
    <functional> <map> <memory> <optional> <span> <string> <vector>)
endforeach()
seldom_run(torquescope_headers_of_seldom)
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU" AND CMAKE_CXX_COMPILER_VERSION VERSION_LESS 13)
  target_compile_options(torquescope_flags INTERFACE -Wno-stringop-overread)  # as above: of code that is not there
endif()
function(headers_once target)
  target_link_libraries(${target} PRIVATE fmt::fmt)
  set_target_properties(${target} PROPERTIES POSITION_INDEPENDENT_CODE ON)
  get_target_property(is_seldom ${target} TORQUESCOPE_SELDOM_RUN)
  if(is_seldom)
    target_precompile_headers(${target} REUSE_FROM torquescope_headers_of_seldom)
  else()
    target_precompile_headers(${target} REUSE_FROM torquescope_headers)
  endif()
endfunction()

# choices(TARGET KIND a b c): compiles KINDs/a.cpp ... and writes KIND_choices.inc with one TORQUESCOPE_CHOICE(a) per
# name. Adding a choice is one new file and one word in this list; the registry, list, describe and the job reader
# follow.
function(choices target kind)
  set(text "")
  foreach(name IN LISTS ARGN)
    target_sources(${target} PRIVATE ${CMAKE_CURRENT_SOURCE_DIR}/${kind}s/${name}.cpp)
    string(APPEND text "TORQUESCOPE_CHOICE(${name})\n")
  endforeach()
  set(file ${CMAKE_CURRENT_BINARY_DIR}/choices/${kind}_choices.inc)
  file(CONFIGURE OUTPUT ${file} CONTENT "${text}" @ONLY)
  target_include_directories(${target} PRIVATE ${CMAKE_CURRENT_BINARY_DIR}/choices)
endfunction()

# half of the time of linking the tests; Debian's binutils bring it
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
  include(CheckLinkerFlag)
  check_linker_flag(CXX -fuse-ld=gold TORQUESCOPE_GOLD)
endif()

# what preset tsan builds and runs: the tests labelled `threads`
add_custom_target(threaded_tests)

# only_in_full(TARGETS a b TESTS c d): neither built nor run unless somebody asks (scripts/test --full, presets full)
add_custom_target(full_tests)
function(only_in_full)
  cmake_parse_arguments(FULL "" "" "TARGETS;TESTS" ${ARGN})
  foreach(target IN LISTS FULL_TARGETS)
    set_target_properties(${target} PROPERTIES EXCLUDE_FROM_ALL ON)
    add_dependencies(full_tests ${target})
  endforeach()
  set_property(TEST ${FULL_TESTS} APPEND PROPERTY LABELS full)
endfunction()

# time_limit(SECONDS TEST...): of a release build; presets with a sanitizer say how many times as long theirs take
set(TORQUESCOPE_TIMES_AS_LONG 1 CACHE STRING "factor on the time limits of tests")
function(time_limit seconds)
  math(EXPR limit "${seconds} * ${TORQUESCOPE_TIMES_AS_LONG}")
  set_tests_properties(${ARGN} PROPERTIES TIMEOUT ${limit})
endfunction()

# test_program(TARGET SOURCE...): a program of tests, whatever they test
function(test_program target)
  add_executable(${target} ${ARGN})
  target_link_libraries(${target} PRIVATE torquescope_flags test_support GTest::gtest GTest::gmock)
  # gtest at -O3 doubles the time of a build and finds nothing more: what is tested keeps its own flags
  target_compile_options(${target} PRIVATE $<$<CONFIG:Release>:-O1>)
  # read once for all tests: a quarter of the time of their build
  target_precompile_headers(${target} REUSE_FROM test_headers)
  target_link_options(${target} PRIVATE $<$<BOOL:${TORQUESCOPE_GOLD}>:-fuse-ld=gold>)
  target_include_directories(${target} PRIVATE ${PROJECT_SOURCE_DIR} ${PROJECT_SOURCE_DIR}/tests)
  target_compile_definitions(${target} PRIVATE TORQUESCOPE_SOURCE_DIR="${PROJECT_SOURCE_DIR}")
endfunction()

# tests_together(FOLDER): the unit_test()s of this CMakeLists.txt become one program, compiled as one file, which takes
# half of the time of a cold build. What a file keeps to itself is in a namespace of its own, named like it (namespace
# damage_test), because files compiled together share their unnamed one
function(tests_together folder)
  string(REPLACE "/" "_" flat ${folder})
  test_program(test_${flat})
  target_link_libraries(test_${flat} PRIVATE one_file_main)
  compile_together(test_${flat} 60)
  set(TESTS_TOGETHER test_${flat} PARENT_SCOPE)
endfunction()

# unit_test(FOLDER NAME LINKS ...): NAME.cpp of this folder becomes the program test_FOLDER_NAME, or a part of that of
# tests_together(), labelled by its first folder. COST: its seconds, where they are more than ten; ctest starts the
# longest tests first, so that none is left alone at the end
function(unit_test folder name)
  cmake_parse_arguments(TEST "" "TIMEOUT;COST" "LINKS;LABELS" ${ARGN})
  string(REPLACE "/" "_" flat ${folder})
  set(source ${CMAKE_CURRENT_SOURCE_DIR}/${name}.cpp)
  if(TESTS_TOGETHER)
    set(target ${TESTS_TOGETHER})
    target_sources(${target} PRIVATE ${source})
    add_test(NAME ${flat}.${name} COMMAND ${target} ${name})
  else()
    set(target test_${flat}_${name})
    test_program(${target} ${source})
    target_link_libraries(${target} PRIVATE GTest::gtest_main)
    add_test(NAME ${flat}.${name} COMMAND ${target})
  endif()
  target_link_libraries(${target} PRIVATE ${TEST_LINKS})
  string(REGEX REPLACE "/.*" "" label ${folder})
  set_tests_properties(${flat}.${name} PROPERTIES LABELS "${label};${TEST_LABELS}"
                       ENVIRONMENT "OMP_WAIT_POLICY=passive;${TORQUESCOPE_SANITIZER_ENVIRONMENT}")
  if("threads" IN_LIST TEST_LABELS)
    add_dependencies(threaded_tests ${target})
  endif()
  if(TEST_COST)
    set_tests_properties(${flat}.${name} PROPERTIES COST ${TEST_COST})
  endif()
  if(TEST_TIMEOUT)
    time_limit(${TEST_TIMEOUT} ${flat}.${name})
  endif()
endfunction()
