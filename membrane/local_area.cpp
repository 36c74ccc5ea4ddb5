#include "membrane/local_area.hpp"

namespace tanktread::membrane {
namespace {

class LocalArea final : public EnergyTerm {
 public:
  LocalArea(double modulus, const Eigen::VectorXd& reference_areas)
      : modulus_(modulus), reference_areas_(reference_areas) {}

  double energy(const SurfaceMeasures& measures) const override {
    double sum = 0;
    for (Eigen::Index t = 0; t < reference_areas_.size(); ++t) {
      const double excess = measures.triangle_area[t] - reference_areas_[t];
      sum += excess * excess / reference_areas_[t];
    }
    return 0.5 * modulus_ * sum;
  }

  void add_derivatives(const SurfaceMeasures& measures, MeasureDerivatives& derivatives) const override {
    derivatives.triangle_area.array() +=
        modulus_ * (measures.triangle_area - reference_areas_).array() / reference_areas_.array();
  }

 private:
  double modulus_;
  Eigen::VectorXd reference_areas_;
};

}  // namespace

std::unique_ptr<EnergyTerm> make_local_area(const SurfaceMeasures& reference,
                                            const EnergyParameters& parameters) {
  const double factor = parameters.at("reference_area") / reference.area;
  return std::make_unique<LocalArea>(parameters.at("local_area_modulus"), factor * reference.triangle_area);
}

}  // namespace tanktread::membrane
