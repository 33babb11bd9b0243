// B09, B11, B12, B19: frequencies and wave speeds of solids.
#include <gtest/gtest.h>

#include <numbers>

#include "tests/reference/modes.h"
#include "tests/reference/statics.h"
#include "tests/reference/tables.h"
#include "tests/support/dense.h"

namespace flexcast::test {
namespace {

TEST(Reference, B09_LimitOfTheCornerTetrahedronIsTheClosedForm) {
  for (const auto& [poisson, critical] :
       {std::pair{0.0, 0.0158113883008419}, {0.3, 0.0128750564301162}, {0.49, 0.0031515771608408}}) {
    for (const ReferenceLaw& law : reference_laws()) {
      SCOPED_TRACE(concat(law.law, " nu=", poisson));
      const Model model = make_tet_model(corner_tet(), {{0, 1, 2, 3}},
                                         {.law = law.law, .young = 1e6, .poisson = poisson, .density = 1000.0});
      const Eigen::MatrixXd K = calc_stiffness(model, model.rest_positions);
      const double mass = 1000.0 / 24.0;
      const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(K, Eigen::EigenvaluesOnly);
      EXPECT_NEAR(2.0 / std::sqrt(solver.eigenvalues()[11] / mass), critical, 1e-12 * critical);
      const auto simulation =
          make_simulation(model, make_settings("symplectic_euler", 1e-4), make_state(model.rest_positions));
      EXPECT_LE(simulation->calc_stable_step(), critical * (1.0 + 1e-14));
      EXPECT_GE(simulation->calc_stable_step(), 0.3 * critical);
    }
  }
}

// nu = 0, 1 x 0.1 x 0.1 m, E = 1e6 Pa, 1000 kg/m^3.
Model make_bar(std::array<int, 3> cells, bool quadratic = false) {
  return make_clamped_bar({.cells = cells,
                           .size = {1.0, 0.1, 0.1},
                           .elastic = {.law = "corotational", .young = 1e6, .poisson = 0.0, .density = 1000.0},
                           .quadratic = quadratic});
}

constexpr double axial = 7.90569415;  // Hz, c / (4 L)

TEST(Reference, B11_LinearTetrahedraRingAsTheirDigitsSay) {
  const std::vector<std::pair<std::array<int, 3>, std::vector<double>>> rows = {
      {{20, 2, 2}, {0.6419754320, 0.7325947071, 3.830550881, 4.305529989, 6.369173876, 7.903470562}},
      {{40, 4, 4}, {0.5450133404, 0.5733571789, 3.283708868, 3.441857565, 5.660186338, 7.905148426}}};
  for (const auto& [cells, expected] : rows) {
    const std::vector<double> found = calc_lowest_frequencies(make_bar(cells), 6);
    for (std::size_t k = 0; k < 6; ++k) EXPECT_NEAR(found[k], expected[k], 1e-6 * expected[k]) << cells[0] << " " << k;
  }
}

// Two bending pairs and the axial mode of the published solid, within 1 %; torsion, between them, feels the lumped
// mass.
TEST(Reference, B11_QuadraticTetrahedraRingAsTheSolid) {
  const std::vector<double> found = calc_lowest_frequencies(make_bar({20, 2, 2}, true), 6);
  for (const auto& [k, expected] : {std::pair{0, 0.50752}, {1, 0.50752}, {2, 3.0650}, {3, 3.0650}, {5, axial}}) {
    EXPECT_NEAR(found[static_cast<std::size_t>(k)], expected, 0.01 * expected) << k;
  }
}

TEST(Reference, B12_AxialFrequencyIsThatOfTheBarsWaveSpeed) {
  EXPECT_NEAR(std::sqrt(1e6 / 1000.0) / 4.0, axial, 1e-8);
  EXPECT_NEAR(calc_lowest_frequencies(make_bar({20, 2, 2}), 6)[5], axial, 3e-4 * axial);
}

// The clamped bar with nu = 0.3 of two meshes: the largest frequency, the limit, and what single elements say of it.
struct MeshLimit {
  int refinement;
  double omega, critical, element_bound;  // rad/s, s, s
};

TEST(Reference, B19_LargestFrequencyOfFineMeshesIsBoundedByTheirElements) {
  for (const MeshLimit& row :
       {MeshLimit{1, 2214.947526, 9.029559286e-4, 6.657710438e-4}, {2, 4387.677048, 4.558220621e-4, 3.328855219e-4}}) {
    const int n = row.refinement;
    const Elastic elastic{.law = "corotational", .young = 1e6, .poisson = 0.3, .density = 1000.0};
    const Mesh mesh = make_beam({20 * n, 2 * n, 2 * n}, {1.0, 0.1, 0.1});
    Model model = make_beam_model(mesh, elastic);
    hold(model, [](const Vec3& X) { return X.x() == 0.0; });
    const double omega = calc_largest_omega(make_scaled_stiffness(model, model.rest_positions));
    EXPECT_NEAR(omega, row.omega, 1e-8 * row.omega);
    EXPECT_NEAR(2.0 / omega, row.critical, 1e-8 * row.critical);
    double bound = 1.0;
    for (int e = 0; e < 6; ++e) {
      Points corners;
      for (const std::int32_t node : mesh.tetrahedra[static_cast<std::size_t>(e)]) {
        corners.push_back(mesh.nodes[static_cast<std::size_t>(node)]);
      }
      const Model element = make_tet_model(corners, {{0, 1, 2, 3}}, elastic);
      const Eigen::MatrixXd A = make_scaled_stiffness(element, element.rest_positions);
      const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(A, Eigen::EigenvaluesOnly);
      bound = std::min(bound, 2.0 / std::sqrt(solver.eigenvalues()[11]));
    }
    EXPECT_NEAR(bound, row.element_bound, 1e-9 * row.element_bound);
    const auto simulation =
        make_simulation(model, make_settings("symplectic_euler", 1e-4), make_state(model.rest_positions));
    EXPECT_LE(simulation->calc_stable_step(), row.critical);
    EXPECT_GE(simulation->calc_stable_step(), row.element_bound);
  }
}

// The first time at which where(X) has moved by a part of `size`, on average, s.
template <class Where>
double measure_arrival(Simulation& simulation, Where where, double size) {
  const auto particles = find_particles(simulation.model(), where);
  while (simulation.state().time < 1.0) {
    run(simulation, 1);
    double mean = 0.0;
    for (const std::int64_t i : particles)
      mean += displacement(simulation, i).norm() / static_cast<double>(particles.size());
    if (mean > size) return simulation.state().time;
  }
  return 1.0;
}

// A bar whose lateral motion is held carries the wave of the constrained modulus; nu = 0 makes it E.
TEST(Reference, B12_KickTravelsToTheOtherEndWithTheWaveSpeed) {
  const int cells = 50;
  for (const auto& [poisson, speed] : {std::pair{0.0, 31.6227766}, {0.3, 36.68996929}}) {
    Model model = make_beam_model(make_beam({cells, 1, 1}, {1.0, 0.02, 0.02}),
                                  {.law = "corotational", .young = 1e6, .poisson = poisson, .density = 1000.0});
    for (const int axis : {1, 2})
      hold(
          model, [](const Vec3&) { return true; }, axis);
    const double step = 1e-5, push = 1e-3;
    VecX v = VecX::Zero(model.rest_positions.size());
    for (const std::int64_t i : find_particles(model, [](const Vec3& X) { return X.x() == 0.0; })) v[3 * i] = push;
    auto simulation =
        make_simulation(model, make_settings("velocity_verlet", step), make_state(model.rest_positions, v));
    // Half the displacement that the kick leaves behind its front: momentum over rho c A.
    const double mass = 1000.0 * 0.02 * 0.02 * 0.02 * 0.5, left = push * mass / (1000.0 * speed * 0.02 * 0.02);
    const double arrival = measure_arrival(
        *simulation, [](const Vec3& X) { return X.x() > 1.0 - 1e-9; }, left);
    EXPECT_NEAR(arrival * speed, 1.0, 1.0 / cells) << poisson;
  }
}

// A chain along x at rest: its wave of wave number q has the frequency 2 sqrt(k/m) sin(q a / 2).
TEST(Reference, B12_ChainsCarryWavesWithTheirDispersion) {
  const int springs = 32;
  const double k = 1000.0, m = 0.1, a = 0.1;
  const Mesh mesh = make_rope(springs, springs * a);
  Model model = make_spring_model(mesh.nodes, mesh.springs, {.stiffness = k * a}, m);
  hold(model, [&](const Vec3& X) { return X.x() == 0.0 || X.x() > springs * a - 1e-9; });
  const Eigen::SparseMatrix<double> scaled = make_scaled_stiffness(model, model.rest_positions);
  // Sideways an unstretched chain has no stiffness: only the axial part.
  Eigen::MatrixXd axial_part(springs - 1, springs - 1);
  for (int i = 0; i < springs - 1; ++i) {
    for (int j = 0; j < springs - 1; ++j) axial_part(i, j) = scaled.coeff(3 * i, 3 * j);
  }
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(axial_part, Eigen::EigenvaluesOnly);
  for (int p = 1; p < springs; ++p) {
    const double q = p * std::numbers::pi / (springs * a);
    const double expected = 2.0 * std::sqrt(k / m) * std::sin(0.5 * q * a);
    EXPECT_NEAR(std::sqrt(solver.eigenvalues()[p - 1]), expected, 1e-12 * 200.0) << p;
    // Long waves run with a sqrt(k / m).
    if (p == 1) {
      EXPECT_NEAR(expected / q, a * std::sqrt(k / m), 1e-3 * a * std::sqrt(k / m));
    }
  }
}

}  // namespace
}  // namespace flexcast::test
