# Tests of fluid; included by tests/CMakeLists.txt when the component is built.
tanktread_test(fluid_unit
  SOURCES unit/fluid_breakdown_test.cpp unit/fluid_collision_test.cpp unit/fluid_determinism_test.cpp
    unit/fluid_force_test.cpp unit/fluid_settings_test.cpp
  LIBRARIES tanktread::fluid)
tanktread_test(fluid_verification
  SOURCES verification/fluid_channel_test.cpp verification/fluid_taylor_green_test.cpp
  LIBRARIES tanktread::fluid)
