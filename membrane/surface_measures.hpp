// What an energy of a closed surface may depend on, and its derivatives by that.
#pragma once

#include <Eigen/Core>

namespace tanktread::membrane {

/// Measures of a closed surface of triangles, in the unit of its points.
struct SurfaceMeasures {
  double area = 0;                ///< A, the sum over the triangles
  double volume = 0;              ///< V, enclosed
  Eigen::VectorXd triangle_area;  ///< A_t, an entry a triangle
  Eigen::VectorXd node_area;      ///< A_i, a third of the area of the triangles of a node
  /// M_i, the integral of the mean curvature over a node's share of the surface, a fourth of the sum of
  /// length times angle over its edges (Juelicher 1996, doi:10.1051/jp2:1996178). The angle of an edge is the
  /// one between the normals of its two triangles, positive where the surface is convex: of a sphere the
  /// mean curvature is 1/R.
  Eigen::VectorXd node_curvature;
};

/// Derivatives of an energy by the measures, each as the measure is.
struct MeasureDerivatives {
  double area = 0;
  double volume = 0;
  Eigen::VectorXd triangle_area;
  Eigen::VectorXd node_area;
  Eigen::VectorXd node_curvature;

  void set_zero() {
    area = volume = 0;
    triangle_area.setZero();
    node_area.setZero();
    node_curvature.setZero();
  }
};

}  // namespace tanktread::membrane
