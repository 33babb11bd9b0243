#include "core/forces/springs.h"

#include "core/forces/spring.h"

namespace flexcast {
namespace {

class Springs final : public Force {
 public:
  Springs(const Model& model, std::size_t body);

  bool is_active() const override { return body_.stiffness > 0.0 || body_.damping > 0.0; }
  bool has_damping() const override { return body_.damping > 0.0; }
  EnergyKind energy_kind() const override { return EnergyKind::elastic; }
  void add_conservative(const VecX& x, VecX& f) const override;
  void add_damping(const VecX& x, const VecX& v, VecX& f) const override;
  void add_force(const VecX& x, const VecX& v, VecX& f) const override;
  double calc_energy(const VecX& x) const override;
  void add_couplings(std::vector<std::pair<std::int32_t, std::int32_t>>& pairs) const override;
  void add_stiffness(const VecX& x, double scale, Tangent kind, BlockMatrix& A) const override;
  void add_damping_matrix(const VecX& x, double scale, BlockMatrix& A) const override;
  std::int32_t body() const override { return static_cast<std::int32_t>(&body_ - model_.bodies.data()); }
  ModeBound calc_mode_bound() const override;

 private:
  struct Element {
    std::int32_t p, q;
    double r;
  };
  static void add_pair(const Element& e, const Mat3& block, BlockMatrix& A) {
    A.add(e.p, e.p, block);
    A.add(e.q, e.q, block);
    A.add(e.p, e.q, -block);
    A.add(e.q, e.p, -block);
  }

  const Model& model_;
  const Body& body_;
  std::vector<Element> elements_;
};

Springs::Springs(const Model& model, std::size_t body) : model_(model), body_(model.bodies[body]) {
  elements_.reserve(body_.springs.count);
  for (std::int32_t s = body_.springs.first; s < body_.springs.end(); ++s) {
    const auto [p, q] = model.springs[s];
    elements_.push_back({p, q, (block3(model.rest_positions, q) - block3(model.rest_positions, p)).stableNorm()});
  }
}

void Springs::add_conservative(const VecX& x, VecX& f) const {
  for (const Element& e : elements_) {
    const Vec3 force = calc_spring_force(block3(x, e.q) - block3(x, e.p), Vec3::Zero(), e.r, body_.stiffness, 0.0);
    block3(f, e.p) += force;
    block3(f, e.q) -= force;
  }
}

void Springs::add_damping(const VecX& x, const VecX& v, VecX& f) const {
  for (const Element& e : elements_) {
    const Vec3 d = block3(x, e.q) - block3(x, e.p);
    const Vec3 force = calc_spring_damping_force(d, block3(v, e.q) - block3(v, e.p), e.r, body_.damping);
    block3(f, e.p) += force;
    block3(f, e.q) -= force;
  }
}

void Springs::add_force(const VecX& x, const VecX& v, VecX& f) const {
  if (!has_damping()) return add_conservative(x, f);
  for (const Element& e : elements_) {
    const Vec3 d = block3(x, e.q) - block3(x, e.p);
    const Vec3 dv = block3(v, e.q) - block3(v, e.p);
    const Vec3 force = calc_spring_force(d, dv, e.r, body_.stiffness, body_.damping);
    block3(f, e.p) += force;
    block3(f, e.q) -= force;
  }
}

double Springs::calc_energy(const VecX& x) const {
  double energy = 0.0;
  for (const Element& e : elements_) {
    energy += calc_spring_energy(block3(x, e.q) - block3(x, e.p), e.r, body_.stiffness);
  }
  return energy;
}

void Springs::add_couplings(std::vector<std::pair<std::int32_t, std::int32_t>>& pairs) const {
  for (const Element& e : elements_) pairs.emplace_back(e.p, e.q);
}

void Springs::add_stiffness(const VecX& x, double scale, Tangent kind, BlockMatrix& A) const {
  for (const Element& e : elements_) {
    const Vec3 d = block3(x, e.q) - block3(x, e.p);
    add_pair(e, scale * calc_spring_tangent(d, e.r, body_.stiffness, kind), A);
  }
}

void Springs::add_damping_matrix(const VecX& x, double scale, BlockMatrix& A) const {
  if (!has_damping()) return;
  for (const Element& e : elements_) {
    const Vec3 n = calc_spring_direction(block3(x, e.q) - block3(x, e.p)).n;
    add_pair(e, scale * body_.damping / e.r * n * n.transpose(), A);
  }
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
