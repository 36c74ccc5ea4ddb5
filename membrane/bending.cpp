#include "membrane/bending.hpp"

namespace tanktread::membrane {
namespace {

class Bending final : public EnergyTerm {
 public:
  Bending(double modulus, double spontaneous_curvature)
      : modulus_(modulus), mean_curvature_(0.5 * spontaneous_curvature) {}

  double energy(const SurfaceMeasures& measures) const override {
    double sum = 0;
    for (Eigen::Index node = 0; node < measures.node_area.size(); ++node) {
      const double area = measures.node_area[node];
      const double excess = measures.node_curvature[node] - mean_curvature_ * area;
      sum += excess * excess / area;
    }
    return 2.0 * modulus_ * sum;
  }

  void add_derivatives(const SurfaceMeasures& measures, MeasureDerivatives& derivatives) const override {
    const auto curvature = measures.node_curvature.array() / measures.node_area.array();  // H_i
    derivatives.node_curvature.array() += 4.0 * modulus_ * (curvature - mean_curvature_);
    derivatives.node_area.array() +=
        2.0 * modulus_ * (mean_curvature_ * mean_curvature_ - curvature.square());
  }

  bool depends_on_curvature() const override { return true; }

 private:
  double modulus_;         // kappa_b
  double mean_curvature_;  // c_0/2
};

}  // namespace

std::unique_ptr<EnergyTerm> make_bending(const SurfaceMeasures&, const EnergyParameters& parameters) {
  return std::make_unique<Bending>(parameters.at("bending_modulus"), parameters.at("spontaneous_curvature"));
}

}  // namespace tanktread::membrane
