# Tests of exchange; included by tests/CMakeLists.txt when the component is built.
