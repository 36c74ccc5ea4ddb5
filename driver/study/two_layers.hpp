// The exact steady flow of two liquids between parallel walls.
#pragma once

namespace tanktread::driver {

/// Two liquids, one above the other, between a wall at rest at z = 0 and one that moves along x at z =
/// height; a flat sheet without a force lies between them. Everything in the same units, the lattice's or
/// any.
struct TwoLayers {
  double height;             ///< H
  double sheet;              ///< where the liquids meet, 0 to H
  double viscosity_below;    ///< dynamic
  double viscosity_above;    ///< dynamic
  double wall_velocity = 0;  ///< U, of the upper wall
  double force = 0;          ///< F, along x, a volume

  /// The velocity along x at a height between the walls. The shear stress mu du/dz = t - F z is continuous,
  /// so
  ///   u = t C(z) - F Z(z),   C = int_0^z dz/mu,   Z = int_0^z z dz/mu,   t = (U + F Z(H))/C(H):
  /// slopes 1 : mu_below/mu_above without a force, and a parabola in each liquid with one.
  double velocity(double z) const;

  /// The largest speed between the walls: at the upper wall, or where the shear stress vanishes.
  double largest_speed() const;

 private:
  double compliance(double z) const;         // C
  double compliance_moment(double z) const;  // Z
  double stress_at_lower_wall() const;       // t
};

}  // namespace tanktread::driver
