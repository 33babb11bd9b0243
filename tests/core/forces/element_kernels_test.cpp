// The loops in lanes do what element.h and the laws' own functions say, element by element, on every instruction set.
#include <gtest/gtest.h>

#include "core/base/parallel.h"
#include "core/forces/element.h"
#include "core/forces/kelvin_voigt.h"
#include "tests/support/dense.h"
#include "tests/support/instruction_set.h"
#include "tests/support/model.h"
#include "tests/support/random.h"

namespace flexcast::test {
namespace {

// The plain way: every element by itself.
template <class Shape>
struct Plain {
  VecX force, damping;
  double energy = 0.0, power = 0.0;
  BlockMatrix stiffness, clamped, viscosity;
};

template <class Shape>
Plain<Shape> calc_plain(const Model& model, const System& system, const VecX& x, const VecX& v) {
  constexpr auto points = static_cast<std::size_t>(Shape::points);
  const Body& body = model.bodies[0];
  const Lame lame = calc_lame(body.young, body.poisson);
  const Lame viscosity{body.stiffness_damping * lame.mu, body.stiffness_damping * lame.lambda};
  const bool small = body.law->small_strain;
  Plain<Shape> plain;
  plain.force = plain.damping = VecX::Zero(x.size());
  for (BlockMatrix* matrix : {&plain.stiffness, &plain.clamped, &plain.viscosity}) {
    *matrix = system.make_matrix();
    matrix->set_zero();
  }
  for (std::int32_t t = 0; t < body.tetrahedra.count; ++t) {
    const auto e = make_element<Shape>(model, body, t);
    std::array<Mat3, points> F, rate, P;
    std::array<Mat9, points> C;
    std::array<double, points> Psi;
    e.calc_gradients(x, F);
    e.calc_gradients(v, rate);
    body.law->calc_energy(lame, F, Psi);
    for (const double density : Psi) plain.energy += e.weight * density;
    body.law->calc_stress(lame, F, P);
    add_stress_forces<Shape>(e, P, plain.force);
    body.law->calc_tangent(lame, Tangent::exact, F, C);
    add_tangent_blocks<Shape>(e, C, 1.0, plain.stiffness);
    body.law->calc_tangent(lame, Tangent::positive_semidefinite, F, C);
    add_tangent_blocks<Shape>(e, C, 1.0, plain.clamped);
    for (std::size_t q = 0; q < points; ++q) {
      P[q] = calc_kelvin_voigt_stress(viscosity, small, F[q], rate[q]);
      C[q] = calc_kelvin_voigt_tangent(viscosity, small, F[q]);
      plain.power += e.weight * P[q].cwiseProduct(rate[q]).sum();
    }
    add_stress_forces<Shape>(e, P, plain.damping);
    add_tangent_blocks<Shape>(e, C, 1.0, plain.viscosity);
  }
  return plain;
}

void expect_same(const BlockMatrix& matrix, const BlockMatrix& expected, const std::string& what) {
  const Eigen::MatrixXd A = to_dense(matrix), B = to_dense(expected);
  EXPECT_LE((A - B).norm(), 1e-13 * B.norm()) << what;
}

template <class Shape>
void expect_plain(Model model, const VecX& x, const VecX& v, const std::string& what) {
  update_masses(model);
  const System system(model);
  const auto plain = calc_plain<Shape>(model, system, x, v);
  VecX f;
  system.calc_conservative(x, f);
  EXPECT_LE((f - plain.force).norm(), 1e-13 * plain.force.norm()) << what;
  EXPECT_NEAR(system.calc_energy(EnergyKind::elastic, x), plain.energy, 1e-13 * plain.energy) << what;
  const double power = system.calc_damping(x, v, f);
  EXPECT_LE((f - plain.damping).norm(), 1e-13 * plain.damping.norm()) << what;
  EXPECT_NEAR(power, plain.power, 1e-13 * plain.power) << what;

  BlockMatrix matrix = system.make_matrix();
  matrix.set_zero();
  system.add_stiffness(x, 1.0, Tangent::exact, matrix);
  expect_same(matrix, plain.stiffness, what + " stiffness");
  matrix.set_zero();
  system.add_stiffness(x, 1.0, Tangent::positive_semidefinite, matrix);
  expect_same(matrix, plain.clamped, what + " clamped stiffness");
  matrix.set_zero();
  system.add_damping_matrix(x, 1.0, matrix);
  expect_same(matrix, plain.viscosity, what + " damping matrix");
}

// Strained by about `amount`, turned as a whole by a radian.
VecX deform(const VecX& rest, double amount, std::uint64_t seed) {
  SplitMix64 random(seed);
  const Mat3 turn = Eigen::AngleAxisd(1.0, Vec3(1, 2, 3).normalized()).toRotationMatrix();
  VecX x = rest + make_random_vector(random, rest.size(), amount);
  for (std::int64_t i = 0; i < x.size() / 3; ++i) block3(x, i) = turn * block3(x, i);
  return x;
}

// Edges are 0.25 long: at 0.15 many elements are inverted, some nearly flat.
class ElementKernels : public testing::TestWithParam<double> {};

TEST_P(ElementKernels, AgreeWithThePlainLawOfEveryElement) {
  const double amount = GetParam();
  const Mesh mesh = make_beam({4, 2, 3}, {1.0, 0.5, 0.75});
  for (const InstructionSet& set : all_instruction_sets()) {
    const OnlyInstructionSet only(set.target);
    for (const Law& law : laws()) {
      const std::string what = set.name + " " + std::string(law.name) + " at " + std::to_string(amount);
      Model linear = make_beam_model(mesh, {.law = law.name}),
            quadratic = make_quadratic_model(mesh, {.law = law.name});
      for (Model* model : {&linear, &quadratic}) {
        model->bodies[0].stiffness_damping = 0.01;
        const VecX x = deform(model->rest_positions, amount, 1), v = deform(model->rest_positions, 0.3, 2);
        if (model == &linear) {
          expect_plain<LinearShape>(*model, x, v, what);
        } else {
          expect_plain<QuadraticShape>(*model, x, v, what + " tet10");
        }
      }
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Strains, ElementKernels, testing::Values(0.002, 0.03, 0.15));

// One element whose stretches are given: mirrored, flat, a line, a point. Where no rotation is nearest any will do, so
// that the corotational force is one of many.
struct Singular {
  Vec3 stretches;
  bool unique = true;
};

TEST(ElementKernels, AgreeWithThePlainLawOfSingularElements) {
  const std::vector<Singular> all{{{1, 1, -1}, false}, {{1, 1, 0}},         {{1, 0.5, -0.5}, false}, {{1, 0, 0}, false},
                                  {{0, 0, 0}, false},  {{2, 1, -1}, false}, {{1, 0.9, -0.1}},        {{3, 1e-3, 1e-3}},
                                  {{1, 1e-2, 1e-2}},   {{-2, -3, -4}},      {{1, 1, -0.99}}};
  const Points tet{{0, 0, 0}, {1.1, 0.1, 0}, {-0.1, 0.9, 0.2}, {0.1, 0, 1.2}};
  const Mat3 U = Eigen::AngleAxisd(0.7, Vec3(3, -1, 2).normalized()).toRotationMatrix();
  const Mat3 V = Eigen::AngleAxisd(-1.2, Vec3(1, 1, -2).normalized()).toRotationMatrix();
  for (const Law& law : laws()) {
    Model model = make_tet_model(tet, {{0, 1, 2, 3}}, {.law = law.name});
    update_masses(model);
    const System system(model);
    for (const auto& [s, unique] : all) {
      VecX x = model.rest_positions, f;
      const Mat3 F = U * s.asDiagonal() * V.transpose();
      for (int i = 0; i < 4; ++i) block3(x, i) = F * tet[static_cast<std::size_t>(i)];
      const auto plain = calc_plain<LinearShape>(model, system, x, VecX::Zero(12));
      const double young = model.bodies[0].young;
      system.calc_conservative(x, f);
      EXPECT_TRUE(f.allFinite()) << law.name << " " << s.transpose();
      if (unique || law.kernel != LawKernel::corotational) {
        EXPECT_LE((f - plain.force).norm(), 1e-13 * (plain.force.norm() + young)) << law.name << " " << s.transpose();
      }
      EXPECT_NEAR(system.calc_energy(EnergyKind::elastic, x), plain.energy, 1e-13 * plain.energy + 1e-20 * young)
          << law.name << " " << s.transpose();
    }
  }
}

TEST(ElementKernels, OfARigidMotionGiveForcesOfRoundingOnly) {
  for (const Law& law : laws()) {
    if (law.small_strain) continue;
    Model model = make_beam_model(make_beam({4, 2, 3}, {1.0, 0.5, 0.75}), {.law = law.name});
    update_masses(model);
    const System system(model);
    VecX f;
    system.calc_conservative(deform(model.rest_positions, 0.0, 1), f);
    EXPECT_LE(f.lpNorm<Eigen::Infinity>(), 1e-14 * model.bodies[0].young) << law.name;
  }
}

struct Results {
  VecX force, damping, values;
  double energy = 0.0, power = 0.0;
  bool operator==(const Results&) const = default;
};

Results calc_results(const System& system, const VecX& x, const VecX& v) {
  Results results;
  system.calc_force(x, v, results.force);
  results.power = system.calc_damping(x, v, results.damping);
  results.energy = system.calc_potential(x);
  BlockMatrix matrix = system.make_matrix();
  matrix.set_zero();
  system.add_stiffness(x, 1.0, Tangent::positive_semidefinite, matrix);
  system.add_stiffness(x, 1.0, Tangent::exact, matrix);
  system.add_damping_matrix(x, 0.1, matrix);
  results.values = Eigen::Map<const VecX>(matrix.values(), 9 * matrix.block_count());
  return results;
}

std::vector<Model> make_all_models() {
  const Mesh mesh = make_beam({6, 5, 7}, {1.0, 0.5, 0.75});
  std::vector<Model> models;
  for (const Law& law : laws()) {
    models.push_back(make_beam_model(mesh, {.law = law.name}));
    models.push_back(make_quadratic_model(mesh, {.law = law.name}));
  }
  for (Model& model : models) model.bodies[0].stiffness_damping = 0.01;
  std::vector<Spring> springs;
  for (const Tetrahedron& t : mesh.tetrahedra) springs.push_back({t[0], t[1]});
  models.push_back(make_spring_model(mesh.nodes, springs, {100.0, 0.3}, 0.1));
  for (Model& model : models) update_masses(model);
  return models;
}

TEST(ElementKernels, GiveTheSameBitsOnEveryInstructionSetWithFusedMultiplyAdd) {
  for (const Model& model : make_all_models()) {
    const System system(model);
    const VecX x = deform(model.rest_positions, 0.05, 3), v = deform(model.rest_positions, 0.3, 4);
    std::vector<Results> results;
    for (const InstructionSet& set : fused_instruction_sets()) {
      const OnlyInstructionSet only(set.target);
      results.push_back(calc_results(system, x, v));
      EXPECT_TRUE(results.front() == results.back()) << set.name << (model.bodies[0].law ? " tetrahedra" : " springs");
    }
  }
}

TEST(ElementKernels, GiveTheSameBitsForAnyNumberOfThreads) {
  for (const Model& model : make_all_models()) {
    const System system(model);
    const VecX x = deform(model.rest_positions, 0.05, 3), v = deform(model.rest_positions, 0.3, 4);
    const Results alone = calc_results(system, x, v);
    for (const int threads : {2, 3}) {
      set_thread_count(threads);
      const Results together = calc_results(system, x, v);
      set_thread_count(1);
      EXPECT_TRUE(alone == together) << threads << " threads";
    }
  }
}

}  // namespace
}  // namespace flexcast::test
