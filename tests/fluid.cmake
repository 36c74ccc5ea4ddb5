# Tests of fluid; included by tests/CMakeLists.txt when the component is built.
tanktread_test(fluid_unit
  SOURCES unit/fluid_breakdown_test.cpp unit/fluid_collision_test.cpp unit/fluid_determinism_test.cpp
    unit/fluid_dissipation_test.cpp
    unit/fluid_force_test.cpp unit/fluid_free_velocity_test.cpp unit/fluid_node_rates_test.cpp
    unit/fluid_parts_test.cpp unit/fluid_settings_test.cpp unit/fluid_state_parts_test.cpp unit/fluid_viscosity_test.cpp
  LIBRARIES tanktread::fluid)
tanktread_test(fluid_verification
  SOURCES verification/fluid_channel_test.cpp verification/fluid_layers_test.cpp verification/fluid_power_test.cpp
    verification/fluid_taylor_green_test.cpp
  LIBRARIES tanktread::fluid)

# The program that docs/fluid.md shows, taken from there, so that the page cannot show one that does not work.
set(page ${PROJECT_SOURCE_DIR}/docs/fluid.md)
set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${page})
file(READ ${page} example)
string(REGEX REPLACE "^.*\n```cpp\n" "" example "${example}")
string(REGEX REPLACE "\n```\n.*$" "\n" example "${example}")
file(GENERATE OUTPUT ${CMAKE_CURRENT_BINARY_DIR}/fluid_example.cpp CONTENT "${example}")
add_executable(fluid_example ${CMAKE_CURRENT_BINARY_DIR}/fluid_example.cpp)
tanktread_test_compile_options(fluid_example)
target_link_libraries(fluid_example PRIVATE tanktread::fluid)
add_test(NAME fluid_example COMMAND fluid_example)
