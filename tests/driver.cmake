# Tests of driver; included by tests/CMakeLists.txt when the component is built.
