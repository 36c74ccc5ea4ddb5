// Meshes of bodies of revolution.
#pragma once

#include "membrane/meridian.hpp"
#include "membrane/mesh.hpp"

namespace tanktread::membrane {

/// The surface that a meridian makes by turning about z, its centre in the origin, with the triangles, node
/// numbers and azimuths of icosphere(level, 1). A node at the polar angle theta of that sphere goes to the
/// share theta/(pi/2) of the meridian's length, so nodes are as far apart from pole to rim. All nodes lie on
/// the surface; as with icosphere() the triangles, which are chords of it, enclose a little less or, where it
/// is hollow, more. Mirror images in the planes of the axes are exact.
///
/// Of maps ds/dtheta = c (rho/sin theta)^p, tried for p from -1 to 3/4, this one, p = 0, has the narrowest
/// range of edges, or within 2 % of it, but for spheroids of aspect ratio 0.2 and less; p = 1, conformal,
/// would have rounder triangles and bunch them on the axis, p = -1, of equal areas, longer ones about the
/// rim. Held by membrane_revolved_mesh_test: the worst triangle (longest edge over its height, against an
/// equilateral one) and the edges over their mean, at levels 2, 3 and 5:
///
/// | shape                     | level 2           | level 3           | level 5           |
/// | sphere                    | 1.24, 0.92 - 1.09 | 1.25, 0.92 - 1.09 | 1.26, 0.92 - 1.10 |
/// | biconcave                 | 1.49, 0.85 - 1.26 | 1.53, 0.85 - 1.29 | 1.54, 0.85 - 1.30 |
/// | spheroid, aspect ratio 0.2| 1.75, 0.67 - 1.32 | 1.75, 0.79 - 1.40 | 1.79, 0.81 - 1.46 |
/// |                        0.5| 1.50, 0.84 - 1.25 | 1.55, 0.84 - 1.29 | 1.57, 0.85 - 1.31 |
/// |                          2| 1.92, 0.69 - 1.26 | 1.93, 0.69 - 1.26 | 1.94, 0.69 - 1.26 |
/// |                          5| 4.16, 0.38 - 1.52 | 4.19, 0.38 - 1.52 | 4.21, 0.38 - 1.52 |
/// @throws std::invalid_argument unless 0 <= level <= 8
TriangleMesh revolved_mesh(const Meridian& meridian, int level);

}  // namespace tanktread::membrane
