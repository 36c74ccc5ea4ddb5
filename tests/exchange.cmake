# Tests of exchange; included by tests/CMakeLists.txt when the component is built.
add_library(exchange_samples STATIC unit/exchange_samples.cpp)
tanktread_test_compile_options(exchange_samples)
target_link_libraries(exchange_samples PUBLIC tanktread::exchange GTest::gtest)

# Debian's Python, since python3-meshio and python3-vtk9 are installed for that one.
set(TANKTREAD_PYTHON /usr/bin/python3 CACHE FILEPATH "Python that has meshio and VTK, for the tests")
tanktread_test(exchange_unit
  SOURCES
    unit/exchange_packet_test.cpp
    unit/exchange_grid_parts_test.cpp
    unit/exchange_pieces_test.cpp
    unit/exchange_surface_pieces_test.cpp
    unit/exchange_shell_test.cpp
    unit/exchange_series_test.cpp
    unit/exchange_series_append_test.cpp
    unit/exchange_reading_test.cpp
    unit/exchange_exact_test.cpp
    unit/exchange_hash_test.cpp
    unit/exchange_difference_test.cpp
    unit/exchange_atomic_test.cpp
    integration/exchange_polling_test.cpp
  LIBRARIES exchange_samples)
target_compile_definitions(exchange_unit PRIVATE TANKTREAD_PYTHON="${TANKTREAD_PYTHON}"
  TANKTREAD_BYTES_SCRIPT="${CMAKE_CURRENT_SOURCE_DIR}/integration/exchange_grid_bytes.py"
  TANKTREAD_PIECES_SCRIPT="${CMAKE_CURRENT_SOURCE_DIR}/integration/exchange_pieces.py")

tanktread_test(exchange_meshio_test SOURCES integration/exchange_meshio_test.cpp LIBRARIES exchange_samples)
target_compile_definitions(exchange_meshio_test PRIVATE TANKTREAD_PYTHON="${TANKTREAD_PYTHON}"
  TANKTREAD_MESHIO_SCRIPT="${CMAKE_CURRENT_SOURCE_DIR}/integration/exchange_meshio.py")
