#include "core/sim/particle_fields.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

#include "core/base/parallel.h"
#include "core/forces/element.h"
#include "core/state/state.h"

namespace flexcast {
namespace {

constexpr std::int64_t grain = 512;  // elements

// The largest singular value of F, minus 1: from the eigenvalues of F^T F - I, so that small strains keep their digits.
double calc_largest_strain(const Mat3& F) {
  Eigen::SelfAdjointEigenSolver<Mat3> solver;
  solver.computeDirect(F.transpose() * F - Mat3::Identity(), Eigen::EigenvaluesOnly);
  const double squared = std::max(solver.eigenvalues()[2], -1.0);
  return squared / (1.0 + std::sqrt(1.0 + squared));
}

// Without sign, as the stress of an element that is inside out is not less.
double calc_von_mises(const Mat3& P, const Mat3& F, bool small_strain) {
  Mat3 stress = P;
  if (!small_strain) stress = P * F.transpose() / std::abs(F.determinant());
  const Mat3 deviator = stress - stress.trace() / 3.0 * Mat3::Identity();
  return std::sqrt(1.5) * deviator.norm();
}

template <std::size_t N>
double calc_mean_strain(const std::array<Mat3, N>& F) {
  double sum = 0.0;
  for (const Mat3& at_point : F) sum += calc_largest_strain(at_point);
  return sum / N;
}

template <std::size_t N>
double calc_mean_stress(const Body& body, const std::array<Mat3, N>& F) {
  std::array<Mat3, N> P;
  body.law->calc_stress(calc_lame(body.young, body.poisson), F, P);
  double sum = 0.0;
  for (std::size_t q = 0; q < N; ++q) sum += calc_von_mises(P[q], F[q], body.law->small_strain);
  return sum / N;
}

template <class Shape>
void add_to_nodes(const Model& model, const Body& body, std::int32_t t, double value, VecX& field) {
  for (const std::int32_t node : make_nodes<Shape>(model, body, t)) field[node] += value;
}

}  // namespace

ParticleFields::ParticleFields(const Model& model) : model_(model), weights_(VecX::Zero(model.particle_count())) {
  for (const Body& body : model.bodies) {
    for (std::int32_t t = 0; t < body.tetrahedra.count; ++t) {
      const double volume = calc_rest_shape(model, body, t).volume;
      if (body.is_quadratic()) {
        add_to_nodes<QuadraticShape>(model, body, t, volume, weights_);
      } else {
        add_to_nodes<LinearShape>(model, body, t, volume, weights_);
      }
    }
    for (std::int32_t s = body.springs.first; s < body.springs.end(); ++s) {
      for (const std::int32_t node : model.springs[static_cast<std::size_t>(s)]) weights_[node] += 1.0;
    }
  }
}

void ParticleFields::calc_stretch(const VecX& positions, VecX& stretch) {
  stretch.setZero(model_.particle_count());
  for (const Body& body : model_.bodies) {
    add_tetrahedra(
        body, positions, [](const auto& F) { return calc_mean_strain(F); }, stretch);
    add_springs(body, positions, stretch);
  }
  finish(stretch);
}

void ParticleFields::calc_stress(const VecX& positions, VecX& stress) {
  stress.setZero(model_.particle_count());
  for (const Body& body : model_.bodies) {
    add_tetrahedra(
        body, positions, [&](const auto& F) { return calc_mean_stress(body, F); }, stress);
  }
  finish(stress);
}

template <class Measure>
void ParticleFields::add_tetrahedra(const Body& body, const VecX& positions, Measure measure, VecX& field) {
  if (body.is_quadratic()) {
    add_elements<QuadraticShape>(body, positions, measure, field);
  } else {
    add_elements<LinearShape>(body, positions, measure, field);
  }
}

// Elements by threads, sums in the order of the elements.
template <class Shape, class Measure>
void ParticleFields::add_elements(const Body& body, const VecX& positions, Measure measure, VecX& field) {
  values_.resize(static_cast<std::size_t>(body.tetrahedra.count));
  parallel_for(body.tetrahedra.count, grain, [&](std::int64_t first, std::int64_t end) {
    for (std::int64_t t = first; t < end; ++t) {
      const auto element = make_element<Shape>(model_, body, static_cast<std::int32_t>(t));
      std::array<Mat3, Shape::points> F;
      element.calc_gradients(positions, F);
      values_[static_cast<std::size_t>(t)] = measure(F) * element.weight * Shape::points;
    }
  });
  for (std::int32_t t = 0; t < body.tetrahedra.count; ++t) {
    add_to_nodes<Shape>(model_, body, t, values_[static_cast<std::size_t>(t)], field);
  }
}

void ParticleFields::add_springs(const Body& body, const VecX& positions, VecX& field) {
  for (std::int32_t s = body.springs.first; s < body.springs.end(); ++s) {
    const auto [p, q] = model_.springs[static_cast<std::size_t>(s)];
    const double rest = (block3(model_.rest_positions, q) - block3(model_.rest_positions, p)).norm();
    const double value = (block3(positions, q) - block3(positions, p)).norm() / rest - 1.0;
    field[p] += value;
    field[q] += value;
  }
}

// The comparison is false for what is not a number, too.
void ParticleFields::finish(VecX& field) const {
  for (Eigen::Index i = 0; i < field.size(); ++i) {
    if (weights_[i] == 0.0) continue;
    const double mean = field[i] / weights_[i];
    field[i] = mean <= largest_magnitude ? mean : largest_magnitude;
  }
}

}  // namespace flexcast
