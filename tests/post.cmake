# Tests in Python: post/, the scripts of cases/, the include graph. Included by tests/CMakeLists.txt in a build of everything.
# Debian's Python, whatever else is in PATH: the packages are installed for it.
set(TANKTREAD_PYTHON /usr/bin/python3 CACHE FILEPATH "Python with numpy, matplotlib, meshio and VTK")
find_program(TANKTREAD_XVFB_RUN xvfb-run)

# tanktread_python_test(NAME [DISPLAY] [ARGUMENTS ...]): integration/NAME_test.py; with DISPLAY on a display of its own.
function(tanktread_python_test name)
  cmake_parse_arguments(arg "DISPLAY" "" "ARGUMENTS" ${ARGN})
  set(display)
  if(arg_DISPLAY AND TANKTREAD_XVFB_RUN)
    # Without -noreset the display goes when ParaView closes its first connection to it.
    set(display ${TANKTREAD_XVFB_RUN} --auto-servernum "--server-args=-noreset -screen 0 1280x1024x24")
  endif()
  add_test(NAME python.${name}
    COMMAND ${display} ${TANKTREAD_PYTHON} ${CMAKE_CURRENT_SOURCE_DIR}/integration/${name}_test.py ${arg_ARGUMENTS} -v)
  set_tests_properties(python.${name} PROPERTIES TIMEOUT 600 ENVIRONMENT "PYTHONDONTWRITEBYTECODE=1;OMP_NUM_THREADS=1")
endfunction()

tanktread_python_test(cases_cost_of_accuracy)
tanktread_python_test(cases_large_deformation)
tanktread_python_test(cases_plan ARGUMENTS $<TARGET_FILE:tanktread>)
tanktread_python_test(cases_python_membrane ARGUMENTS $<TARGET_FILE:tanktread>)
tanktread_python_test(cases_run)
tanktread_python_test(cases_small_deformation)
tanktread_python_test(cases_spring_and_interval)
tanktread_python_test(cases_staged_step ARGUMENTS $<TARGET_FILE:tanktread>)
tanktread_python_test(cases_study ARGUMENTS $<TARGET_FILE:tanktread>)
tanktread_python_test(faults ARGUMENTS $<TARGET_FILE:tanktread>)
tanktread_python_test(include_graph)
tanktread_python_test(malformed_inputs ARGUMENTS $<TARGET_FILE:tanktread>)
tanktread_python_test(outside_fluid ARGUMENTS $<TARGET_FILE:tanktread>)
tanktread_python_test(outside_membrane ARGUMENTS $<TARGET_FILE:tanktread>)
tanktread_python_test(post_advice ARGUMENTS $<TARGET_FILE:tanktread>)
tanktread_python_test(post_case_analysis)
tanktread_python_test(post_compare)
tanktread_python_test(post_convert ARGUMENTS $<TARGET_FILE:tanktread>)
tanktread_python_test(post_convert_series ARGUMENTS $<TARGET_FILE:tanktread>)
tanktread_python_test(post_exit_codes)
tanktread_python_test(post_kernel_theory ARGUMENTS $<TARGET_FILE:tanktread>)
tanktread_python_test(post_measured)
tanktread_python_test(post_paraview DISPLAY)
tanktread_python_test(post_picture DISPLAY)
tanktread_python_test(post_series)
tanktread_python_test(post_study)
tanktread_python_test(post_surface_files)
tanktread_python_test(post_viscous_capsule)

add_test(NAME include_graph
  COMMAND ${TANKTREAD_PYTHON} ${CMAKE_CURRENT_SOURCE_DIR}/integration/include_graph.py ${PROJECT_SOURCE_DIR})
