#include "core/forces/springs.h"

#include <optional>

#include "core/forces/patches.h"
#include "core/forces/spring.h"
#include "core/forces/spring_kernels.h"
#include "core/forces/spring_runs.h"

namespace flexcast {
namespace {

class Springs final : public Force {
 public:
  Springs(const Model& model, std::size_t body);

  bool is_active() const override { return body_.stiffness > 0.0 || body_.damping > 0.0; }
  bool has_damping() const override { return body_.damping > 0.0; }
  EnergyKind energy_kind() const override { return EnergyKind::elastic; }
  void add_conservative(const VecX& x, VecX& f) const override;
  double add_damping(const VecX& x, const VecX& v, VecX& f) const override;
  double add_force(const VecX& x, const VecX& v, VecX& f) const override;
  double calc_energy(const VecX& x) const override;
  void add_couplings(std::vector<std::pair<std::int32_t, std::int32_t>>& pairs) const override;
  void add_stiffness(const VecX& x, double scale, Tangent kind, BlockMatrix& A) const override;
  void add_damping_matrix(const VecX& x, double scale, BlockMatrix& A) const override;
  void add_blocks(const VecX& x, std::span<const std::int32_t> particles, std::span<Vec3> f,
                  std::span<Mat3> K) const override;
  void add_damping_blocks(const VecX& x, const VecX& v, double scale, std::span<const std::int32_t> particles,
                          std::span<Vec3> f, std::span<Mat3> K) const override;
  std::unique_ptr<BlockRuns> make_block_runs(const Visits& visits) const override {
    return make_spring_runs(model_, body_, visits);
  }
  std::int64_t constraint_count() const override { return layout_for_sweeps().patches.batch_count() * Patches::lanes; }
  void sweep_constraints(const ConstraintSweep& sweep, std::span<double> lambda, VecX& u) const override;
  std::int32_t body() const override { return static_cast<std::int32_t>(&body_ - model_.bodies.data()); }
  ModeBound calc_mode_bound() const override;

 private:
  struct Element {
    std::int32_t p, q;
    double r;
  };
  // Calls calc(e) for every spring and adds the block to the diagonals of its ends, subtracts it between them.
  template <class Calc>
  void add_to_matrix(BlockMatrix& A, Calc calc) const;

  // The springs as kernels want them.
  struct Layout {
    Patches patches;
    AlignedVector<double> rest_lengths, inverse_rest_lengths;  // as in SpringBatches

    SpringBatches batches(const Patch& patch) const {
      const std::size_t first = static_cast<std::size_t>(patch.first_batch) * Patches::lanes;
      return {patch.batches, patches.places(patch.first_batch), rest_lengths.data() + first,
              inverse_rest_lengths.data() + first};
    }
  };
  Layout make_layout(LaneOrder lane_order) const;
  const Layout& layout_for_sweeps() const {
    if (!sweeps_) sweeps_ = make_layout(LaneOrder::apart);
    return *sweeps_;
  }
  double add_both(double stiffness, const VecX& x, const VecX& v, VecX& f) const;

  // Calls visit(i, e, sign) for the springs of each listed particle of the body; sign = 1 at p, -1 at q.
  template <class Visit>
  void for_springs_at(std::span<const std::int32_t> particles, Visit visit) const;

  const Model& model_;
  const Body& body_;
  std::vector<Element> elements_;
  Layout layout_;
  mutable std::uint64_t places_of_ = 0;                      // the pattern of the matrices that have places_
  mutable std::vector<std::array<std::int64_t, 4>> places_;  // of a spring's blocks pp, qq, pq, qp
  mutable std::optional<Layout> sweeps_;                     // made when first asked for
  // The springs that meet at a particle of the body, made when first asked for.
  mutable std::vector<std::int32_t> meeting_starts_, meeting_;
};

Springs::Springs(const Model& model, std::size_t body) : model_(model), body_(model.bodies[body]) {
  elements_.reserve(body_.springs.count);
  for (std::int32_t s = body_.springs.first; s < body_.springs.end(); ++s) {
    const auto [p, q] = model.springs[s];
    elements_.push_back({p, q, (block3(model.rest_positions, q) - block3(model.rest_positions, p)).stableNorm()});
  }
  layout_ = make_layout(LaneOrder::spread);
}

Springs::Layout Springs::make_layout(LaneOrder lane_order) const {
  std::vector<std::int32_t> ends;
  ends.reserve(2 * elements_.size());
  for (const Element& e : elements_) ends.insert(ends.end(), {e.p, e.q});
  constexpr std::array<NodeRow, 2> node_rows{NodeRow{0, false}, NodeRow{0, true}};  // the force on p, and its reaction
  Layout layout{Patches(ends, node_rows, lane_order, model_.rest_positions, body_.particles), {}, {}};
  for (const std::int32_t k : layout.patches.elements()) {
    const double r = elements_[static_cast<std::size_t>(k >= 0 ? k : -1 - k)].r;
    layout.rest_lengths.push_back(r);
    layout.inverse_rest_lengths.push_back(k >= 0 ? 1.0 / r : 0.0);
  }
  return layout;
}

void Springs::add_conservative(const VecX& x, VecX& f) const {
  layout_.patches.add_to(x, f, [&](const Patch& patch, const double* local_x, double* rows) {
    calc_spring_forces(layout_.batches(patch), body_.stiffness, local_x, rows);
  });
}

double Springs::add_damping(const VecX& x, const VecX& v, VecX& f) const {
  return add_both(0.0, x, v, f);
}

double Springs::add_force(const VecX& x, const VecX& v, VecX& f) const {
  if (!has_damping()) return add_conservative(x, f), 0.0;
  return add_both(body_.stiffness, x, v, f);
}

double Springs::add_both(double stiffness, const VecX& x, const VecX& v, VecX& f) const {
  return layout_.patches.add_to(
      x, v, f, [&](const Patch& patch, const double* local_x, const double* local_v, double* rows) {
        return calc_damped_spring_forces(layout_.batches(patch), stiffness, body_.damping, local_x, local_v, rows);
      });
}

double Springs::calc_energy(const VecX& x) const {
  return layout_.patches.sum(x, [&](const Patch& patch, const double* local_x) {
    return calc_spring_energy(layout_.batches(patch), body_.stiffness, local_x);
  });
}

void Springs::add_couplings(std::vector<std::pair<std::int32_t, std::int32_t>>& pairs) const {
  for (const Element& e : elements_) pairs.emplace_back(e.p, e.q);
}

template <class Calc>
void Springs::add_to_matrix(BlockMatrix& A, Calc calc) const {
  if (places_of_ != A.pattern_id()) {
    places_.clear();
    for (const auto& [p, q, r] : elements_) {
      places_.push_back({A.find(p, p), A.find(q, q), A.find(p, q), A.find(q, p)});
    }
    places_of_ = A.pattern_id();
  }
  for (std::size_t k = 0; k < elements_.size(); ++k) {
    const Mat3 block = calc(elements_[k]);
    const auto& [pp, qq, pq, qp] = places_[k];
    Eigen::Map<Mat3>(A.value(pp)) += block;
    Eigen::Map<Mat3>(A.value(qq)) += block;
    Eigen::Map<Mat3>(A.value(pq)) -= block;
    Eigen::Map<Mat3>(A.value(qp)) -= block;
  }
}

void Springs::add_stiffness(const VecX& x, double scale, Tangent kind, BlockMatrix& A) const {
  add_to_matrix(A, [&](const Element& e) {
    const Vec3 d = block3(x, e.q) - block3(x, e.p);
    return Mat3(scale * calc_spring_tangent(d, e.r, body_.stiffness, kind));
  });
}

void Springs::add_damping_matrix(const VecX& x, double scale, BlockMatrix& A) const {
  if (!has_damping()) return;
  add_to_matrix(A, [&](const Element& e) {
    const Vec3 n = calc_spring_direction(block3(x, e.q) - block3(x, e.p)).n;
    return Mat3(scale * body_.damping / e.r * n * n.transpose());
  });
}

template <class Visit>
void Springs::for_springs_at(std::span<const std::int32_t> particles, Visit visit) const {
  if (meeting_starts_.empty()) {
    meeting_starts_.assign(static_cast<std::size_t>(body_.particles.count) + 1, 0);
    const auto local = [&](std::int32_t particle) { return particle - body_.particles.first; };
    for (const Element& e : elements_) ++meeting_starts_[local(e.p) + 1], ++meeting_starts_[local(e.q) + 1];
    for (std::size_t i = 1; i < meeting_starts_.size(); ++i) meeting_starts_[i] += meeting_starts_[i - 1];
    meeting_.resize(2 * elements_.size());
    std::vector<std::int32_t> next = meeting_starts_;
    for (std::size_t k = 0; k < elements_.size(); ++k) {
      meeting_[next[local(elements_[k].p)]++] = static_cast<std::int32_t>(k);
      meeting_[next[local(elements_[k].q)]++] = static_cast<std::int32_t>(k);
    }
  }
  for (std::size_t i = 0; i < particles.size(); ++i) {
    const std::int32_t local = particles[i] - body_.particles.first;
    if (local < 0 || local >= body_.particles.count) continue;
    for (std::int32_t k = meeting_starts_[local]; k < meeting_starts_[local + 1]; ++k) {
      const Element& e = elements_[meeting_[k]];
      visit(i, e, e.p == particles[i] ? 1.0 : -1.0);
    }
  }
}

void Springs::add_blocks(const VecX& x, std::span<const std::int32_t> particles, std::span<Vec3> f,
                         std::span<Mat3> K) const {
  for_springs_at(particles, [&](std::size_t i, const Element& e, double sign) {
    const Vec3 d = block3(x, e.q) - block3(x, e.p);
    f[i] += sign * calc_spring_force(d, Vec3::Zero(), e.r, body_.stiffness, 0.0);
    K[i] += calc_spring_tangent(d, e.r, body_.stiffness, Tangent::positive_semidefinite);
  });
}

void Springs::add_damping_blocks(const VecX& x, const VecX& v, double scale, std::span<const std::int32_t> particles,
                                 std::span<Vec3> f, std::span<Mat3> K) const {
  for_springs_at(particles, [&](std::size_t i, const Element& e, double sign) {
    const Vec3 n = calc_spring_direction(block3(x, e.q) - block3(x, e.p)).n;
    const double damping = body_.damping / e.r;
    f[i] += sign * damping * (block3(v, e.q) - block3(v, e.p)).dot(n) * n;
    K[i] += scale * damping * n * n.transpose();
  });
}

// C = l - r of compliance r / k_s, damped by k_d / r. Multiplied through by s = h^2 k_s / r and s_d = h k_d / r, so
// that no stiffness is no trouble:
//   dlambda = (-s C - lambda - s_d gradC.u) / ((s + s_d) W + 1),  W = sum_i w_i |grad_i C|^2.
// Source: M. Macklin, M. Mueller, N. Chentanez, XPBD, Motion in Games 2016, equations 18 and 26.
void Springs::sweep_constraints(const ConstraintSweep& sweep, std::span<double> lambda, VecX& u) const {
  const Layout& layout = layout_for_sweeps();
  layout.patches.sweep(sweep.start, sweep.inverse_masses, u,
                       [&](const Patch& patch, const double* start, const double* inverse_masses, double* local_u) {
                         double* mine = lambda.data() + static_cast<std::ptrdiff_t>(patch.first_batch) * Patches::lanes;
                         sweep_spring_constraints(layout.batches(patch), {sweep.h, body_.stiffness, body_.damping,
                                                                          start, inverse_masses, mine, local_u});
                       });
}

// A spring of stiffness k between shares of its ends' masses has omega^2 = k (1/m_p + 1/m_q). Shared out in proportion
// to the stiffness that meets at a particle, every spring gets m_p k / K_p, and the largest element frequency bounds
// the whole (Irons' theorem). The axial stiffness k_s/r is never exceeded, stretched or not.
ModeBound Springs::calc_mode_bound() const {
  VecX stiffness = VecX::Zero(model_.particle_count());
  for (const Element& e : elements_) {
    stiffness[e.p] += 1.0 / e.r;
    stiffness[e.q] += 1.0 / e.r;
  }
  const auto rate = [&](std::int32_t particle) {
    const std::uint8_t* fixed = &model_.fixed[3 * static_cast<std::size_t>(particle)];
    return fixed[0] && fixed[1] && fixed[2] ? 0.0 : stiffness[particle] / model_.masses[particle];
  };
  double largest = 0.0;
  for (const Element& e : elements_) largest = std::max(largest, rate(e.p) + rate(e.q));
  return {body_.stiffness * largest, body_.damping * largest, body_.damping * largest};
}

}  // namespace

void make_springs(const Model& model, std::vector<std::unique_ptr<Force>>& forces) {
  for (std::size_t body = 0; body < model.bodies.size(); ++body) {
    if (model.bodies[body].springs.count > 0) forces.push_back(std::make_unique<Springs>(model, body));
  }
}

}  // namespace flexcast
