# Fuzzers of all that is read from outside, by tests/fuzz/run; and their entries as ordinary tests on their seeds. Included by
# tests/CMakeLists.txt in a build of everything.
find_package(fmt REQUIRED)
find_package(VTK REQUIRED COMPONENTS CommonCore CommonDataModel CommonExecutionModel IOXML)
add_library(tanktread_fuzz_targets STATIC fuzz/targets.cpp fuzz/seeds.cpp fuzz/input_file.cpp)
tanktread_test_compile_options(tanktread_fuzz_targets)
target_include_directories(tanktread_fuzz_targets PUBLIC ${PROJECT_SOURCE_DIR})
target_link_libraries(tanktread_fuzz_targets PUBLIC tanktread_driver tanktread::exchange
  PRIVATE VTK::CommonCore VTK::CommonDataModel VTK::CommonExecutionModel VTK::IOXML)

if(TANKTREAD_FUZZ)
  add_executable(write_seeds fuzz/write_seeds.cpp)
  target_link_libraries(write_seeds PRIVATE tanktread_fuzz_targets fmt::fmt)
  add_custom_target(fuzzers DEPENDS write_seeds)
  foreach(target case_file assignment surface grid surface_index grid_index series table observables)
    add_executable(fuzz_${target} fuzz/fuzzer.cpp)
    target_compile_definitions(fuzz_${target} PRIVATE TANKTREAD_FUZZ_TARGET="${target}")
    target_link_options(fuzz_${target} PRIVATE -fsanitize=fuzzer)
    target_link_libraries(fuzz_${target} PRIVATE tanktread_fuzz_targets)
    add_dependencies(fuzzers fuzz_${target})
  endforeach()
else()
  tanktread_test(fuzz_seeds_test SOURCES fuzz/seeds_test.cpp LIBRARIES tanktread_fuzz_targets)
endif()
