#include "core/forces/tetrahedra.h"

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <algorithm>

namespace flexcast {
namespace {

constexpr std::size_t batch_size = 32;

struct Element {
  Tetrahedron nodes;
  Mat3 inverse;   // [X1-X0, X2-X0, X3-X0]^-1: its rows are grad N_1, grad N_2, grad N_3
  double volume;  // m^3, at rest
};

Mat3 calc_gradient(const Element& e, const VecX& x) {
  Mat3 D;
  const Vec3 x0 = block3(x, e.nodes[0]);
  for (int a = 0; a < 3; ++a) D.col(a) = block3(x, e.nodes[a + 1]) - x0;
  return D * e.inverse;
}

// f_a -= V P grad N_a.
void scatter(const Element& e, const Mat3& P, VecX& f) {
  const Mat3 H = e.volume * P * e.inverse.transpose();
  block3(f, e.nodes[0]) += H.rowwise().sum();
  for (int a = 0; a < 3; ++a) block3(f, e.nodes[a + 1]) -= H.col(a);
}

// A += the 4 x 4 blocks scale V grad N_a . C . grad N_b, C a symmetric 9 x 9 matrix (columns of F one below the other).
void scatter(const Element& e, const Mat9& C, double scale, BlockMatrix& A) {
  Eigen::Matrix<double, 4, 3> g;  // grad N_a
  g.bottomRows<3>() = e.inverse;
  g.row(0) = -e.inverse.colwise().sum();
  for (int b = 0; b < 4; ++b) {
    Eigen::Matrix<double, 9, 3> half = Eigen::Matrix<double, 9, 3>::Zero();
    for (int l = 0; l < 3; ++l) half += g(b, l) * C.middleCols<3>(3 * l);
    for (int a = 0; a < 4; ++a) {
      Mat3 block = Mat3::Zero();
      for (int j = 0; j < 3; ++j) block += g(a, j) * half.middleRows<3>(3 * j);
      A.add(e.nodes[a], e.nodes[b], scale * e.volume * block);
    }
  }
}

class Tetrahedra final : public Force {
 public:
  Tetrahedra(const Model& model, std::size_t body);

  bool is_active() const override { return true; }
  bool has_damping() const override { return body_.stiffness_damping > 0.0; }
  EnergyKind energy_kind() const override { return EnergyKind::elastic; }
  void add_conservative(const VecX& x, VecX& f) const override;
  void add_damping(const VecX& x, const VecX& v, VecX& f) const override;
  double calc_energy(const VecX& x) const override;
  void add_couplings(std::vector<std::pair<std::int32_t, std::int32_t>>& pairs) const override;
  void add_stiffness(const VecX& x, double scale, Tangent kind, BlockMatrix& A) const override;
  void add_damping_matrix(const VecX& x, double scale, BlockMatrix& A) const override;
  std::int32_t body() const override { return static_cast<std::int32_t>(&body_ - model_.bodies.data()); }
  ModeBound calc_mode_bound() const override;

 private:
  Lame lame() const { return calc_lame(body_.young, body_.poisson); }
  Lame damping_lame() const {
    const Lame elastic = lame();
    return {body_.stiffness_damping * elastic.mu, body_.stiffness_damping * elastic.lambda};
  }
  Mat3 calc_damping_stress(Lame viscosity, const Mat3& F, const Mat3& rate) const;

  // Calls visit(first, F) for every run of at most batch_size elements and their deformation gradients.
  template <class Visit>
  void for_batches(const VecX& x, Visit visit) const {
    std::array<Mat3, batch_size> F;
    for (std::size_t first = 0; first < elements_.size(); first += batch_size) {
      const std::size_t count = std::min(batch_size, elements_.size() - first);
      for (std::size_t i = 0; i < count; ++i) F[i] = calc_gradient(elements_[first + i], x);
      visit(first, std::span<const Mat3>(F.data(), count));
    }
  }

  const Model& model_;
  const Body& body_;
  std::vector<Element> elements_;
};

Tetrahedra::Tetrahedra(const Model& model, std::size_t body) : model_(model), body_(model.bodies[body]) {
  elements_.reserve(body_.tetrahedra.count);
  for (std::int32_t t = body_.tetrahedra.first; t < body_.tetrahedra.end(); ++t) {
    Element e{model.tetrahedra[t], Mat3::Identity(), 0.0};
    const Mat3 D = calc_gradient(e, model.rest_positions);
    e.inverse = D.inverse();
    e.volume = D.determinant() / 6.0;
    elements_.push_back(e);
  }
}

void Tetrahedra::add_conservative(const VecX& x, VecX& f) const {
  std::array<Mat3, batch_size> P;
  for_batches(x, [&](std::size_t first, std::span<const Mat3> F) {
    body_.law->calc_stress(lame(), F, {P.data(), F.size()});
    for (std::size_t i = 0; i < F.size(); ++i) scatter(elements_[first + i], P[i], f);
  });
}

Mat3 Tetrahedra::calc_damping_stress(Lame viscosity, const Mat3& F, const Mat3& rate) const {
  const Mat3 G = body_.law->small_strain ? rate : Mat3(F.transpose() * rate);
  const Mat3 strain_rate = 0.5 * (G + G.transpose());
  const Mat3 S = 2.0 * viscosity.mu * strain_rate + viscosity.lambda * strain_rate.trace() * Mat3::Identity();
  return body_.law->small_strain ? S : Mat3(F * S);
}

void Tetrahedra::add_damping(const VecX& x, const VecX& v, VecX& f) const {
  const Lame viscosity = damping_lame();
  for (const Element& e : elements_) {
    scatter(e, calc_damping_stress(viscosity, calc_gradient(e, x), calc_gradient(e, v)), f);
  }
}

double Tetrahedra::calc_energy(const VecX& x) const {
  std::array<double, batch_size> Psi;
  double energy = 0.0;
  for_batches(x, [&](std::size_t first, std::span<const Mat3> F) {
    body_.law->calc_energy(lame(), F, {Psi.data(), F.size()});
    for (std::size_t i = 0; i < F.size(); ++i) energy += elements_[first + i].volume * Psi[i];
  });
  return energy;
}

void Tetrahedra::add_couplings(std::vector<std::pair<std::int32_t, std::int32_t>>& pairs) const {
  for (const Element& e : elements_) {
    for (int a = 0; a < 4; ++a) {
      for (int b = a + 1; b < 4; ++b) pairs.emplace_back(e.nodes[a], e.nodes[b]);
    }
  }
}

void Tetrahedra::add_stiffness(const VecX& x, double scale, Tangent kind, BlockMatrix& A) const {
  std::array<Mat9, batch_size> C;
  for_batches(x, [&](std::size_t first, std::span<const Mat3> F) {
    body_.law->calc_tangent(lame(), kind, F, {C.data(), F.size()});
    for (std::size_t i = 0; i < F.size(); ++i) scatter(elements_[first + i], C[i], scale, A);
  });
}

void Tetrahedra::add_damping_matrix(const VecX& x, double scale, BlockMatrix& A) const {
  if (!has_damping()) return;
  const Lame viscosity = damping_lame();
  for (const Element& e : elements_) {
    const Mat3 F = calc_gradient(e, x);
    Mat9 C;
    for (int l = 0; l < 3; ++l) {
      for (int k = 0; k < 3; ++k) {
        const Mat3 unit = Vec3::Unit(k) * Vec3::Unit(l).transpose();
        C.col(k + 3 * l) = calc_damping_stress(viscosity, F, unit).reshaped();
      }
    }
    scatter(e, C, scale, A);
  }
}

// Per element, with the mass of each particle shared in proportion to the volumes that meet there: the energy of a
// small motion is at most V (mu |F'|^2 + lambda/2 tr(F')^2), so omega^2 <= V (2 mu a + lambda tr(B)) with
// B = sum_a grad N_a grad N_a^T / m_a and a its largest eigenvalue. The largest element bounds the mesh (Irons).
ModeBound Tetrahedra::calc_mode_bound() const {
  VecX volumes = VecX::Zero(model_.particle_count());
  for (const Element& e : elements_) {
    for (const std::int32_t node : e.nodes) volumes[node] += e.volume;
  }
  const Lame elastic = lame();
  double largest = 0.0;
  for (const Element& e : elements_) {
    Mat3 B = Mat3::Zero();
    for (int a = 0; a < 4; ++a) {
      const std::int32_t node = e.nodes[a];
      const std::uint8_t* fixed = &model_.fixed[3 * static_cast<std::size_t>(node)];
      if (fixed[0] && fixed[1] && fixed[2]) continue;
      const Vec3 g = a == 0 ? Vec3(-e.inverse.colwise().sum()) : Vec3(e.inverse.row(a - 1));
      B += volumes[node] / (model_.masses[node] * e.volume) * g * g.transpose();
    }
    const double a = Eigen::SelfAdjointEigenSolver<Mat3>(B, Eigen::EigenvaluesOnly).eigenvalues()[2];
    largest = std::max(largest, e.volume * (2.0 * elastic.mu * a + std::max(elastic.lambda, 0.0) * B.trace()));
  }
  return {largest, body_.stiffness_damping * largest, body_.stiffness_damping * largest};
}

}  // namespace

void make_tetrahedra(const Model& model, std::vector<std::unique_ptr<Force>>& forces) {
  for (std::size_t body = 0; body < model.bodies.size(); ++body) {
    if (model.bodies[body].tetrahedra.count > 0) forces.push_back(std::make_unique<Tetrahedra>(model, body));
  }
}

}  // namespace flexcast
