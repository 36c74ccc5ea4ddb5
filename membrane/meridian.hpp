// Bodies of revolution by the curve that is turned about z: the red cell at rest, and spheroids.
#pragma once

#include <array>

namespace tanktread::membrane {

/// A curve from pole to pole, half of which is, in cylindrical coordinates and with t from 0 (at the upper
/// pole) to pi/2 (at the rim),
///   rho = rim sin t,   z = cos t (heights[0] + heights[1] sin^2 t + heights[2] sin^4 t);
/// the other half is its mirror image in z = 0. Lengths in grid steps (or any unit).
struct Meridian {
  double rim = 1;                             ///< largest distance from the axis
  std::array<double, 3> heights = {1, 0, 0};  ///< the first one is half the thickness on the axis
};

/// Biconcave, the mean red cell at rest (Evans and Fung 1972, Microvasc. Res. 4, 335): its thickness is
/// sqrt(1 - x^2) (0.81 + 7.83 x^2 - 4.39 x^4) micrometres, x = rho/3.91 micrometres; scaled to the volume of
/// a sphere of that radius (2.8215 micrometres of the cell itself). Reduced volume 0.6444.
/// @throws std::invalid_argument unless the radius is positive and finite
Meridian biconcave_meridian(double radius);

/// A spheroid whose axis is `aspect_ratio` times its diameter (below 1: oblate, above: prolate), of the
/// volume of a sphere of that radius.
/// @throws std::invalid_argument unless the radius is positive and finite and 0.1 <= aspect_ratio <= 10
Meridian spheroid_meridian(double radius, double aspect_ratio);

/// The bounds of spheroid_meridian() and spheroid_aspect_ratio(): beyond them the triangles of
/// revolved_mesh() are no good.
inline constexpr double least_aspect_ratio = 0.1, greatest_aspect_ratio = 10, least_reduced_volume = 0.5;

enum class Spheroid { oblate, prolate };
/// The aspect ratio of the spheroid of that reduced volume v, to rounding of v: near a sphere 1 - v grows as
/// the square of the difference of the axes, so the ratio is known to about the root of an epsilon there.
/// @throws std::invalid_argument unless 0.5 <= reduced_volume <= 1
double spheroid_aspect_ratio(double reduced_volume, Spheroid kind);

/// Volume of the body, 4 pi rim^2 (h0/3 + 2 h1/15 + 8 h2/105), exact.
double volume(const Meridian& meridian);
/// Area of its surface, 2 pi int rho ds by Gauss's quadrature, to rounding.
double surface_area(const Meridian& meridian);
/// Volume over that of the sphere of the same area, V/(4 pi/3 (A/(4 pi))^(3/2)); 1 of a sphere.
double reduced_volume(double volume, double area);
double reduced_volume(const Meridian& meridian);

/// Where the curve is at t.
struct MeridianPoint {
  double rho = 0, z = 0;
};
MeridianPoint point_at(const Meridian& meridian, double t);

/// Lengths along the half of a meridian, from the pole: numbers of panels that are as long in t.
class MeridianLength {
 public:
  explicit MeridianLength(const Meridian& meridian);

  /// From the pole to the rim.
  double total() const { return to_panel_.back(); }
  /// t of the point that this share of the length (0 to 1) is away from the pole, to rounding.
  double parameter_at(double share) const;

  static constexpr int n_panels = 128;

 private:
  Meridian meridian_;
  std::array<double, n_panels + 1> to_panel_ = {};  ///< length from the pole to the beginning of each panel
};

}  // namespace tanktread::membrane
