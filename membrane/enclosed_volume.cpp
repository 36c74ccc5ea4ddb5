#include "membrane/enclosed_volume.hpp"

namespace tanktread::membrane {
namespace {

class EnclosedVolume final : public EnergyTerm {
 public:
  EnclosedVolume(double modulus, double reference_volume)
      : modulus_(modulus), reference_volume_(reference_volume) {}

  double energy(const SurfaceMeasures& measures) const override {
    const double excess = measures.volume - reference_volume_;
    return 0.5 * modulus_ * excess * excess / reference_volume_;
  }

  void add_derivatives(const SurfaceMeasures& measures, MeasureDerivatives& derivatives) const override {
    derivatives.volume += modulus_ * (measures.volume - reference_volume_) / reference_volume_;
  }

 private:
  double modulus_, reference_volume_;
};

}  // namespace

std::unique_ptr<EnergyTerm> make_enclosed_volume(const SurfaceMeasures&, const EnergyParameters& parameters) {
  return std::make_unique<EnclosedVolume>(parameters.at("volume_modulus"), parameters.at("reference_volume"));
}

}  // namespace tanktread::membrane
