# Tests of driver; included by tests/CMakeLists.txt when the component is built.
tanktread_test(run_test SOURCES integration/run_test.cpp integration/program.cpp LIBRARIES)
target_compile_definitions(run_test PRIVATE TANKTREAD_PROGRAM="$<TARGET_FILE:tanktread>")
add_dependencies(run_test tanktread)
tanktread_test(driver_test SOURCES unit/case_file_test.cpp unit/units_test.cpp
  integration/step_test.cpp integration/program.cpp LIBRARIES tanktread_driver)
target_compile_definitions(driver_test PRIVATE TANKTREAD_SOURCE_DIR="${PROJECT_SOURCE_DIR}"
  TANKTREAD_PROGRAM="$<TARGET_FILE:tanktread>")
