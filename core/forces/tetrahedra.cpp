#include "core/forces/tetrahedra.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "core/forces/element.h"
#include "core/forces/element_modes.h"
#include "core/forces/incidences.h"
#include "core/forces/kelvin_voigt.h"

namespace flexcast {
namespace {

template <class Shape>
class Tetrahedra final : public Force {
 public:
  Tetrahedra(const Model& model, const Body& body);

  bool is_active() const override { return true; }
  bool has_damping() const override { return body_.stiffness_damping > 0.0; }
  EnergyKind energy_kind() const override { return EnergyKind::elastic; }
  void add_conservative(const VecX& x, VecX& f) const override;
  double add_damping(const VecX& x, const VecX& v, VecX& f) const override;
  double calc_energy(const VecX& x) const override;
  void add_couplings(std::vector<std::pair<std::int32_t, std::int32_t>>& pairs) const override;
  void add_stiffness(const VecX& x, double scale, Tangent kind, BlockMatrix& A) const override;
  void add_damping_matrix(const VecX& x, double scale, BlockMatrix& A) const override;
  void add_blocks(const VecX& x, std::span<const std::int32_t> particles, std::span<Vec3> f,
                  std::span<Mat3> K) const override;
  void add_damping_blocks(const VecX& x, const VecX& v, double scale, std::span<const std::int32_t> particles,
                          std::span<Vec3> f, std::span<Mat3> K) const override;
  std::int64_t constraint_count() const override { return static_cast<std::int64_t>(elements_.size()); }
  void sweep_constraints(const ConstraintSweep& sweep, std::span<double> lambda, VecX& x) const override;
  std::int32_t body() const override { return static_cast<std::int32_t>(&body_ - model_.bodies.data()); }
  ModeBound calc_mode_bound() const override;

 private:
  static constexpr std::size_t points = Shape::points;
  static constexpr std::size_t batch_size = 32;  // quadrature points
  using Element = flexcast::Element<Shape>;

  Lame lame() const { return calc_lame(body_.young, body_.poisson); }
  Lame damping_lame() const {
    const Lame elastic = lame();
    return {body_.stiffness_damping * elastic.mu, body_.stiffness_damping * elastic.lambda};
  }
  bool small_strain() const { return body_.law->small_strain; }

  // Calls visit(first, F) for every run of elements that fills at most a batch, with their deformation gradients.
  template <class Visit>
  void for_batches(const VecX& x, Visit visit) const {
    std::array<Mat3, batch_size> F;
    for (std::size_t first = 0; first < elements_.size(); first += batch_size / points) {
      const std::size_t count = std::min(batch_size / points, elements_.size() - first);
      for (std::size_t i = 0; i < count; ++i) elements_[first + i].calc_gradients(x, of_element(F, i));
      visit(first, std::span<const Mat3>(F.data(), points * count));
    }
  }
  // The values at the points of a batch's element number i.
  template <class T>
  static std::span<T, points> of_element(std::array<T, batch_size>& values, std::size_t i) {
    return std::span<T, points>(values.data() + points * i, points);
  }
  // Calls visit(i, element, node) for every element at particles[i].
  template <class Visit>
  void for_incidences(std::span<const std::int32_t> particles, Visit visit) const {
    if (!incidences_) incidences_.emplace(body_.particles, elements_);
    for (std::size_t i = 0; i < particles.size(); ++i) {
      for (const auto& [element, node] : incidences_->at(particles[i])) {
        visit(i, elements_[static_cast<std::size_t>(element)], node);
      }
    }
  }
  void project(const Element& e, Lame elastic, const ConstraintSweep& sweep, double& lambda, VecX& x) const;

  const Model& model_;
  const Body& body_;
  std::vector<Element> elements_;
  mutable std::optional<Incidences> incidences_;  // made when blocks are first asked for, by one thread
};

template <class Shape>
Tetrahedra<Shape>::Tetrahedra(const Model& model, const Body& body) : model_(model), body_(body) {
  elements_.reserve(static_cast<std::size_t>(body.tetrahedra.count));
  for (std::int32_t t = 0; t < body.tetrahedra.count; ++t) elements_.push_back(make_element<Shape>(model, body, t));
}

template <class Shape>
void Tetrahedra<Shape>::add_conservative(const VecX& x, VecX& f) const {
  const Lame elastic = lame();
  std::array<Mat3, batch_size> P;
  for_batches(x, [&](std::size_t first, std::span<const Mat3> F) {
    body_.law->calc_stress(elastic, F, {P.data(), F.size()});
    for (std::size_t i = 0; i < F.size() / points; ++i) {
      add_stress_forces<Shape>(elements_[first + i], of_element(P, i), f);
    }
  });
}

template <class Shape>
double Tetrahedra<Shape>::add_damping(const VecX& x, const VecX& v, VecX& f) const {
  const Lame viscosity = damping_lame();
  const bool small = small_strain();
  std::array<Mat3, points> F, rate, P;
  double power = 0.0;
  for (const Element& e : elements_) {
    e.calc_gradients(x, F);
    e.calc_gradients(v, rate);
    for (std::size_t q = 0; q < points; ++q) {
      P[q] = calc_kelvin_voigt_stress(viscosity, small, F[q], rate[q]);
      power += e.weight * P[q].cwiseProduct(rate[q]).sum();
    }
    add_stress_forces<Shape>(e, P, f);
  }
  return power;
}

template <class Shape>
double Tetrahedra<Shape>::calc_energy(const VecX& x) const {
  const Lame elastic = lame();
  std::array<double, batch_size> Psi;
  double energy = 0.0;
  for_batches(x, [&](std::size_t first, std::span<const Mat3> F) {
    body_.law->calc_energy(elastic, F, {Psi.data(), F.size()});
    for (std::size_t i = 0; i < F.size(); ++i) energy += elements_[first + i / points].weight * Psi[i];
  });
  return energy;
}

template <class Shape>
void Tetrahedra<Shape>::add_couplings(std::vector<std::pair<std::int32_t, std::int32_t>>& pairs) const {
  for (const Element& e : elements_) {
    for (std::size_t a = 0; a < e.nodes.size(); ++a) {
      for (std::size_t b = a + 1; b < e.nodes.size(); ++b) pairs.emplace_back(e.nodes[a], e.nodes[b]);
    }
  }
}

template <class Shape>
void Tetrahedra<Shape>::add_stiffness(const VecX& x, double scale, Tangent kind, BlockMatrix& A) const {
  const Lame elastic = lame();
  std::array<Mat9, batch_size> C;
  for_batches(x, [&](std::size_t first, std::span<const Mat3> F) {
    body_.law->calc_tangent(elastic, kind, F, {C.data(), F.size()});
    for (std::size_t i = 0; i < F.size() / points; ++i) {
      add_tangent_blocks<Shape>(elements_[first + i], of_element(C, i), scale, A);
    }
  });
}

template <class Shape>
void Tetrahedra<Shape>::add_damping_matrix(const VecX& x, double scale, BlockMatrix& A) const {
  if (!has_damping()) return;
  const Lame viscosity = damping_lame();
  std::array<Mat3, points> F;
  std::array<Mat9, points> C;
  for (const Element& e : elements_) {
    e.calc_gradients(x, F);
    for (std::size_t q = 0; q < points; ++q) C[q] = calc_kelvin_voigt_tangent(viscosity, small_strain(), F[q]);
    add_tangent_blocks<Shape>(e, C, scale, A);
  }
}

template <class Shape>
void Tetrahedra<Shape>::add_blocks(const VecX& x, std::span<const std::int32_t> particles, std::span<Vec3> f,
                                   std::span<Mat3> K) const {
  const Lame elastic = lame();
  std::array<Mat3, points> F, P;
  std::array<Mat9, points> C;
  for_incidences(particles, [&](std::size_t i, const Element& e, std::int32_t node) {
    e.calc_gradients(x, F);
    body_.law->calc_stress(elastic, F, P);
    body_.law->calc_tangent(elastic, Tangent::positive_semidefinite, F, C);
    for (std::size_t q = 0; q < points; ++q) {
      const Vec3 g = e.calc_gradient(q, node);
      f[i] -= e.weight * P[q] * g;
      K[i] += e.weight * contract_left(g, contract_right(C[q], g));
    }
  });
}

template <class Shape>
void Tetrahedra<Shape>::add_damping_blocks(const VecX& x, const VecX& v, double scale,
                                           std::span<const std::int32_t> particles, std::span<Vec3> f,
                                           std::span<Mat3> K) const {
  if (!has_damping()) return;
  const Lame viscosity = damping_lame();
  std::array<Mat3, points> F, rate;
  for_incidences(particles, [&](std::size_t i, const Element& e, std::int32_t node) {
    e.calc_gradients(x, F);
    e.calc_gradients(v, rate);
    for (std::size_t q = 0; q < points; ++q) {
      const Vec3 g = e.calc_gradient(q, node);
      f[i] -= e.weight * calc_kelvin_voigt_stress(viscosity, small_strain(), F[q], rate[q]) * g;
      for (int k = 0; k < 3; ++k) {
        const Mat3 unit = Vec3::Unit(k) * g.transpose();  // the node moves along axis k, the others rest
        K[i].col(k) += scale * e.weight * calc_kelvin_voigt_stress(viscosity, small_strain(), F[q], unit) * g;
      }
    }
  });
}

template <class Shape>
void Tetrahedra<Shape>::sweep_constraints(const ConstraintSweep& sweep, std::span<double> lambda, VecX& x) const {
  const Lame elastic = lame();
  for (std::size_t i = 0; i < elements_.size(); ++i) project(elements_[i], elastic, sweep, lambda[i], x);
}

// One constraint of compliance 1 an element, C = sqrt(2 U) with U its energy, so that C^2 / 2 = U and -C grad C = f:
//   dlambda = (-s C - lambda - s_d grad C . (x - start)) / ((s + s_d) W + 1),   x_i += w_i grad C_i dlambda
// with s = h^2, s_d = h beta, W = sum_i w_i |grad C_i|^2: equations 18 and 26 of the source times h^2. Converged sweeps
// have lambda = -s C, and are the backward Euler step as far as grad C keeps its direction on the way there: to the
// order (h omega)^2. Damping acts on the rate of C alone, so it takes at most what Kelvin-Voigt damping of the same
// beta does near the rest shape. An element whose move would not be finite stays. Source: M. Macklin, M. Mueller, N.
// Chentanez, XPBD: Position-based simulation of compliant constrained dynamics, Motion in Games 2016.
template <class Shape>
void Tetrahedra<Shape>::project(const Element& e, Lame elastic, const ConstraintSweep& sweep, double& lambda,
                                VecX& x) const {
  std::array<Mat3, points> F, P;
  std::array<double, points> Psi;
  e.calc_gradients(x, F);
  body_.law->calc_energy(elastic, F, Psi);
  double U = 0.0;
  for (const double density : Psi) U += e.weight * density;
  if (!(U > 0.0)) return;
  body_.law->calc_stress(elastic, F, P);
  const double C = std::sqrt(2.0 * U);
  const typename Element::NodeVectors grad_C = e.calc_node_slopes(P) / C;

  const double s = sweep.h * sweep.h;
  const double s_d = sweep.h * body_.stiffness_damping;
  typename Element::NodeVectors move;
  double W = 0.0, change = 0.0;
  for (int a = 0; a < Shape::nodes; ++a) {
    const std::int32_t node = e.nodes[static_cast<std::size_t>(a)];
    move.col(a) = block3(sweep.inverse_masses, node).cwiseProduct(grad_C.col(a));
    W += move.col(a).dot(grad_C.col(a));
    if (s_d > 0.0) change += grad_C.col(a).dot(block3(x, node) - block3(sweep.start, node));
  }
  const double dlambda = (-s * C - lambda - s_d * change) / ((s + s_d) * W + 1.0);
  move *= dlambda;
  if (!std::isfinite(dlambda) || !move.allFinite()) return;
  lambda += dlambda;
  for (int a = 0; a < Shape::nodes; ++a) block3(x, e.nodes[static_cast<std::size_t>(a)]) += move.col(a);
}

template <class Shape>
ModeBound Tetrahedra<Shape>::calc_mode_bound() const {
  const double omega_squared = calc_omega_squared_bound(elements_, lame(), model_);
  const double damping_rate = body_.stiffness_damping * omega_squared;
  return {omega_squared, damping_rate, damping_rate};
}

}  // namespace

void make_tetrahedra(const Model& model, std::vector<std::unique_ptr<Force>>& forces) {
  for (const Body& body : model.bodies) {
    if (body.tetrahedra.count == 0) continue;
    if (body.is_quadratic()) {
      forces.push_back(std::make_unique<Tetrahedra<QuadraticShape>>(model, body));
    } else {
      forces.push_back(std::make_unique<Tetrahedra<LinearShape>>(model, body));
    }
  }
}

}  // namespace flexcast
