# Tests of membrane; included by tests/CMakeLists.txt when the component is built.
add_library(membrane_test_support STATIC unit/membrane_energy_list.cpp unit/membrane_law_list.cpp unit/membrane_support.cpp
  unit/membrane_viscous_support.cpp)
tanktread_test_compile_options(membrane_test_support)
target_include_directories(membrane_test_support PUBLIC ${CMAKE_CURRENT_SOURCE_DIR})
target_link_libraries(membrane_test_support PUBLIC tanktread::membrane)

tanktread_test(membrane_unit
  SOURCES
    unit/membrane_law_test.cpp
    unit/membrane_element_test.cpp
    unit/membrane_law_force_test.cpp
    unit/membrane_surface_test.cpp
    unit/membrane_step_test.cpp
    unit/membrane_begin_at_test.cpp
    unit/membrane_mesh_test.cpp
    unit/membrane_meridian_test.cpp
    unit/membrane_revolved_mesh_test.cpp
    unit/membrane_rotation_test.cpp
    unit/membrane_placed_surface_test.cpp
    unit/membrane_shape_test.cpp
    unit/membrane_viscous_law_test.cpp
    unit/membrane_viscous_test.cpp
    unit/membrane_viscous_interval_test.cpp
    unit/membrane_strain_rates_test.cpp
    unit/membrane_implicit_viscosity_test.cpp
    unit/membrane_contour_test.cpp
    unit/membrane_viscous_power_test.cpp
    unit/membrane_with_energies_test.cpp
    unit/membrane_energy_closed_form_test.cpp
    unit/membrane_energy_force_test.cpp
    unit/membrane_energy_terms_test.cpp
    unit/membrane_end_loads_test.cpp
    unit/membrane_orientation_test.cpp
    unit/membrane_node_drag_test.cpp
    unit/membrane_surface_check_test.cpp
  LIBRARIES membrane_test_support)
tanktread_test(membrane_verification
  SOURCES
    verification/membrane_revolved_mesh_order_test.cpp
    verification/membrane_shape_convergence_test.cpp
    verification/membrane_force_convergence_test.cpp
    verification/membrane_maxwell_test.cpp
    verification/membrane_strain_rates_exact_test.cpp
    verification/membrane_strain_rates_order_test.cpp
    verification/membrane_contour_order_test.cpp
    verification/membrane_energy_order_test.cpp
  LIBRARIES membrane_test_support)
