# Tests of membrane; included by tests/CMakeLists.txt when the component is built.
