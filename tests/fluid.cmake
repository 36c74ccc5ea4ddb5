# Tests of fluid; included by tests/CMakeLists.txt when the component is built.
