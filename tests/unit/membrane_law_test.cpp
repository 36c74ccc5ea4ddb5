// Every elastic law of the list by itself: stress at homogeneous strain against closed forms, and moduli.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "membrane/element.hpp"
#include "unit/membrane_law_list.hpp"
#include "unit/membrane_support.hpp"

namespace tanktread::membrane::test {
namespace {

class ElasticLawTest : public testing::TestWithParam<LawRow> {
 protected:
  const LawRow& row = GetParam();
  std::shared_ptr<const ElasticLaw> law = make_elastic_law(row.name, row.parameters);

  /// Principal Cauchy stresses of the library at principal stretches along the axes of the element.
  Eigen::Vector2d stress_at(double lambda1, double lambda2) const {
    SurfaceGradient gradient = SurfaceGradient::Zero();
    gradient(0, 0) = lambda1;
    gradient(1, 1) = lambda2;
    const auto c = cauchy_green(gradient);
    const auto stress = cauchy_stress(gradient, second_piola_kirchhoff(c, law->evaluate(invariants(c))));
    EXPECT_EQ(stress(0, 1), 0.0);
    return {stress(0, 0), stress(1, 1)};
  }

  /// Some 30 roundings from the stretches (exact here) to the stress, each of a quantity that the
  /// sensitivity bounds.
  double rounding_at(double a, double b) const {
    return 30 * epsilon * (stress_sensitivity(row, a, b) + stress_sensitivity(row, b, a));
  }
};

TEST_P(ElasticLawTest, HasTheStressesWorkedOutByHand) {
  const Eigen::Vector2d uniaxial = stress_at(2, 1), equibiaxial = stress_at(2, 2);
  EXPECT_NEAR(uniaxial[0], row.uniaxial_2_1[0], rounding_at(2, 1));
  EXPECT_NEAR(uniaxial[1], row.uniaxial_2_1[1], rounding_at(2, 1));
  EXPECT_NEAR(equibiaxial[0], row.equibiaxial_2_2, rounding_at(2, 2));
  EXPECT_NEAR(equibiaxial[1], row.equibiaxial_2_2, rounding_at(2, 2));
}

TEST_P(ElasticLawTest, FollowsTheClosedFormFromCompressionToLargeStretch) {
  for (const double a : {0.6, 0.9, 1.0, 1.3, 2.5}) {
    for (const double b : {0.6, 0.9, 1.0, 1.3, 2.5}) {
      const Eigen::Vector2d stress = stress_at(a, b);
      EXPECT_NEAR(stress[0], row.principal_stress(row.parameters, a, b), rounding_at(a, b)) << a << " " << b;
      EXPECT_NEAR(stress[1], row.principal_stress(row.parameters, b, a), rounding_at(a, b)) << a << " " << b;
    }
  }
}

// All faces of a cube at once, in a frame that is turned: the stretches along the three edges are a, b and c,
// and a face carries the stress of the two that lie in it.
TEST_P(ElasticLawTest, PutsTheStressIntoSpaceOnTheFacesOfACube) {
  const auto box = cube(2.0);
  Membrane membrane(box.mesh, law, 1);
  const Eigen::Vector3d stretch(1.4, 0.8, 1.1);
  const Eigen::Matrix3d turn = rotation({1, -2, 0.5}, 1.1);
  membrane.set_positions(turn * stretch.asDiagonal() * box.mesh.points);
  const auto fields = membrane.element_fields();
  const double strain_rounding = gradient_rounding(box.mesh, membrane.positions());
  for (int t = 0; t < membrane.n_triangles(); ++t) {
    const int normal = box.face_axis[t], i = (normal + 1) % 3, j = (normal + 2) % 3;
    Eigen::Vector3d principal = Eigen::Vector3d::Zero();
    principal[i] = row.principal_stress(row.parameters, stretch[i], stretch[j]);
    principal[j] = row.principal_stress(row.parameters, stretch[j], stretch[i]);
    const Eigen::Matrix3d expected = turn * principal.asDiagonal() * turn.transpose();
    const Eigen::Matrix3d actual =
        Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(fields.stress.col(t).data());
    // 4: two strain entries of a stretch, and the two factors F that carry the stress into space.
    const double bound =
        rounding_at(stretch[i], stretch[j]) + 4 * strain_rounding *
                                                  (stress_sensitivity(row, stretch[i], stretch[j]) +
                                                   stress_sensitivity(row, stretch[j], stretch[i]));
    EXPECT_LE((actual - expected).cwiseAbs().maxCoeff(), bound) << "element " << t;
    EXPECT_NEAR(fields.principal_stretches(0, t), std::max(stretch[i], stretch[j]), 4 * strain_rounding);
    EXPECT_NEAR(fields.principal_stretches(1, t), std::min(stretch[i], stretch[j]), 4 * strain_rounding);
    EXPECT_NEAR(fields.area_ratio[t], stretch[i] * stretch[j], 8 * strain_rounding);
  }
}

// G_s and K_s from the slope of the stress at rest: at lambda1 = 1 + e, lambda2 = 1/(1 + e) the stress
// difference is 4 G_s e, and at lambda1 = lambda2 = 1 + e the mean stress is 2 K_s e (area strain 2 e).
// Central differences, h = cbrt(eps): a truncation of h^2/6 times the third derivative, which at rest is
// largest for neo-Hookean, 336 G_s = 84 (G_s + K_s), and a rounding of the stress, 30 eps (G_s + K_s +
// gamma), over h.
TEST_P(ElasticLawTest, HasTheModuliOfItsSlopeAtRest) {
  const double h = std::cbrt(epsilon), scale = row.shear_modulus + row.area_modulus + row.tension_at_rest;
  const double bound = scale * (100.0 / 6.0 * h * h + 30 * epsilon / h);
  const auto difference = [&](double e) {
    const Eigen::Vector2d stress = stress_at(1 + e, 1 / (1 + e));
    return stress[0] - stress[1];
  };
  EXPECT_NEAR((difference(h) - difference(-h)) / (8 * h), row.shear_modulus, bound);
  EXPECT_NEAR((stress_at(1 + h, 1 + h)[0] - stress_at(1 - h, 1 - h)[0]) / (4 * h), row.area_modulus, bound);
  EXPECT_NEAR(law->shear_modulus(), row.shear_modulus, 4 * epsilon * row.shear_modulus);
  EXPECT_NEAR(law->area_modulus(), row.area_modulus, 4 * epsilon * row.area_modulus);
}

// W_1 and W_2 are the derivatives of W: central differences in the invariants, bound as above. Of the third
// derivatives at these strains the largest is that of neo-Hookean at I2 = -0.5, 3 G_s/(1 + I2)^4 =
// 12 (G_s + K_s); W itself is below 10 (G_s + K_s + gamma) and rounds by some 4 epsilon.
TEST_P(ElasticLawTest, AnswersTheDerivativesOfItsEnergy) {
  const double h = std::cbrt(epsilon), scale = row.shear_modulus + row.area_modulus + row.tension_at_rest;
  const double bound = scale * (12.0 / 6.0 * h * h + 40 * epsilon / h);
  for (const Invariants at :
       {Invariants{0, 0}, Invariants{0.7, 0.3}, Invariants{-0.3, -0.5}, Invariants{2, 1.5}}) {
    const auto response = law->evaluate(at);
    const auto energy = [&](double di1, double di2) {
      return law->evaluate({at.i1 + di1, at.i2 + di2}).energy;
    };
    EXPECT_NEAR((energy(h, 0) - energy(-h, 0)) / (2 * h), response.w1, bound);
    EXPECT_NEAR((energy(0, h) - energy(0, -h)) / (2 * h), response.w2, bound);
  }
}

TEST_P(ElasticLawTest, AnswersManyElementsAsItAnswersOne) {
  const std::vector<Invariants> strains = {{0, 0}, {0.7, 0.3}, {-0.3, -0.5}, {2, 1.5}, {0.1, 0.1}};
  std::vector<ElasticResponse> responses(strains.size());
  law->evaluate_all(strains, responses);
  for (std::size_t k = 0; k < strains.size(); ++k) {
    const auto one = law->evaluate(strains[k]);
    EXPECT_NEAR(responses[k].energy, one.energy, 30 * epsilon * std::abs(one.energy));
    EXPECT_NEAR(responses[k].w1, one.w1, 30 * epsilon * std::abs(one.w1));
    EXPECT_NEAR(responses[k].w2, one.w2, 30 * epsilon * std::abs(one.w2));
  }
}

INSTANTIATE_TEST_SUITE_P(EveryLaw, ElasticLawTest, testing::ValuesIn(law_list()),
                         [](const auto& named) { return test_name(named.param); });

TEST(ElasticLawTable, HasATestRowForEveryLaw) {
  std::vector<std::string> tested, known;
  for (const auto& row : law_list()) tested.push_back(row.name);
  for (const auto& entry : elastic_law_table()) known.push_back(entry.name);
  EXPECT_THAT(tested, testing::UnorderedElementsAreArray(known));
}

TEST(ElasticLawTable, ListsTheKnownNamesWhenOneIsUnknown) {
  try {
    make_elastic_law("skallak", {});
    FAIL() << "an unknown law must be refused";
  } catch (const std::invalid_argument& error) {
    EXPECT_THAT(error.what(), testing::HasSubstr("'skallak'"));
    for (const auto& entry : elastic_law_table()) EXPECT_THAT(error.what(), testing::HasSubstr(entry.name));
  }
}

struct RefusedParameters {
  std::string law;
  ElasticParameters parameters;
  std::string message;
};

TEST(ElasticLawTable, RefusesParametersOutOfRangeWithNameValueAndRange) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const std::vector<RefusedParameters> list = {
      {"skalak", {.shear_modulus = 0}, "skalak: shear_modulus is 0.000000, must be positive"},
      {"skalak", {.shear_modulus = nan}, "skalak: shear_modulus is nan, must be positive"},
      {"skalak",
       {.shear_modulus = 1, .area_ratio = -1},
       "skalak: area_ratio is -1.000000, must be 0 or positive"},
      {"neo-hookean", {.shear_modulus = -2}, "neo-hookean: shear_modulus is -2.000000, must be positive"},
      {"hookean", {.shear_modulus = 0}, "hookean: shear_modulus is 0.000000, must be positive"},
      {"hookean",
       {.shear_modulus = 1, .poisson_ratio = 1},
       "hookean: poisson_ratio is 1.000000, must be above -1 and below 1"},
      {"interfacial-tension",
       {.interfacial_tension = 0},
       "interfacial-tension: interfacial_tension is 0.000000, must be positive"},
  };
  for (const auto& refused : list) {
    try {
      make_elastic_law(refused.law, refused.parameters);
      ADD_FAILURE() << "must be refused: " << refused.message;
    } catch (const std::invalid_argument& error) {
      EXPECT_EQ(std::string(error.what()), "elastic law " + refused.message);
    }
  }
}

}  // namespace
}  // namespace tanktread::membrane::test
