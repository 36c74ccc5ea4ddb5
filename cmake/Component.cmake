# How every component is declared, installed and tested; one place, so that all are alike.
include(CMakePackageConfigHelpers)
include(GNUInstallDirs)

# tanktread_component(NAME SOURCES ... PUBLIC ... PRIVATE ...): library tanktread::NAME, headers included as "NAME/file.hpp".
function(tanktread_component name)
  cmake_parse_arguments(arg "" "" "SOURCES;PUBLIC;PRIVATE" ${ARGN})
  add_library(tanktread_${name} STATIC ${arg_SOURCES})
  add_library(tanktread::${name} ALIAS tanktread_${name})
  set_target_properties(tanktread_${name} PROPERTIES EXPORT_NAME ${name} POSITION_INDEPENDENT_CODE ON)
  target_include_directories(tanktread_${name} PUBLIC
    $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}> $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}/tanktread>)
  target_compile_features(tanktread_${name} PUBLIC cxx_std_20)
  tanktread_compile_options(tanktread_${name})
  target_link_libraries(tanktread_${name} PUBLIC ${arg_PUBLIC} PRIVATE ${arg_PRIVATE})
  install(TARGETS tanktread_${name} EXPORT tanktreadTargets ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR})
  install(DIRECTORY ${CMAKE_CURRENT_SOURCE_DIR}/ DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/tanktread/${name}
    FILES_MATCHING PATTERN "*.hpp")
endfunction()

# Warnings are errors in our own code; never -ffast-math: results must be the same for any number of threads.
# Two warnings of GCC 12 are of its own headers: -Wrestrict (bug 105329) and -Wmaybe-uninitialized (bug 105593). No -ftrapping-math/-fmath-errno: they forbid vector code and change no result.
function(tanktread_compile_options target)
  target_compile_options(${target} PRIVATE -Wall -Wextra -Wshadow -Werror -Wno-restrict -Wno-maybe-uninitialized -fno-math-errno -fno-trapping-math)
  if(CMAKE_CXX_COMPILER_ID STREQUAL "Clang")  # which does not know the two of GCC
    target_compile_options(${target} PRIVATE -Wno-unknown-warning-option)
  endif()
  if(TANKTREAD_NATIVE)
    target_compile_options(${target} PRIVATE -march=native)
  endif()
endfunction()

# Eigen's alignment depends on the vector width in use. The same for all keeps matrices exchangeable between the libraries
# (perhaps built with -march=native) and programs built without: 64 bytes for what Eigen allocates (a lower maximum would
# not hold, Eigen allocates by the larger of this and its own choice), 16 for matrices of fixed size.
function(tanktread_align_eigen target)
  target_compile_definitions(${target} PUBLIC EIGEN_MAX_ALIGN_BYTES=64 EIGEN_MAX_STATIC_ALIGN_BYTES=16)
endfunction()

# Installs the package config through which find_package(tanktread) finds what was built.
function(tanktread_install_package)
  configure_package_config_file(${PROJECT_SOURCE_DIR}/cmake/tanktreadConfig.cmake.in
    ${PROJECT_BINARY_DIR}/tanktreadConfig.cmake INSTALL_DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/tanktread)
  write_basic_package_version_file(${PROJECT_BINARY_DIR}/tanktreadConfigVersion.cmake COMPATIBILITY SameMinorVersion)
  install(FILES ${PROJECT_BINARY_DIR}/tanktreadConfig.cmake ${PROJECT_BINARY_DIR}/tanktreadConfigVersion.cmake
    DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/tanktread)
  install(EXPORT tanktreadTargets NAMESPACE tanktread:: DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/tanktread)
endfunction()

# Test code is run once and compiled often: half the optimisation takes a third of the time.
function(tanktread_test_compile_options target)
  tanktread_compile_options(${target})
  target_compile_options(${target} PRIVATE -O1)
endfunction()

# tanktread_test(NAME [SECONDS S] SOURCES ... LIBRARIES ...): a GoogleTest program, each test known to ctest by its name (label
# "each"), and with `ctest -C Whole` the program as one, whole.NAME: a process for each test takes longer than most tests.
# Its sources are compiled in groups: helpers of the same name in two of them are an error. S: about how long the whole takes, if
# that is long; such programs start first.
function(tanktread_test name)
  cmake_parse_arguments(arg "" "SECONDS" "SOURCES;LIBRARIES" ${ARGN})
  tanktread_unite(sources ${name} 25 ${arg_SOURCES})
  add_executable(${name} ${sources})
  tanktread_test_compile_options(${name})
  target_include_directories(${name} PRIVATE ${PROJECT_SOURCE_DIR})
  target_link_libraries(${name} PRIVATE ${arg_LIBRARIES} GTest::gtest GTest::gmock GTest::gtest_main)
  # One thread unless a test asks for more: ctest runs several tests at once, and OpenMP threads that wait by spinning
  # on a processor they share with another test take a hundred times as long.
  gtest_discover_tests(${name} DISCOVERY_TIMEOUT 60
    PROPERTIES TIMEOUT 600 LABELS each ENVIRONMENT "OMP_NUM_THREADS=1\\;OMP_WAIT_POLICY=passive")
  add_test(NAME whole.${name} COMMAND ${name} --gtest_brief=1 CONFIGURATIONS Whole)
  set_tests_properties(whole.${name} PROPERTIES TIMEOUT 600 ENVIRONMENT "OMP_NUM_THREADS=1;OMP_WAIT_POLICY=passive")
  if(arg_SECONDS)
    set_tests_properties(whole.${name} PROPERTIES COST ${arg_SECONDS})
  endif()
endfunction()
