// What a case will be and cost, said before it runs.
#pragma once

#include <string>
#include <vector>

#include "driver/case/case.hpp"
#include "driver/packets/membrane_shapes.hpp"
#include "driver/plan/echo.hpp"
#include "driver/units/units.hpp"

namespace tanktread::driver {

/// A case with all that follows from it: what `plan` prints and `run` starts from.
struct Plan {
  Case the_case;  ///< with the hashes of the mesh files that were read
  Parameters parameters;
  MembraneShapes shapes;        ///< none where no process is to hold them all (make_plan())
  std::vector<MeshSize> sizes;  ///< of the mesh of each capsule
  Cost cost;
  std::string echo;  ///< the text for the user
};

/// What is tried of a large case.
enum class Trial {
  whole,   ///< all of it; a box that memory does not hold here is refused
  sample,  ///< a sample (sample.hpp) of a box that memory does not hold, or of over 16 million nodes: for
           ///< many ranks, each of which has a part
  none,    ///< nothing: no speed, no times, and no box is refused for this machine's memory
};

/// Works a case out. Its speed on this machine is measured by a probe: the case itself, for about a second,
/// or a tenth of the run if that is less, and a file of each kind (try_case()); unless trial is `none`.
/// @param shapes of the capsules if they are known (a resumed run), else they are made.
/// On several ranks, and unless all is tried, shapes of more than output.whole_file_triangles triangles
/// together are made one after the other and not held: their owners make them again.
/// @param held_bytes memory that the caller has now and gives back before the run (a state to resume from)
/// @throws InputError, also for a box that memory cannot hold, before it is tried
Plan make_plan(const Case& the_case, MembraneShapes shapes = {}, double held_bytes = 0,
               Trial trial = Trial::whole);

}  // namespace tanktread::driver
