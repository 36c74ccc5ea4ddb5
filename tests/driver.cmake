# Tests of driver; included by tests/CMakeLists.txt when the component is built.
find_package(tomlplusplus REQUIRED)

# tanktread_calls_program(NAME [FORKED]): a test that calls the program. FORKED: by a fork of itself (forked_program.cpp, its main()); such
# tests link the driver. The others start the executable, as a user does.
function(tanktread_calls_program name)
  target_compile_definitions(${name} PRIVATE TANKTREAD_PROGRAM="$<TARGET_FILE:tanktread>")
  add_dependencies(${name} tanktread)
  if("FORKED" IN_LIST ARGN)
    target_compile_definitions(${name} PRIVATE TANKTREAD_FORKED)
    target_sources(${name} PRIVATE integration/forked_program.cpp)
  endif()
endfunction()

tanktread_test(run_test SECONDS 40 SOURCES integration/run_test.cpp integration/run_storage_test.cpp integration/run_series_test.cpp integration/broken_run_test.cpp
  integration/resume_test.cpp integration/resume_refusal_test.cpp integration/program_test.cpp
  integration/command_line_test.cpp integration/program.cpp LIBRARIES tanktread::exchange)
tanktread_calls_program(run_test)
tanktread_test(diff_test SOURCES integration/diff_test.cpp integration/diff_directory_test.cpp integration/program.cpp
  LIBRARIES tanktread::exchange)
tanktread_calls_program(diff_test)
# Not by __FILE__, which is a relative path where ccache has a base directory.
set_source_files_properties(unit/case_schema_test.cpp unit/step_error_test.cpp PROPERTIES
  COMPILE_DEFINITIONS TANKTREAD_SOURCE="${PROJECT_SOURCE_DIR}")
tanktread_test(driver_test SOURCES unit/case_schema_test.cpp unit/case_errors_test.cpp unit/case_bounds_test.cpp
  unit/number_option_test.cpp unit/schedule_test.cpp unit/memory_test.cpp unit/cost_test.cpp
  unit/case_geometry_test.cpp unit/capsule_shape_test.cpp unit/placement_test.cpp unit/case_key_depth_test.cpp unit/case_set_test.cpp unit/case_round_trip_test.cpp unit/case_warnings_test.cpp
  unit/case_programs_test.cpp unit/case_implicit_test.cpp unit/case_coupler_test.cpp unit/case_difference_test.cpp unit/child_process_test.cpp
  unit/inside_packet_test.cpp unit/units_parameters_test.cpp unit/units_si_test.cpp unit/parameters_file_test.cpp unit/echo_text_test.cpp unit/output_directory_test.cpp unit/stability_test.cpp unit/closing_test.cpp unit/waiting_threads_test.cpp unit/step_error_test.cpp unit/checkpoint_times_test.cpp unit/node_shares_test.cpp unit/rank_plan_test.cpp unit/first_error_test.cpp unit/exact_sum_test.cpp unit/surface_files_test.cpp
  integration/step_test.cpp integration/contrast_step_test.cpp integration/program.cpp LIBRARIES tanktread_driver tomlplusplus::tomlplusplus)
tanktread_calls_program(driver_test FORKED)
tanktread_test(tables_test SOURCES integration/energy_test.cpp integration/measures_test.cpp integration/program.cpp
  LIBRARIES tanktread_driver)
tanktread_calls_program(tables_test FORKED)
tanktread_test(implicit_test SOURCES integration/implicit_step_test.cpp integration/implicit_system_test.cpp verification/implicit_order_test.cpp integration/program.cpp
  LIBRARIES tanktread_driver)
tanktread_calls_program(implicit_test FORKED)
tanktread_test(study_test SOURCES verification/study_maxwell_test.cpp verification/study_noise_test.cpp verification/study_kernel_test.cpp
  verification/study_twist_test.cpp verification/study_layers_test.cpp LIBRARIES tanktread_driver)
tanktread_test(stages_test SECONDS 100 SOURCES integration/stages_test.cpp integration/energies_stages_test.cpp integration/implicit_stages_test.cpp integration/implicit_motion_test.cpp
  integration/implicit_refusal_test.cpp integration/replay_test.cpp integration/contrast_stages_test.cpp integration/contrast_files_test.cpp
  integration/mesh_file_test.cpp integration/red_cell_stages_test.cpp integration/cells_from_files_test.cpp integration/output_file_test.cpp integration/program.cpp
  LIBRARIES tanktread_driver)
tanktread_calls_program(stages_test FORKED)
tanktread_test(loads_test SECONDS 15 SOURCES integration/load_step_test.cpp integration/load_stages_test.cpp integration/drag_test.cpp integration/program.cpp
  LIBRARIES tanktread_driver)
tanktread_calls_program(loads_test FORKED)
