// A closed surface whose nodes move keeps the volume that it encloses.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

#include "coupler/volume.hpp"

namespace tanktread::coupler {
namespace {

using Numbers = std::vector<double>;
constexpr double eps = std::numeric_limits<double>::epsilon();

/// An octahedron, far from the origin, and what encloses its volume: 4/3 abc of the half axes.
struct Octahedron {
  static constexpr double half_axes[] = {3.0, 2.0, 4.0}, centre[] = {100.5, -20.25, 7.0};
  Numbers positions;
  std::vector<int> triangles = {0, 2, 4, 2, 1, 4, 1, 3, 4, 3, 0, 4, 2, 0, 5, 1, 2, 5, 3, 1, 5, 0, 3, 5};

  Octahedron() {
    for (int node = 0; node < 6; ++node) {
      for (int axis = 0; axis < 3; ++axis) {
        const double sign = node % 2 == 0 ? 1 : -1;
        positions.push_back(centre[axis] + (axis == node / 2 ? sign * half_axes[axis] : 0));
      }
    }
  }

  /// Of opposite corners that moved along their axes only.
  double volume_after(const Numbers& velocity) const {
    double product = 1;
    for (int axis = 0; axis < 3; ++axis) {
      const int high = 3 * (2 * axis) + axis, low = high + 3;
      product *= positions[high] + velocity[high] - positions[low] - velocity[low];
    }
    return product / 6;
  }
};

TEST(KeepVolume, OfASwellingOctahedron) {
  const Octahedron octahedron;
  Numbers velocity(18, 0.0);
  for (int axis = 0; axis < 3; ++axis) {
    velocity[3 * (2 * axis) + axis] = 1e-3 * (axis + 1);
    velocity[3 * (2 * axis + 1) + axis] = -5e-4;
  }
  const Numbers still(18, 0.0);
  const double before = octahedron.volume_after(still);
  EXPECT_NEAR(before, 32, 1e-11);
  EXPECT_GT(octahedron.volume_after(velocity), before * 1.0005);
  const Numbers asked = velocity;
  keep_volume(octahedron.positions, octahedron.triangles, velocity);
  // The change of the volume is 1e-3 of it, and so is that of its gradient: what is left is 1e-6. Done twice,
  // 1e-9.
  EXPECT_NEAR(octahedron.volume_after(velocity) / before, 1, 2e-6);
  keep_volume(octahedron.positions, octahedron.triangles, velocity);
  EXPECT_NEAR(octahedron.volume_after(velocity) / before, 1, 4e-9);
  // The change is along the gradient: the face's area at the corner of the axis x is half of 2b 2c, a third
  // of which counts, 2 bc/3, and so on; a corner is moved along its axis alone.
  const double bc = 8, ca = 12, ab = 6;
  for (int k = 0; k < 18; ++k) {
    const int axis = k % 3, node = k / 3;
    if (axis == node / 2) continue;
    EXPECT_NEAR(velocity[k], 0, 10 * eps) << k;
  }
  const double along_x = velocity[0] - asked[0], along_y = velocity[7] - asked[7],
               along_z = velocity[14] - asked[14];
  EXPECT_LT(along_x, 0);
  EXPECT_NEAR(along_y / along_x, ca / bc, 1e-9);
  EXPECT_NEAR(along_z / along_x, ab / bc, 1e-9);
}

TEST(KeepVolume, BesideAMotionThatTurnsTheSurface) {
  // A turn by 0.02, which a run has in a hundred steps, and a swelling by 1e-5 of the volume.
  Octahedron octahedron;
  Numbers velocity;
  for (std::size_t k = 0; k < octahedron.positions.size(); k += 3) {
    const double x = octahedron.positions[k] - Octahedron::centre[0],
                 z = octahedron.positions[k + 2] - Octahedron::centre[2];
    velocity.insert(velocity.end(), {0.02 * z, 0, -0.02 * x + 1e-5 * z});
  }
  const auto volume = [&](double factor) {
    Numbers moved = octahedron.positions, none(18, 0.0);
    for (std::size_t k = 0; k < moved.size(); ++k) moved[k] += factor * velocity[k];
    double sum = 0;
    for (std::size_t t = 0; t < octahedron.triangles.size(); t += 3) {
      const double *a = &moved[3 * octahedron.triangles[t]], *b = &moved[3 * octahedron.triangles[t + 1]],
                   *c = &moved[3 * octahedron.triangles[t + 2]];
      sum += a[0] * (b[1] * c[2] - b[2] * c[1]) + a[1] * (b[2] * c[0] - b[0] * c[2]) +
             a[2] * (b[0] * c[1] - b[1] * c[0]);
    }
    return sum / 6;
  };
  const double before = volume(0);
  EXPECT_GT(volume(1), before * (1 + 3e-4));  // a turn of an explicit step swells as well, by 0.02^2
  keep_volume(octahedron.positions, octahedron.triangles, velocity);
  // 4e-4 times the strain, 0.02, squared is 2e-7, of which the even part of a turn is the square again: 1e-9;
  // the sum here rounds at places of 100 by 1e-11.
  EXPECT_NEAR(volume(1) / before, 1, 1e-9);
}

TEST(KeepVolume, LeavesWhatKeepsItByItself) {
  const Octahedron octahedron;
  Numbers shift;
  for (int node = 0; node < 6; ++node) shift.insert(shift.end(), {0.25, -0.125, 0.0625});
  const Numbers asked = shift;
  keep_volume(octahedron.positions, octahedron.triangles, shift);
  // Places lose eps times 100 by the shift; their products, of up to 50, sum up in the change, over gradients
  // of 10.
  for (std::size_t k = 0; k < shift.size(); ++k) EXPECT_NEAR(shift[k], asked[k], 1e4 * eps) << k;
}

TEST(KeepVolume, OneNodeThatIsNotFiniteDoesNotSpoilTheOthers) {
  const Octahedron octahedron;
  Numbers velocity(18, 1e-3);
  velocity[7] = std::nan("");
  keep_volume(octahedron.positions, octahedron.triangles, velocity);
  for (int k = 0; k < 18; ++k) {
    if (k == 7) {
      EXPECT_TRUE(std::isnan(velocity[k]));
    } else {
      EXPECT_EQ(velocity[k], 1e-3) << k;
    }
  }
}

TEST(KeepVolume, RefusesWhatIsNoSurface) {
  Octahedron octahedron;
  Numbers velocity(18), short_velocity(15), nothing;
  EXPECT_THROW(keep_volume(octahedron.positions, octahedron.triangles, short_velocity),
               std::invalid_argument);
  EXPECT_THROW(keep_volume(octahedron.positions, std::vector<int>{0, 1}, velocity), std::invalid_argument);
  EXPECT_THROW(keep_volume(octahedron.positions, std::vector<int>{0, 1, 6}, velocity), std::invalid_argument);
  const Numbers before = velocity;
  keep_volume(octahedron.positions, {}, velocity);
  EXPECT_EQ(velocity, before);
  keep_volume({}, {}, nothing);
}

}  // namespace
}  // namespace tanktread::coupler
