// What is done beside the kernel on the way between membrane nodes and grid.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "coupler/node_normals.hpp"
#include "coupler/tangential_correction.hpp"

namespace tanktread::driver {

/// By coupler.tangential_correction, coupler.shear_dipole and coupler.keep_volume.
struct NodeCorrections {
  std::vector<double> dipole_lengths;  ///< of the surfaces' shear dipoles; empty: there are none
  std::optional<coupler::TangentialCorrection> along_membrane;  ///< nothing: as interpolated
  std::unique_ptr<coupler::NodeNormals> normals;                ///< for these two
  bool keeps_volume = false;                                    ///< of each capsule, in each step
};

}  // namespace tanktread::driver
