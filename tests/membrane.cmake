# Tests of membrane; included by tests/CMakeLists.txt when the component is built.
add_library(membrane_test_support STATIC unit/membrane_law_list.cpp unit/membrane_support.cpp)
tanktread_compile_options(membrane_test_support)
target_include_directories(membrane_test_support PUBLIC ${CMAKE_CURRENT_SOURCE_DIR})
target_link_libraries(membrane_test_support PUBLIC tanktread::membrane)

tanktread_test(membrane_law_test SOURCES unit/membrane_law_test.cpp LIBRARIES membrane_test_support)
tanktread_test(membrane_element_test SOURCES unit/membrane_element_test.cpp LIBRARIES membrane_test_support)
tanktread_test(membrane_law_force_test SOURCES unit/membrane_law_force_test.cpp LIBRARIES membrane_test_support)
