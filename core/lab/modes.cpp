#include "core/lab/modes.h"

#include <Spectra/SymEigsShiftSolver.h>
#include <Spectra/SymEigsSolver.h>

#include <Spectra/MatOp/SparseSymMatProd.h>
#include <Eigen/Eigenvalues>
#include <Eigen/SparseCholesky>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <nlohmann/json.hpp>
#include <numbers>
#include <ostream>

#include "core/forces/system.h"
#include "core/lab/statics.h"
#include "core/scene/scene.h"

namespace flexcast {
namespace {

using Sparse = Eigen::SparseMatrix<double>;
constexpr Eigen::Index largest_dense = 600;
constexpr double tolerance = 1e-11;

// M^-1/2 K M^-1/2 over the free degrees of freedom.
Sparse make_scaled_stiffness(const Simulation& simulation) {
  const System system(simulation.model());
  BlockMatrix K = system.make_matrix();
  K.set_zero();
  system.add_stiffness(simulation.state().positions, 1.0, Tangent::exact, K);
  const VecX roots = system.inverse_masses().cwiseSqrt();
  std::vector<Eigen::Index> number(static_cast<std::size_t>(system.dofs()), -1);
  Eigen::Index count = 0;
  for (Eigen::Index i = 0; i < system.dofs(); ++i) {
    if (roots[i] > 0.0) number[static_cast<std::size_t>(i)] = count++;
  }
  std::vector<Eigen::Triplet<double>> entries;
  for (std::int32_t row = 0; row < K.rows(); ++row) {
    for (std::size_t k = 0; k < K.columns(row).size(); ++k) {
      for (int a = 0; a < 3; ++a) {
        for (int b = 0; b < 3; ++b) {
          const Eigen::Index i = 3 * row + a, j = 3 * K.columns(row)[k] + b;
          const Eigen::Index to = number[static_cast<std::size_t>(i)], from = number[static_cast<std::size_t>(j)];
          if (to >= 0 && from >= 0) entries.emplace_back(to, from, roots[i] * K.blocks(row)[k](a, b) * roots[j]);
        }
      }
    }
  }
  Sparse A(count, count);
  A.setFromTriplets(entries.begin(), entries.end());
  return A;
}

// x -> (A - shift)^-1 x, as Spectra asks for it.
class ShiftedInverse {
 public:
  using Scalar = double;
  explicit ShiftedInverse(const Sparse& A) : A_(A) {}
  Eigen::Index rows() const { return A_.rows(); }
  Eigen::Index cols() const { return A_.cols(); }
  void set_shift(double shift) {
    Sparse identity(A_.rows(), A_.cols());
    identity.setIdentity();
    factor_.compute(A_ - shift * identity);
  }
  void perform_op(const double* x, double* y) const {
    Eigen::Map<VecX>(y, rows()) = factor_.solve(Eigen::Map<const VecX>(x, rows()));
  }

 private:
  const Sparse& A_;
  Eigen::SimplicialLDLT<Sparse> factor_;
};

Result<double> calc_largest(const Sparse& A) {
  Spectra::SparseSymMatProd<double> product(A);
  Spectra::SymEigsSolver<Spectra::SparseSymMatProd<double>> solver(product, 1, 20);
  solver.init();
  if (solver.compute(Spectra::SortRule::LargestAlge, 3000, tolerance) < 1) {
    return Error{"the largest frequency was not found: the iteration did not converge"};
  }
  return solver.eigenvalues()[0];
}

Result<VecX> calc_lowest(const Sparse& A, int count, double largest) {
  ShiftedInverse inverse(A);
  const int vectors = std::min<int>(static_cast<int>(A.rows()), std::max(2 * count + 20, 40));
  // A little below zero, so that rigid modes do not make it singular.
  Spectra::SymEigsShiftSolver<ShiftedInverse> solver(inverse, count, vectors, -1e-9 * largest);
  solver.init();
  if (solver.compute(Spectra::SortRule::LargestMagn, 3000, tolerance) < count) {
    return Error{"the lowest frequencies were not found: the iteration did not converge; ask for another --count"};
  }
  return VecX(solver.eigenvalues());
}

double calc_frequency(double lambda, double largest) {
  if (std::abs(lambda) <= 1e-12 * largest) return 0.0;
  return std::copysign(std::sqrt(std::abs(lambda)), lambda) / (2.0 * std::numbers::pi);
}

void print_text(const Modes& modes, std::ostream& out) {
  char line[160];
  for (std::size_t i = 0; i < modes.frequencies.size(); ++i) {
    std::snprintf(line, sizeof line, "mode %3zu  %.9g Hz%s\n", i + 1, modes.frequencies[i],
                  modes.frequencies[i] < 0.0 ? "  (unstable)" : "");
    out << line;
  }
  std::snprintf(line, sizeof line, "largest   %.9g Hz, explicit step up to %.9g s\n", modes.largest_frequency,
                modes.explicit_step);
  out << line << std::flush;
}

nlohmann::ordered_json make_json(const Modes& modes) {
  const bool limited = std::isfinite(modes.explicit_step);
  return {{"frequencies", modes.frequencies},
          {"largest_frequency", modes.largest_frequency},
          {"explicit_step", limited ? nlohmann::ordered_json(modes.explicit_step) : nlohmann::ordered_json(nullptr)}};
}

}  // namespace

Result<Modes> calc_modes(const Simulation& simulation, int count) {
  const Sparse A = make_scaled_stiffness(simulation);
  if (A.rows() == 0) return Error{"the scene has no free particle: it has no modes"};
  const auto found = static_cast<int>(std::min<Eigen::Index>(count, A.rows()));
  VecX lowest;
  double largest = 0.0;
  if (A.rows() <= std::max<Eigen::Index>(largest_dense, 3 * found)) {
    lowest = Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(Eigen::MatrixXd(A), Eigen::EigenvaluesOnly).eigenvalues();
    largest = lowest[lowest.size() - 1];
  } else {
    const auto top = calc_largest(A);
    if (!top) return top.error();
    largest = top.value();
    auto bottom = calc_lowest(A, found, largest);
    if (!bottom) return bottom.error();
    lowest = std::move(bottom).value();
    std::sort(lowest.begin(), lowest.end());
  }
  Modes modes;
  for (int i = 0; i < found; ++i) modes.frequencies.push_back(calc_frequency(lowest[i], largest));
  modes.largest_frequency = calc_frequency(largest, largest);
  modes.explicit_step = largest > 0.0 ? 2.0 / std::sqrt(largest) : std::numeric_limits<double>::infinity();
  return modes;
}

int modes_verb(const ModesOptions& options, std::ostream& out, std::ostream& log) {
  const auto refuse = [&](const std::string& reason) {
    log << "flexcast-lab: " << reason << std::endl;
    return 1;
  };
  auto scene = load_scene(options.scene, options.overrides);
  if (!scene) return refuse(scene.error().message);
  Simulation& simulation = *scene.value().simulation;
  for (const std::string& note : scene.value().notes) log << "flexcast-lab: warning: " << note << std::endl;
  if (options.at_equilibrium && !solve_static(simulation, {.stop = options.stop})) {
    return refuse("the equilibrium was not found (residual " +
                  to_text(ParameterValue(simulation.statistics().residual)) + ")");
  }
  const auto modes = calc_modes(simulation, options.count);
  if (!modes) return refuse(modes.error().message);
  if (options.json) {
    out << make_json(modes.value()).dump(2) << std::endl;
  } else {
    print_text(modes.value(), out);
  }
  return out ? 0 : refuse("the modes cannot be written");
}

}  // namespace flexcast
