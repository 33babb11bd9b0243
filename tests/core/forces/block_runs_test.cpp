// Blocks in lanes are what the laws' own functions say at every particle, on every instruction set.
#include "core/forces/block_runs.h"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>

#include "core/base/aligned.h"
#include "core/forces/element.h"
#include "core/forces/system.h"
#include "core/integrators/coloring.h"
#include "core/materials/polar.h"
#include "tests/support/instruction_set.h"
#include "tests/support/model.h"
#include "tests/support/random.h"

namespace flexcast::test {
namespace {

AlignedVector<double> to_fours(const VecX& from) {
  AlignedVector<double> to(static_cast<std::size_t>(from.size() / 3 * 4), 0.0);
  for (std::int64_t i = 0; i < from.size() / 3; ++i) std::copy_n(from.data() + 3 * i, 3, to.data() + 4 * i);
  return to;
}

// One entry a particle.
struct Blocks {
  std::vector<Vec3> f;
  std::vector<Mat3> K;
  explicit Blocks(std::int64_t particles)
      : f(static_cast<std::size_t>(particles), Vec3::Zero()), K(static_cast<std::size_t>(particles), Mat3::Zero()) {}
  bool operator==(const Blocks&) const = default;
};

double calc_difference(const Blocks& a, const Blocks& b) {
  double difference = 0.0, f = 0.0, K = 0.0;
  for (const Vec3& one : b.f) f = std::max(f, one.norm());
  for (const Mat3& one : b.K) K = std::max(K, one.norm());
  for (std::size_t i = 0; i < a.f.size(); ++i) {
    difference = std::max({difference, (a.f[i] - b.f[i]).norm() / f, (a.K[i] - b.K[i]).norm() / K});
  }
  return difference;
}

// Calls fill(run, f, K) for every run.
template <class Fill>
Blocks collect(const Visits& visits, Fill fill) {
  Blocks all(static_cast<std::int64_t>(visits.particles.size()));
  for (std::int32_t r = 0; r < visits.run_count(); ++r) {
    const auto run = visits.run(r);
    Blocks mine(std::ssize(run));
    fill(r, std::span(mine.f), std::span(mine.K));
    for (std::size_t i = 0; i < run.size(); ++i) {
      all.f[static_cast<std::size_t>(run[i])] = mine.f[i];
      all.K[static_cast<std::size_t>(run[i])] = mine.K[i];
    }
  }
  return all;
}

struct Subject {
  Model model;
  System system;
  const Force* force = nullptr;
  VisitOrder order;
  std::unique_ptr<BlockRuns> runs;
  VecX x, v;

  Subject(const Model& from, double amount)
      : model(from),
        system((update_masses(model), model)),
        order(static_cast<std::int32_t>(model.particle_count()), system.make_couplings()) {
    for (const Force* one : system.active_forces()) {
      if (one->energy_kind() == EnergyKind::elastic) force = one;
    }
    runs = force->make_block_runs(order.visits);
    SplitMix64 random(5);
    const Mat3 turn = Eigen::AngleAxisd(1.0, Vec3(1, 2, 3).normalized()).toRotationMatrix();
    x = model.rest_positions + make_random_vector(random, model.rest_positions.size(), amount);
    for (std::int64_t i = 0; i < model.particle_count(); ++i) block3(x, i) = turn * block3(x, i);
    v = make_random_vector(random, x.size(), 0.3);
  }
  Blocks calc() const {
    const auto fours = to_fours(x);
    return collect(order.visits, [&](std::int32_t r, auto f, auto K) { runs->add(r, fours.data(), f, K); });
  }
  Blocks calc_damping() const {
    const auto x4 = to_fours(x), v4 = to_fours(v);
    return collect(order.visits,
                   [&](std::int32_t r, auto f, auto K) { runs->add_damping(r, x4.data(), v4.data(), 2.0, f, K); });
  }
  Blocks calc_positive() const {
    const auto fours = to_fours(x);
    return collect(order.visits, [&](std::int32_t r, auto f, auto K) {
      runs->add(r, fours.data(), f, K);
      for (std::size_t i = 0; i < K.size(); ++i)
        runs->make_positive(r, static_cast<std::int32_t>(i), fours.data(), K[i]);
    });
  }
  // The plain way.
  Blocks calc_plain() const {
    return collect(order.visits,
                   [&](std::int32_t r, auto f, auto K) { force->add_blocks(x, order.visits.run(r), f, K); });
  }
  Blocks calc_plain_damping() const {
    return collect(order.visits, [&](std::int32_t r, auto f, auto K) {
      force->add_damping_blocks(x, v, 2.0, order.visits.run(r), f, K);
    });
  }
};

// dP/dF of the corotational law as corotational-inl.h's blocks take it.
Mat9 calc_bounded_corotational(Lame lame, const Mat3& F) {
  const Polar polar = calc_polar(F);
  const Eigen::SelfAdjointEigenSolver<Mat3> eigen(polar.S);
  const Vec3 s = eigen.eigenvalues(), sums = Vec3::Constant(s.sum()) - s;
  double factor = lame.lambda * (s.sum() - 3.0) - 2.0 * lame.mu;
  if (!(sums.minCoeff() > -factor / (1.5 * lame.mu))) {
    factor = std::max(factor, -1.5 * lame.mu * sums.prod() / (s.sum() * s.sum()));
  }
  const Eigen::Matrix<double, 9, 1> q = polar.Q.reshaped();
  Mat9 C = 2.0 * lame.mu * Mat9::Identity() + lame.lambda * q * q.transpose();
  for (int k = 0; k < 3; ++k) {
    Mat3 T;
    for (int j = 0; j < 3; ++j) T.col(j) = polar.Q * eigen.eigenvectors().col(k).cross(Vec3::Unit(j));
    const Eigen::Matrix<double, 9, 1> t = T.reshaped();
    C += factor / sums[k] * t * t.transpose();
  }
  return C;
}

template <class Shape>
Blocks calc_expected(const Model& model, const VecX& x) {
  const Body& body = model.bodies[0];
  const Lame lame = calc_lame(body.young, body.poisson);
  Blocks all(model.particle_count());
  for (std::int32_t t = 0; t < body.tetrahedra.count; ++t) {
    const auto e = make_element<Shape>(model, body, t);
    std::array<Mat3, Shape::points> F, P;
    std::array<Mat9, Shape::points> C;
    e.calc_gradients(x, F);
    body.law->calc_stress(lame, F, P);
    body.law->calc_tangent(lame, Tangent::exact, F, C);
    for (std::size_t q = 0; q < Shape::points; ++q) {
      if (body.law->kernel == LawKernel::corotational) C[q] = calc_bounded_corotational(lame, F[q]);
      for (std::int32_t a = 0; a < Shape::nodes; ++a) {
        const auto i = static_cast<std::size_t>(e.nodes[static_cast<std::size_t>(a)]);
        const Vec3 g = e.calc_gradient(q, a);
        all.f[i] -= e.weight * P[q] * g;
        all.K[i] += e.weight * contract_left(g, contract_right(C[q], g));
      }
    }
  }
  return all;
}

Model make_springs(const Mesh& mesh) {
  std::vector<Spring> springs;
  for (const Tetrahedron& t : mesh.tetrahedra) springs.push_back({t[0], t[1]});
  return make_spring_model(mesh.nodes, springs, {100.0, 0.3}, 0.1);
}

// Edges are 0.25 long: at 0.15 many elements are inverted, some nearly flat.
class BlockRunsAt : public testing::TestWithParam<double> {};

TEST_P(BlockRunsAt, AgreeWithTheElementsOneByOne) {
  const Mesh mesh = make_beam({4, 2, 3}, {1.0, 0.5, 0.75});
  for (const InstructionSet& set : all_instruction_sets()) {
    const OnlyInstructionSet only(set.target);
    for (const Law& law : laws()) {
      for (const bool quadratic : {false, true}) {
        Model model =
            quadratic ? make_quadratic_model(mesh, {.law = law.name}) : make_beam_model(mesh, {.law = law.name});
        model.bodies[0].stiffness_damping = 0.01;
        const Subject subject(model, GetParam());
        const std::string what = set.name + " " + std::string(law.name) + (quadratic ? " tet10" : "");
        const Blocks expected = quadratic ? calc_expected<QuadraticShape>(subject.model, subject.x)
                                          : calc_expected<LinearShape>(subject.model, subject.x);
        EXPECT_LE(calc_difference(subject.calc(), expected), 1e-13) << what;
        EXPECT_LE(calc_difference(subject.calc_damping(), subject.calc_plain_damping()), 1e-13) << what;
        if (law.kernel == LawKernel::corotational) continue;  // positive already, in its own way
        EXPECT_LE(calc_difference(subject.calc_positive(), subject.calc_plain()), 1e-13) << what;
      }
    }
  }
}

TEST_P(BlockRunsAt, AgreeWithTheSpringsOneByOne) {
  for (const InstructionSet& set : all_instruction_sets()) {
    const OnlyInstructionSet only(set.target);
    const Subject subject(make_springs(make_beam({4, 2, 3}, {1.0, 0.5, 0.75})), GetParam());
    EXPECT_LE(calc_difference(subject.calc(), subject.calc_plain()), 1e-13) << set.name;
    EXPECT_LE(calc_difference(subject.calc_damping(), subject.calc_plain_damping()), 1e-13) << set.name;
  }
}

// However it is deformed, and for all of Poisson's ratios.
TEST_P(BlockRunsAt, OfTheCorotationalLawArePositiveAndNotBelowTheExactOnes) {
  for (const double poisson : {-0.5, 0.0, 0.3, 0.49}) {
    const Subject subject(make_beam_model(make_beam({4, 2, 3}, {1.0, 0.5, 0.75}), {.poisson = poisson}), GetParam());
    BlockMatrix exact = subject.system.make_matrix();
    exact.set_zero();
    subject.system.add_stiffness(subject.x, 1.0, Tangent::exact, exact);
    const Blocks blocks = subject.calc();
    for (std::int32_t i = 0; i < exact.rows(); ++i) {
      const Mat3& K = blocks.K[static_cast<std::size_t>(i)];
      const Eigen::SelfAdjointEigenSolver<Mat3> above(K - exact.diagonal(i), Eigen::EigenvaluesOnly);
      const Eigen::SelfAdjointEigenSolver<Mat3> whole(K, Eigen::EigenvaluesOnly);
      EXPECT_GE(above.eigenvalues()[0], -1e-12 * K.norm()) << poisson;
      EXPECT_GT(whole.eigenvalues()[0], 0.0) << poisson;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Strains, BlockRunsAt, testing::Values(0.002, 0.03, 0.15));

// Collapsed to a point, a line and a plane.
TEST(BlockRuns, AreFiniteAndPositiveOfCollapsedElements) {
  for (const double poisson : {0.0, 0.3, 0.49}) {
    Subject subject(make_beam_model(make_beam({2, 2, 2}, {1.0, 1.0, 1.0}), {.poisson = poisson}), 0.0);
    for (const Vec3& s : {Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(1, 1, 0), Vec3(5, 1, -1), Vec3(-1, -1, -1)}) {
      for (std::int64_t i = 0; i < subject.model.particle_count(); ++i) {
        block3(subject.x, i) = s.cwiseProduct(block3(subject.model.rest_positions, i));
      }
      for (const Mat3& K : subject.calc().K) {
        ASSERT_TRUE(K.allFinite());
        const Eigen::SelfAdjointEigenSolver<Mat3> solver(K, Eigen::EigenvaluesOnly);
        EXPECT_GT(solver.eigenvalues()[0], 0.0) << s.transpose();
      }
    }
  }
}

TEST(BlockRuns, OfSpringsWithCoincidentEndsAreThoseOfTheAxis) {
  Subject subject(make_spring_model({{0, 0, 0}, {1, 0, 0}}, {{0, 1}}, {100.0, 0.3}, 0.1), 0.0);
  subject.x.setZero();
  EXPECT_LE(calc_difference(subject.calc(), subject.calc_plain()), 1e-15);
}

TEST(BlockRuns, HaveTheSameBitsOnEveryInstructionSetWithFusedMultiplyAdd) {
  const Mesh mesh = make_beam({6, 5, 7}, {1.0, 0.5, 0.75});
  std::vector<Model> models{make_springs(mesh)};
  for (const Law& law : laws()) {
    models.push_back(make_beam_model(mesh, {.law = law.name}));
    models.push_back(make_quadratic_model(mesh, {.law = law.name}));
  }
  for (Model& model : models) {
    model.bodies[0].stiffness_damping = 0.01;
    const Subject subject(model, 0.05);
    std::vector<Blocks> elastic, damping;
    for (const InstructionSet& set : fused_instruction_sets()) {
      const OnlyInstructionSet only(set.target);
      elastic.push_back(subject.calc());
      damping.push_back(subject.calc_damping());
      EXPECT_TRUE(elastic.front() == elastic.back()) << set.name;
      EXPECT_TRUE(damping.front() == damping.back()) << set.name;
    }
  }
}

}  // namespace
}  // namespace flexcast::test
