// What is added to the velocity that the coupler interpolates to the nodes of membranes.
#pragma once

#include <memory>
#include <optional>

#include "coupler/node_normals.hpp"
#include "coupler/tangential_correction.hpp"

namespace tanktread::driver {

/// By coupler.tangential_correction and coupler.keep_volume.
struct NodeCorrections {
  std::optional<coupler::TangentialCorrection> along_membrane;  ///< nothing: as interpolated
  std::unique_ptr<coupler::NodeNormals> normals;                ///< for that
  bool keeps_volume = false;                                    ///< of each capsule, in each step
};

}  // namespace tanktread::driver
