// What a case will be and cost, said before it runs.
#pragma once

#include <string>
#include <vector>

#include "driver/case/case.hpp"
#include "driver/plan/echo.hpp"
#include "driver/units/units.hpp"
#include "membrane/mesh.hpp"

namespace tanktread::driver {

/// A case with all that follows from it: what `plan` prints and `run` starts from.
struct Plan {
  Case the_case;  ///< with the hashes of the mesh files that were read
  Parameters parameters;
  std::vector<membrane::TriangleMesh> meshes;
  Cost cost;
  std::string echo;  ///< the text for the user
};

/// Works a case out. Its speed on this machine is measured by a probe: the case itself, for about a second,
/// or a tenth of the run if that is less, and a file of each kind (try_case()).
/// @param meshes the reference meshes if they are known (a resumed run), else they are made
/// @param held_bytes memory that the caller has now and gives back before the run (a state to resume from)
/// @throws InputError, also for a box that memory cannot hold, before it is tried
Plan make_plan(const Case& the_case, std::vector<membrane::TriangleMesh> meshes = {}, double held_bytes = 0);

}  // namespace tanktread::driver
