#include "membrane/meridian.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <string>

namespace tanktread::membrane {
namespace {

using std::numbers::pi;

constexpr double panel_width = 0.5 * pi / MeridianLength::n_panels;

/// ds/dt.
double speed_at(const Meridian& meridian, double t) {
  const auto& [h0, h1, h2] = meridian.heights;
  const double s = std::sin(t), c = std::cos(t), s2 = s * s;
  const double along_z = -s * (h0 + s2 * (h1 + s2 * h2)) + 2 * s * c * c * (h1 + 2 * h2 * s2);
  return std::hypot(meridian.rim * c, along_z);
}

/// Gauss's quadrature of five points. Over panels of this width it is exact to rounding: the integrands are
/// analytic about the axis of t to a distance of least_aspect_ratio or more.
template <class Integrand>
double integral(double from, double to, const Integrand& integrand) {
  const double near = std::sqrt(5 - 2 * std::sqrt(10.0 / 7)) / 3,
               far = std::sqrt(5 + 2 * std::sqrt(10.0 / 7)) / 3;
  const double heavy = (322 + 13 * std::sqrt(70.0)) / 900, light = (322 - 13 * std::sqrt(70.0)) / 900;
  const double middle = 0.5 * (from + to), half = 0.5 * (to - from);
  const auto pair = [&](double at) { return integrand(middle - half * at) + integrand(middle + half * at); };
  return half * (128.0 / 225 * integrand(middle) + heavy * pair(near) + light * pair(far));
}

void require_radius(const std::string& shape, double radius) {
  if (radius > 0 && std::isfinite(radius)) return;
  throw std::invalid_argument(shape + ": the radius is " + std::to_string(radius) +
                              ", must be positive and finite");
}

Meridian scaled(const Meridian& meridian, double by) {
  const auto& h = meridian.heights;
  return {by * meridian.rim, {by * h[0], by * h[1], by * h[2]}};
}

}  // namespace

Meridian biconcave_meridian(double radius) {
  require_radius("biconcave disc", radius);
  const Meridian cell{3.91, {0.5 * 0.81, 0.5 * 7.83, -0.5 * 4.39}};  // micrometres; half the thickness
  return scaled(cell, radius / std::cbrt(volume(cell) / (4.0 / 3.0 * pi)));
}

Meridian spheroid_meridian(double radius, double aspect_ratio) {
  require_radius("spheroid", radius);
  if (!(aspect_ratio >= least_aspect_ratio && aspect_ratio <= greatest_aspect_ratio)) {
    throw std::invalid_argument("spheroid: an aspect ratio of " + std::to_string(aspect_ratio) +
                                " is outside 0.1 .. 10");
  }
  const double rim = radius / std::cbrt(aspect_ratio);
  return {rim, {rim * aspect_ratio, 0, 0}};
}

double spheroid_aspect_ratio(double wanted, Spheroid kind) {
  if (!(wanted >= least_reduced_volume && wanted <= 1)) {
    throw std::invalid_argument("spheroid: a reduced volume of " + std::to_string(wanted) +
                                " is outside 0.5 .. 1");
  }
  if (wanted == 1) return 1;
  // The further from 1, the less: at both bounds of the aspect ratio less than the least reduced volume.
  double near = 1, far = kind == Spheroid::oblate ? least_aspect_ratio : greatest_aspect_ratio;
  constexpr int n_halvings = 60;
  for (int k = 0; k < n_halvings; ++k) {
    const double middle = 0.5 * (near + far);
    (reduced_volume(spheroid_meridian(1, middle)) > wanted ? near : far) = middle;
  }
  return 0.5 * (near + far);
}

double volume(const Meridian& meridian) {
  const auto& [h0, h1, h2] = meridian.heights;
  return 4 * pi * meridian.rim * meridian.rim * (h0 / 3 + 2 * h1 / 15 + 8 * h2 / 105);
}

double surface_area(const Meridian& meridian) {
  double half = 0;
  for (int panel = 0; panel < MeridianLength::n_panels; ++panel) {
    half += integral(panel * panel_width, (panel + 1) * panel_width,
                     [&](double t) { return 2 * pi * meridian.rim * std::sin(t) * speed_at(meridian, t); });
  }
  return 2 * half;
}

double reduced_volume(double volume, double area) {
  return volume / (4.0 / 3.0 * pi * std::pow(area / (4 * pi), 1.5));
}

double reduced_volume(const Meridian& meridian) {
  return reduced_volume(volume(meridian), surface_area(meridian));
}

MeridianPoint point_at(const Meridian& meridian, double t) {
  const auto& [h0, h1, h2] = meridian.heights;
  const double s = std::sin(t), s2 = s * s;
  return {meridian.rim * s, std::cos(t) * (h0 + s2 * (h1 + s2 * h2))};
}

MeridianLength::MeridianLength(const Meridian& meridian) : meridian_(meridian) {
  for (int panel = 0; panel < n_panels; ++panel) {
    to_panel_[panel + 1] = to_panel_[panel] + integral(panel * panel_width, (panel + 1) * panel_width,
                                                       [&](double t) { return speed_at(meridian, t); });
  }
}

double MeridianLength::parameter_at(double share) const {
  const double length = share * total();
  const auto after = std::ranges::upper_bound(to_panel_, length) - to_panel_.begin();
  const int panel = std::clamp(static_cast<int>(after) - 1, 0, n_panels - 1);
  const double begin = panel * panel_width, within = length - to_panel_[panel];
  // Newton's method, from a straight line: the speed hardly changes over a panel.
  double t = begin + panel_width * within / (to_panel_[panel + 1] - to_panel_[panel]);
  constexpr int n_corrections = 4;
  for (int k = 0; k < n_corrections; ++k) {
    const double passed = integral(begin, t, [&](double at) { return speed_at(meridian_, at); });
    t -= (passed - within) / speed_at(meridian_, t);
  }
  return t;
}

}  // namespace tanktread::membrane
