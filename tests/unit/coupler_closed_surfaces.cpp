#include "tests/unit/coupler_closed_surfaces.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <utility>

namespace tanktread::coupler::test {
namespace {

Vector cross(const Vector& a, const Vector& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

double dot_product(const Vector& a, const Vector& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

double length(const Vector& a) {
  return std::sqrt(dot_product(a, a));
}

Vector difference(const Vector& a, const Vector& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}

Vector node_of(const Surface& surface, int node) {
  return {surface.positions[3 * node], surface.positions[3 * node + 1], surface.positions[3 * node + 2]};
}

/// The surface with another place for each node.
template <class Map>
Surface mapped(Surface surface, const Map& map) {
  for (std::size_t node = 0; node < surface.positions.size() / 3; ++node) {
    const Vector place = map(node_of(surface, static_cast<int>(node)));
    std::ranges::copy(place, &surface.positions[3 * node]);
  }
  return surface;
}

Surface icosahedron() {
  const double g = std::numbers::phi;
  Surface surface = {
      {-1, g,  0,  1, g, 0,  -1, -g, 0,  1, -g, 0, 0,  -1, g,  0,  1, g,
       0,  -1, -g, 0, 1, -g, g,  0,  -1, g, 0,  1, -g, 0,  -1, -g, 0, 1},
      {0, 11, 5, 0, 5, 1, 0, 1, 7, 0, 7, 10, 0, 10, 11, 1, 5, 9, 5, 11, 4,  11, 10, 2,  10, 7, 6, 7, 1, 8,
       3, 9,  4, 3, 4, 2, 3, 2, 6, 3, 6, 8,  3, 8,  9,  4, 9, 5, 2, 4,  11, 6,  2,  10, 8,  6, 7, 9, 8, 1}};
  return surface;
}

Surface cut_in_four(const Surface& coarse) {
  Surface fine{coarse.positions, {}};
  std::map<std::pair<int, int>, int> middles;
  const auto middle = [&](int a, int b) {
    const auto [place, is_new] =
        middles.try_emplace(std::minmax(a, b), static_cast<int>(fine.positions.size() / 3));
    if (is_new) {
      const Vector u = node_of(coarse, a), v = node_of(coarse, b);
      for (int axis = 0; axis < 3; ++axis) fine.positions.push_back(0.5 * (u[axis] + v[axis]));
    }
    return place->second;
  };
  for (std::size_t t = 0; t < coarse.triangles.size(); t += 3) {
    const int a = coarse.triangles[t], b = coarse.triangles[t + 1], c = coarse.triangles[t + 2];
    const int ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
    fine.triangles.insert(fine.triangles.end(), {a, ab, ca, ab, b, bc, ca, bc, c, ab, bc, ca});
  }
  return fine;
}

/// The winding number of a surface around a point, times 4 pi.
double solid_angle(const Surface& surface, const Vector& point) {
  double sum = 0;
  for (std::size_t t = 0; t < surface.triangles.size(); t += 3) {
    const Vector a = difference(node_of(surface, surface.triangles[t]), point),
                 b = difference(node_of(surface, surface.triangles[t + 1]), point),
                 c = difference(node_of(surface, surface.triangles[t + 2]), point);
    const double la = length(a), lb = length(b), lc = length(c);
    sum += 2 * std::atan2(dot_product(a, cross(b, c)), la * lb * lc + dot_product(a, b) * lc +
                                                           dot_product(b, c) * la + dot_product(c, a) * lb);
  }
  return sum;
}

/// The whole periods by which nodes of the grid may be inside an image of a surface.
std::vector<Vector> images(const Grid& grid) {
  std::array<std::vector<double>, 3> shifts;
  for (int axis = 0; axis < 3; ++axis) {
    const double period = grid.nodes[axis];
    shifts[axis] = grid.periodic[axis] ? std::vector<double>{-period, 0, period} : std::vector<double>{0};
  }
  std::vector<Vector> all;
  for (const double x : shifts[0])
    for (const double y : shifts[1])
      for (const double z : shifts[2]) all.push_back({x, y, z});
  return all;
}

/// The least and the greatest coordinates of a surface.
struct Box {
  explicit Box(const Surface& surface) {
    for (int axis = 0; axis < 3; ++axis) {
      least[axis] = greatest[axis] = surface.positions[axis];
      for (std::size_t k = axis; k < surface.positions.size(); k += 3) {
        least[axis] = std::min(least[axis], surface.positions[k]);
        greatest[axis] = std::max(greatest[axis], surface.positions[k]);
      }
    }
  }
  bool contains(const Vector& point) const {
    bool inside = true;
    for (int axis = 0; axis < 3; ++axis)
      inside = inside && least[axis] <= point[axis] && point[axis] <= greatest[axis];
    return inside;
  }
  Vector least, greatest;
};

}  // namespace

Surface icosphere(int level) {
  Surface surface = icosahedron();
  for (int k = 0; k < level; ++k) surface = cut_in_four(surface);
  return mapped(surface, [](const Vector& node) {
    const double l = length(node);
    return Vector{node[0] / l, node[1] / l, node[2] / l};
  });
}

Surface ellipsoid(int level, const Vector& half_axes) {
  return mapped(icosphere(level), [&](const Vector& node) {
    return Vector{half_axes[0] * node[0], half_axes[1] * node[1], half_axes[2] * node[2]};
  });
}

Surface biconcave_disc(int level, double radius) {
  return mapped(icosphere(level), [&](const Vector& node) {
    const double square = std::min(node[0] * node[0] + node[1] * node[1], 1.0);
    const double thickness = (0.81 + 7.83 * square - 4.39 * square * square) / 3.91;  // over sqrt(1 - x^2)
    return Vector{radius * node[0], radius * node[1], 0.5 * radius * thickness * node[2]};
  });
}

Surface stomatocyte(int level, double radius, double thickness) {
  // The polar angle theta of the sphere goes round the section of the wall: from the bottom outside to the
  // rim and back to the bottom inside.
  constexpr double rim = 2.2;  // beyond pi/2: the mouth is narrower than the bowl
  return mapped(icosphere(level), [&](const Vector& node) {
    const double sine = std::hypot(node[0], node[1]), angle = rim * sine;
    const double distance = radius - 0.5 * thickness * node[2];
    const double across = sine > 0 ? distance * std::sin(angle) / sine : 0;
    return Vector{across * node[0], across * node[1], -distance * std::cos(angle)};
  });
}

Surface box(const Vector& least, const Vector& greatest) {
  Surface surface;
  for (int corner = 0; corner < 8; ++corner)
    for (int axis = 0; axis < 3; ++axis)
      surface.positions.push_back((corner >> axis & 1) != 0 ? greatest[axis] : least[axis]);
  surface.triangles = {0, 4, 6, 0, 6, 2, 1, 3, 7, 1, 7, 5, 0, 1, 5, 0, 5, 4,
                       2, 6, 7, 2, 7, 3, 0, 2, 3, 0, 3, 1, 4, 5, 7, 4, 7, 6};
  return surface;
}

Surface octahedron(const Vector& centre, double radius) {
  Surface surface;
  for (int node = 0; node < 6; ++node)
    for (int axis = 0; axis < 3; ++axis)
      surface.positions.push_back(centre[axis] + (axis == node / 2 ? (node % 2 == 0 ? radius : -radius) : 0));
  surface.triangles = {0, 2, 4, 2, 1, 4, 1, 3, 4, 3, 0, 4, 2, 0, 5, 1, 2, 5, 3, 1, 5, 0, 3, 5};
  return surface;
}

Surface tetrahedron(const std::array<Vector, 4>& corners) {
  Surface surface;
  for (const Vector& corner : corners)
    surface.positions.insert(surface.positions.end(), corner.begin(), corner.end());
  const Vector u = difference(corners[1], corners[0]), v = difference(corners[2], corners[0]),
               w = difference(corners[3], corners[0]);
  surface.triangles = {0, 2, 1, 0, 1, 3, 1, 2, 3, 2, 0, 3};
  return dot_product(u, cross(v, w)) > 0 ? surface : turned_over(surface);
}

Surface placed(Surface surface, const Vector& axis, double angle, const Vector& centre) {
  const double l = length(axis), c = std::cos(angle), s = std::sin(angle);
  const Vector n = {axis[0] / l, axis[1] / l, axis[2] / l};
  return mapped(std::move(surface), [&](const Vector& node) {
    const Vector across = cross(n, node);
    const double along = dot_product(n, node);
    Vector place;
    for (int k = 0; k < 3; ++k) place[k] = centre[k] + c * node[k] + s * across[k] + (1 - c) * along * n[k];
    return place;
  });
}

Surface placed_at_random(const Surface& surface, const Vector& least, const Vector& greatest, unsigned seed) {
  const Numbers random = random_numbers(7, 0, 1, seed);
  Vector axis, centre;
  for (int k = 0; k < 3; ++k) {
    axis[k] = random[k] - 0.5;
    centre[k] = least[k] + random[3 + k] * (greatest[k] - least[k]);
  }
  return placed(surface, axis, 6 * random[6], centre);
}

Surface moved(Surface surface, const Vector& distance) {
  for (std::size_t k = 0; k < surface.positions.size(); ++k) surface.positions[k] += distance[k % 3];
  return surface;
}

Surface turned_over(Surface surface) {
  for (std::size_t t = 0; t < surface.triangles.size(); t += 3)
    std::swap(surface.triangles[t], surface.triangles[t + 1]);
  return surface;
}

Spans::Spans(const std::vector<Surface>& surfaces) {
  for (const Surface& surface : surfaces) {
    positions.emplace_back(surface.positions);
    triangles.emplace_back(surface.triangles);
  }
}

Marks marks_of(const Grid& grid, const std::vector<Surface>& surfaces, int threads) {
  InsideMarks inside(grid, threads);
  const Spans spans(surfaces);
  inside.mark(spans.positions, spans.triangles);
  return {inside.marks().begin(), inside.marks().end()};
}

std::int64_t number_inside(const Marks& marks) {
  return std::ranges::count_if(marks, [](std::int32_t mark) { return mark != 0; });
}

Marks marks_by_solid_angles(const Grid& grid, const std::vector<Surface>& surfaces) {
  Marks marks(std::size_t{1} * grid.nodes[0] * grid.nodes[1] * grid.nodes[2], 0);
  for (std::size_t s = 0; s < surfaces.size(); ++s) {
    for (const Vector& image : images(grid)) {
      const Surface surface = moved(surfaces[s], image);
      const Box around(surface);
      for (std::size_t node = 0; node < marks.size(); ++node) {
        const Vector point = position_of(grid, static_cast<std::int64_t>(node));
        if (!around.contains(point)) continue;
        const double winding_number = solid_angle(surface, point) / (4 * std::numbers::pi);
        if (std::lround(winding_number) == 0) continue;
        marks[node] = marks[node] == 0 && std::lround(winding_number) == 1 ? static_cast<int>(s) + 1 : -1;
      }
    }
  }
  return marks;
}

}  // namespace tanktread::coupler::test
