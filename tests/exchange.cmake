# Tests of exchange; included by tests/CMakeLists.txt when the component is built.
add_library(exchange_samples STATIC unit/exchange_samples.cpp)
tanktread_compile_options(exchange_samples)
target_link_libraries(exchange_samples PUBLIC tanktread::exchange GTest::gtest)

tanktread_test(exchange_packet_test SOURCES unit/exchange_packet_test.cpp LIBRARIES exchange_samples)
tanktread_test(exchange_series_test SOURCES unit/exchange_series_test.cpp LIBRARIES exchange_samples)
tanktread_test(exchange_reading_test SOURCES unit/exchange_reading_test.cpp LIBRARIES exchange_samples)
tanktread_test(exchange_atomic_test SOURCES unit/exchange_atomic_test.cpp LIBRARIES exchange_samples)
