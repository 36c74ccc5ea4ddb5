# Tests of coupler; included by tests/CMakeLists.txt when the component is built.
tanktread_test(coupler_unit
  SOURCES unit/coupler_kernels_test.cpp unit/coupler_slopes_test.cpp unit/coupler_stencils_test.cpp
    unit/coupler_transfer_test.cpp unit/coupler_dipole_test.cpp unit/coupler_dipole_layout_test.cpp
    unit/coupler_two_fluids_test.cpp unit/coupler_determinism_test.cpp unit/coupler_normals_test.cpp
    unit/coupler_tangential_test.cpp unit/coupler_volume_test.cpp unit/coupler_parts_test.cpp
    unit/coupler_part_errors_test.cpp unit/coupler_inside_test.cpp unit/coupler_inside_shapes_test.cpp
    unit/coupler_inside_ties_test.cpp unit/coupler_inside_refusal_test.cpp unit/coupler_inside_parts_test.cpp
    unit/coupler_closed_surfaces.cpp
  LIBRARIES tanktread::coupler)
tanktread_test(coupler_verification
  SOURCES verification/coupler_interpolation_test.cpp verification/coupler_sheet_test.cpp
    verification/coupler_two_fluids_test.cpp
  LIBRARIES tanktread::coupler)
