# Tests of ranks, and of what runs on several; included by tests/CMakeLists.txt when the component is built.
tanktread_test(ranks_unit SOURCES unit/ranks_division_test.cpp LIBRARIES tanktread::ranks)

# tanktread_rank_test(NAME RANKS n ... SOURCES ... LIBRARIES ...): a GoogleTest program that is run as a whole on each number of
# ranks. More ranks than processors take turns, and as root they run only if told so: the two MPI of Debian read what concerns
# them.
function(tanktread_rank_test name)
  cmake_parse_arguments(arg "" "" "RANKS;SOURCES;LIBRARIES" ${ARGN})
  add_executable(${name} ranks/main.cpp ${arg_SOURCES})
  tanktread_test_compile_options(${name})
  target_include_directories(${name} PRIVATE ${PROJECT_SOURCE_DIR})
  target_link_libraries(${name} PRIVATE tanktread::ranks ${arg_LIBRARIES} GTest::gtest)
  foreach(n IN LISTS arg_RANKS)
    set(command $<TARGET_FILE:${name}>)
    if(TANKTREAD_MPI)
      set(command ${MPIEXEC_EXECUTABLE} ${MPIEXEC_NUMPROC_FLAG} ${n} ${command})
    elseif(NOT n EQUAL 1)
      continue()
    endif()
    add_test(NAME ${name}.${n} COMMAND ${command})
    set_tests_properties(${name}.${n} PROPERTIES TIMEOUT 300 ENVIRONMENT
      "OMP_NUM_THREADS=1;OMPI_ALLOW_RUN_AS_ROOT=1;OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1;OMPI_MCA_rmaps_base_oversubscribe=1;OMPI_MCA_hwloc_base_binding_policy=none;OMPI_MCA_mpi_yield_when_idle=1")
  endforeach()
endfunction()
if(TANKTREAD_MPI)
  find_package(MPI REQUIRED COMPONENTS CXX)  # where mpirun is
endif()
tanktread_rank_test(ranks_messages RANKS 1 2 3 4 6 8 SOURCES ranks/messages_test.cpp LIBRARIES)
if(TARGET tanktread_fluid)
  tanktread_rank_test(ranks_fluid RANKS 1 2 3 4 6 8 SOURCES ranks/fluid_test.cpp LIBRARIES tanktread::fluid)
endif()
if(TARGET tanktread_driver AND NOT TANKTREAD_MISSING_COMPONENTS)
  tanktread_rank_test(ranks_capsules RANKS 1 2 4 6 SOURCES ranks/capsules_test.cpp LIBRARIES tanktread_driver)
  tanktread_rank_test(ranks_engine RANKS 2 4 6 SOURCES ranks/engine_test.cpp LIBRARIES tanktread_driver)
  tanktread_rank_test(ranks_pieces RANKS 1 2 4 6 SOURCES ranks/pieces_test.cpp LIBRARIES tanktread_driver)
endif()
if(TANKTREAD_MPI AND TARGET tanktread AND NOT TANKTREAD_MISSING_COMPONENTS)
  foreach(name ranks ranks_ended)
    add_test(NAME python.${name} COMMAND ${TANKTREAD_PYTHON} ${CMAKE_CURRENT_SOURCE_DIR}/integration/${name}_test.py
      $<TARGET_FILE:tanktread> ${MPIEXEC_EXECUTABLE})
    set_tests_properties(python.${name} PROPERTIES TIMEOUT 600 COST 60 ENVIRONMENT "PYTHONDONTWRITEBYTECODE=1")
  endforeach()
endif()
