// What is behind a Membrane, and the work on one block of its elements. Internal to the membrane component.
#pragma once

#include <omp.h>

#include <algorithm>
#include <array>
#include <memory>
#include <optional>
#include <span>
#include <string>

#include "membrane/corners_of_node.hpp"
#include "membrane/element.hpp"
#include "membrane/element_check.hpp"
#include "membrane/membrane.hpp"
#include "membrane/symmetric_tensor.hpp"
#include "membrane/viscous_history.hpp"

namespace tanktread::membrane {

/// Elements go through the law in blocks of this size, whatever the number of threads.
inline constexpr Eigen::Index block_size = 64;

struct ElementBlock {
  Eigen::Index begin = 0, size = 0;  ///< first element, number of elements
  std::array<SurfaceGradient, block_size> gradient;
  std::array<SymmetricTensor, block_size> cauchy_green;
  std::array<Invariants, block_size> invariants;
  std::array<ElasticResponse, block_size> response;

  SymmetricTensor elastic_stress(Eigen::Index k) const {
    return second_piola_kirchhoff(cauchy_green[k], response[k]);
  }
};

struct Membrane::Implementation {
  Implementation(TriangleMesh mesh, std::shared_ptr<const ElasticLaw> elastic_law,
                 std::shared_ptr<const ViscousLaw> viscous_law, int threads)
      : n_threads(threads > 0 ? threads : omp_get_max_threads()),
        reference(std::move(mesh)),
        law(std::move(elastic_law)),
        corners_of_node(reference.triangles, reference.points.cols()),
        positions(reference.points),
        corner_force(3, reference.triangles.size()),
        node_force(3, reference.points.cols()),
        check(reference.triangles.cols()) {
    for (Eigen::Index t = 0; t < n_elements(); ++t) {
      elements.push_back(reference_element(corners(t)));
      check.normals().col(t) = area_normal(corners(t));
    }
    if (viscous_law) viscous.emplace(std::move(viscous_law), n_elements());
  }

  Eigen::Index n_elements() const { return reference.triangles.cols(); }
  Eigen::Index n_blocks() const { return (n_elements() + block_size - 1) / block_size; }

  Eigen::Index end_of_block(Eigen::Index number) const {
    return std::min((number + 1) * block_size, n_elements());
  }

  Eigen::Matrix3d corners(Eigen::Index t) const { return corners_of(positions, reference.triangles.col(t)); }

  /// Strain of the elements of block `number`, and what the law answers to it.
  ElementBlock evaluated(Eigen::Index number) const {
    ElementBlock block;
    block.begin = number * block_size;
    block.size = end_of_block(number) - block.begin;
    for (Eigen::Index k = 0; k < block.size; ++k) {
      const Eigen::Index t = block.begin + k;
      block.gradient[k] = deformation_gradient(corners(t), elements[t]);
      block.cauchy_green[k] = cauchy_green(block.gradient[k]);
      block.invariants[k] = invariants(block.cauchy_green[k]);
    }
    const auto size = static_cast<std::size_t>(block.size);
    law->evaluate_all(std::span(block.invariants).first(size), std::span(block.response).first(size));
    return block;
  }

  /// Viscous part of the second Piola-Kirchhoff stress of element `t`, from its history.
  SymmetricTensor viscous_stress(Eigen::Index t, const SymmetricTensor& cauchy_green) const {
    return pulled_back(viscous->stress(t), right_stretch(cauchy_green));
  }

  /// Writes the elastic forces on the corners of the elements of block `number`.
  void elastic_corner_forces(Eigen::Index number, Eigen::Matrix3Xd& forces) const {
    const ElementBlock block = evaluated(number);
    for (Eigen::Index k = 0; k < block.size; ++k) {
      const Eigen::Index t = block.begin + k;
      forces.middleCols<3>(3 * t) = corner_forces(block.gradient[k], block.elastic_stress(k), elements[t]);
    }
  }

  /// The same into `corner_force`, of the total stress of a viscous membrane, after the history of the
  /// elements has taken their new strain.
  void next_corner_forces(Eigen::Index number) {
    const ElementBlock block = evaluated(number);
    for (Eigen::Index k = 0; k < block.size; ++k) {
      const Eigen::Index t = block.begin + k;
      const SymmetricTensor& c = block.cauchy_green[k];
      viscous->take(t, 0.5 * (c - unit_tensor));
      const SymmetricTensor stress = block.elastic_stress(k) + viscous_stress(t, c);
      corner_force.middleCols<3>(3 * t) = corner_forces(block.gradient[k], stress, elements[t]);
    }
  }

  /// Shows the elements of block `number` to the check. False if one of them is bad.
  bool check_block(Eigen::Index number) {
    bool good = true;
    for (Eigen::Index t = number * block_size; t < end_of_block(number); ++t)
      good &= check.take(t, corners(t), elements[t].area);
    return good;
  }

  /// @throws InvertedElement for the first bad element of a block that has one
  [[noreturn]] void report_block(Eigen::Index number) {
    for (Eigen::Index t = number * block_size; t < end_of_block(number); ++t) {
      if (!check.take(t, corners(t), elements[t].area))
        check.report(t, reference.triangles.col(t), corners(t), elements[t].area);
    }
    throw std::logic_error("membrane: a block without a bad element was refused");
  }

  /// Measures the triangles of block `number` for the energy terms.
  void measure_for_terms(Eigen::Index number) {
    for (int block = first_term_block(number); block < first_term_block(number + 1); ++block)
      terms->measure_block(positions, block);
  }

  /// Finds the forces of the energy terms on the corners of its elements.
  void find_term_forces(Eigen::Index number) {
    for (int block = first_term_block(number); block < first_term_block(number + 1); ++block)
      terms->find_corner_forces(block);
  }

  /// The blocks of the energy terms are smaller, and some of them make one of elements.
  int first_term_block(Eigen::Index number) const {
    static_assert(block_size % EnergyTerms::block_size == 0);
    return static_cast<int>(
        std::min<Eigen::Index>(number * (block_size / EnergyTerms::block_size), terms->n_blocks()));
  }

  void require_column_per_node(const std::string& what, Eigen::Index n_columns) const {
    if (n_columns != positions.cols()) {
      throw std::invalid_argument("membrane: " + what + " has " + std::to_string(n_columns) +
                                  " columns, must have one for each of the " +
                                  std::to_string(positions.cols()) + " nodes");
    }
  }

  int n_threads;
  TriangleMesh reference;
  std::shared_ptr<const ElasticLaw> law;
  CornersOfNode corners_of_node;
  std::vector<ReferenceElement> elements;
  Eigen::Matrix3Xd positions;
  Eigen::Matrix3Xd corner_force;  ///< scratch, a column a corner
  Eigen::Matrix3Xd node_force;    ///< scratch of add_forces()
  ElementCheck check;
  std::optional<ViscousHistory> viscous;
  std::unique_ptr<EnergyTerms> terms;  ///< null: none
};

}  // namespace tanktread::membrane
