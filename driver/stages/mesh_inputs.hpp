// The files that the membranes of a case are made of, as inputs of a stage.
#pragma once

#include <vector>

#include "driver/case/case.hpp"
#include "driver/program/output_file.hpp"

namespace tanktread::driver {

/// Adds the mesh files of the capsules, "" for those without one: no output may replace them.
inline void add_mesh_files(const Case& the_case, std::vector<NamedFile>& inputs) {
  for (const auto& capsule : the_case.capsules) {
    inputs.push_back({"mesh.file", capsule.mesh.file});
    inputs.push_back({"stress_free.file", capsule.stress_free.file});
  }
}

}  // namespace tanktread::driver
