#include "core/forces/tetrahedra.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "core/forces/element.h"
#include "core/forces/element_law.h"
#include "core/forces/element_modes.h"
#include "core/forces/incidences.h"
#include "core/forces/kelvin_voigt.h"
#include "core/forces/matrix_gather.h"
#include "core/forces/patches.h"
#include "core/forces/tetrahedra_kernels.h"
#include "core/forces/tetrahedra_runs.h"

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
  std::unique_ptr<BlockRuns> make_block_runs(const Visits& visits) const override {
    return make_tetrahedra_runs(model_, body_, visits);
  }
  std::int64_t constraint_count() const override { return layout_for_sweeps().patches.batch_count() * Patches::lanes; }
  void sweep_constraints(const ConstraintSweep& sweep, std::span<double> lambda, VecX& u) const override;
  std::int32_t body() const override { return static_cast<std::int32_t>(&body_ - model_.bodies.data()); }
  ModeBound calc_mode_bound() const override;

 private:
  static constexpr std::size_t points = Shape::points, nodes = Shape::nodes;
  using Element = flexcast::Element<Shape>;

  Lame lame() const { return element_law().lame; }
  ElementLaw element_law() const { return make_element_law(body_); }
  // The elements as kernels want them.
  struct Layout {
    Patches patches;
    AlignedVector<double> inverse_edges, weights;  // as in ElementBatches

    ElementBatches batches(const Patch& patch) const {
      const std::size_t first = static_cast<std::size_t>(patch.first_batch) * Patches::lanes;
      return {patch.batches, Shape::nodes == 10, patches.places(patch.first_batch), inverse_edges.data() + 9 * first,
              weights.data() + first};
    }
  };
  Layout make_layout(LaneOrder lane_order) const;
  const Layout& layout_for_sweeps() const {
    if (!sweeps_) sweeps_ = make_layout(LaneOrder::apart);
    return *sweeps_;
  }

  std::int32_t element_count() const { return body_.tetrahedra.count; }
  Element element(std::int32_t t) const { return make_element<Shape>(model_, body_, t); }
  // Calls visit(i, element, node) for every element at particles[i].
  template <class Visit>
  void for_incidences(std::span<const std::int32_t> particles, Visit visit) const {
    if (elements_.empty()) {
      for (std::int32_t t = 0; t < element_count(); ++t) elements_.push_back(element(t));
    }
    if (!incidences_) incidences_.emplace(body_.particles, elements_);
    for (std::size_t i = 0; i < particles.size(); ++i) {
      for (const auto& [element, node] : incidences_->at(particles[i])) {
        visit(i, elements_[static_cast<std::size_t>(element)], node);
      }
    }
  }
  std::vector<std::int32_t> make_all_nodes() const;
  // Adds what calc(patch, x of its particles, rows) writes to the matrix.
  template <class Calc>
  void add_to_matrix(const VecX& x, BlockMatrix& A, Calc calc) const;

  const Model& model_;
  const Body& body_;
  Layout layout_;
  // Made when first asked for, by one thread.
  mutable std::optional<Layout> sweeps_;
  mutable std::vector<Element> elements_;
  mutable std::optional<Incidences> incidences_;
  mutable std::optional<MatrixGather> matrix_gather_;  // for matrices of one pattern
};

template <class Shape>
Tetrahedra<Shape>::Tetrahedra(const Model& model, const Body& body)
    : model_(model), body_(body), layout_(make_layout(LaneOrder::spread)) {}

template <class Shape>
typename Tetrahedra<Shape>::Layout Tetrahedra<Shape>::make_layout(LaneOrder lane_order) const {
  std::array<NodeRow, nodes> node_rows;
  for (std::size_t a = 0; a < nodes; ++a) node_rows[a] = {static_cast<std::int32_t>(a), true};
  Layout layout{Patches(make_all_nodes(), node_rows, lane_order, model_.rest_positions, body_.particles), {}, {}};

  const std::span<const std::int32_t> order = layout.patches.elements();
  layout.inverse_edges.resize(9 * order.size());
  layout.weights.resize(order.size());
  for (std::size_t k = 0; k < order.size(); ++k) {
    const std::size_t batch = k / Patches::lanes, lane = k % Patches::lanes;
    const RestShape rest = calc_rest_shape(model_, body_, order[k] >= 0 ? order[k] : -1 - order[k]);
    for (std::size_t entry = 0; entry < 9; ++entry) {
      layout.inverse_edges[(9 * batch + entry) * Patches::lanes + lane] =
          rest.inverse_edges.reshaped()[static_cast<int>(entry)];
    }
    layout.weights[k] = order[k] >= 0 ? rest.volume / Shape::points : 0.0;
  }
  return layout;
}

template <class Shape>
void Tetrahedra<Shape>::add_conservative(const VecX& x, VecX& f) const {
  const ElementLaw law = element_law();
  layout_.patches.add_to(x, f, [&](const Patch& patch, const double* local_x, double* rows) {
    calc_patch_forces(layout_.batches(patch), law, local_x, rows);
  });
}

template <class Shape>
double Tetrahedra<Shape>::add_damping(const VecX& x, const VecX& v, VecX& f) const {
  const ElementLaw law = element_law();
  return layout_.patches.add_to(x, v, f,
                                [&](const Patch& patch, const double* local_x, const double* local_v, double* rows) {
                                  return calc_patch_damping(layout_.batches(patch), law, local_x, local_v, rows);
                                });
}

template <class Shape>
double Tetrahedra<Shape>::calc_energy(const VecX& x) const {
  const ElementLaw law = element_law();
  return layout_.patches.sum(x, [&](const Patch& patch, const double* local_x) {
    return calc_patch_energy(layout_.batches(patch), law, local_x);
  });
}

template <class Shape>
void Tetrahedra<Shape>::add_couplings(std::vector<std::pair<std::int32_t, std::int32_t>>& pairs) const {
  for (std::int32_t t = 0; t < element_count(); ++t) {
    const auto mine = make_nodes<Shape>(model_, body_, t);
    for (std::size_t a = 0; a < nodes; ++a) {
      for (std::size_t b = a + 1; b < nodes; ++b) pairs.emplace_back(mine[a], mine[b]);
    }
  }
}

template <class Shape>
std::vector<std::int32_t> Tetrahedra<Shape>::make_all_nodes() const {
  std::vector<std::int32_t> all;
  all.reserve(nodes * static_cast<std::size_t>(element_count()));
  for (std::int32_t t = 0; t < element_count(); ++t) {
    const auto mine = make_nodes<Shape>(model_, body_, t);
    all.insert(all.end(), mine.begin(), mine.end());
  }
  return all;
}

template <class Shape>
template <class Calc>
void Tetrahedra<Shape>::add_to_matrix(const VecX& x, BlockMatrix& A, Calc calc) const {
  if (!matrix_gather_ || matrix_gather_->pattern_id() != A.pattern_id()) {
    matrix_gather_.emplace(layout_.patches, make_all_nodes(), Shape::nodes, A);
  }
  layout_.patches.for_apart(x, [&](std::size_t number, const Patch& patch, const double* local_x) {
    const BlockRows9 rows = matrix_gather_->scratch();
    calc(patch, local_x, rows);
    matrix_gather_->add(number, rows, A.values());
  });
}

template <class Shape>
void Tetrahedra<Shape>::add_stiffness(const VecX& x, double scale, Tangent kind, BlockMatrix& A) const {
  const ElementLaw law = element_law();
  if (has_stiffness_in_lanes(*law.law, kind)) {
    add_to_matrix(x, A, [&](const Patch& patch, const double* local_x, const BlockRows9& rows) {
      calc_patch_stiffness(layout_.batches(patch), law, kind, scale, local_x, rows);
    });
    return;
  }
  std::array<Mat3, points> F;
  std::array<Mat9, points> C;
  for (std::int32_t t = 0; t < element_count(); ++t) {
    const Element e = element(t);
    e.calc_gradients(x, F);
    body_.law->calc_tangent(law.lame, kind, F, C);
    add_tangent_blocks<Shape>(e, C, scale, A);
  }
}

template <class Shape>
void Tetrahedra<Shape>::add_damping_matrix(const VecX& x, double scale, BlockMatrix& A) const {
  if (!has_damping()) return;
  const ElementLaw law = element_law();
  add_to_matrix(x, A, [&](const Patch& patch, const double* local_x, const BlockRows9& rows) {
    calc_patch_damping_matrix(layout_.batches(patch), law, scale, local_x, rows);
  });
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
  const ElementLaw law = element_law();
  std::array<Mat3, points> F, rate;
  for_incidences(particles, [&](std::size_t i, const Element& e, std::int32_t node) {
    e.calc_gradients(x, F);
    e.calc_gradients(v, rate);
    for (std::size_t q = 0; q < points; ++q) {
      const Vec3 g = e.calc_gradient(q, node);
      f[i] -= e.weight * calc_kelvin_voigt_stress(law.viscosity, law.small_strain, F[q], rate[q]) * g;
      for (int k = 0; k < 3; ++k) {
        const Mat3 unit = Vec3::Unit(k) * g.transpose();  // the node moves along axis k, the others rest
        K[i].col(k) += scale * e.weight * calc_kelvin_voigt_stress(law.viscosity, law.small_strain, F[q], unit) * g;
      }
    }
  });
}

// One constraint of compliance 1 an element, C = sqrt(2 U) with U its energy, so that C^2 / 2 = U and -C grad C = f:
//   dlambda = (-s C - lambda - s_d grad C . u) / ((s + s_d) W + 1),   u_i += w_i grad C_i dlambda
// with s = h^2, s_d = h beta, W = sum_i w_i |grad C_i|^2: equations 18 and 26 of the source times h^2. Converged sweeps
// have lambda = -s C, and are the backward Euler step as far as grad C keeps its direction on the way there: to the
// order (h omega)^2. Damping acts on the rate of C alone, so it takes at most what Kelvin-Voigt damping of the same
// beta does near the rest shape. An element whose move would not be finite stays. Source: M. Macklin, M. Mueller, N.
// Chentanez, XPBD: Position-based simulation of compliant constrained dynamics, Motion in Games 2016.
template <class Shape>
void Tetrahedra<Shape>::sweep_constraints(const ConstraintSweep& sweep, std::span<double> lambda, VecX& u) const {
  const ElementLaw law = element_law();
  const Layout& layout = layout_for_sweeps();
  layout.patches.sweep(sweep.start, sweep.inverse_masses, u,
                       [&](const Patch& patch, const double* start, const double* inverse_masses, double* local_u) {
                         double* mine = lambda.data() + static_cast<std::ptrdiff_t>(patch.first_batch) * Patches::lanes;
                         sweep_patch_constraints(
                             layout.batches(patch), law,
                             {sweep.h, body_.stiffness_damping, start, inverse_masses, mine, local_u});
                       });
}

template <class Shape>
ModeBound Tetrahedra<Shape>::calc_mode_bound() const {
  const double omega_squared = calc_omega_squared_bound<Shape>(model_, body_, lame());
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
