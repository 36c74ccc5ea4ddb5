# Tests of coupler; included by tests/CMakeLists.txt when the component is built.
