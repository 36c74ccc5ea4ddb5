#include "membrane/global_area.hpp"

namespace tanktread::membrane {
namespace {

class GlobalArea final : public EnergyTerm {
 public:
  GlobalArea(double modulus, double reference_area) : modulus_(modulus), reference_area_(reference_area) {}

  double energy(const SurfaceMeasures& measures) const override {
    const double excess = measures.area - reference_area_;
    return 0.5 * modulus_ * excess * excess / reference_area_;
  }

  void add_derivatives(const SurfaceMeasures& measures, MeasureDerivatives& derivatives) const override {
    derivatives.area += modulus_ * (measures.area - reference_area_) / reference_area_;
  }

 private:
  double modulus_, reference_area_;
};

}  // namespace

std::unique_ptr<EnergyTerm> make_global_area(const SurfaceMeasures&, const EnergyParameters& parameters) {
  return std::make_unique<GlobalArea>(parameters.at("area_modulus"), parameters.at("reference_area"));
}

}  // namespace tanktread::membrane
