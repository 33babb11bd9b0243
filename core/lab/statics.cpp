#include "core/lab/statics.h"

#include <algorithm>
#include <cmath>

namespace flexcast {
namespace {

constexpr double aimed_tolerance = 1e-13;
constexpr std::int64_t iterations_per_step = 100;

// So many that each turns a handle by at most 0.2 rad and moves it by at most a twentieth of its body.
int count_increments(const Model& model) {
  double most = 1.0;
  for (const Handle& handle : model.handles) {
    const IndexRange range = model.bodies[static_cast<std::size_t>(handle.body)].particles;
    const Eigen::Map<const Eigen::Matrix3Xd> rest(model.rest_positions.data() + 3 * range.first, 3, range.count);
    const double size = (rest.rowwise().maxCoeff() - rest.rowwise().minCoeff()).norm();
    most = std::max({most, handle.rotate.norm() / 0.2, handle.translate.norm() / (0.05 * size)});
  }
  return static_cast<int>(std::ceil(std::min(most, 1e4)));
}

}  // namespace

bool solve_static(Simulation& simulation, const StaticOptions& options) {
  const double wanted = simulation.settings().solver.newton_tolerance;
  const int increments = count_increments(simulation.model());
  std::vector<ParameterAssignment> values = {{"time.integrator", std::string("quasi_static")},
                                             {"time.substeps", std::int64_t{1}},
                                             {"time.tolerance", 0.0},
                                             {"time.budget", 0.0},
                                             {"time.step", 1.0 / increments},
                                             {"solver.newton_tolerance", std::min(wanted, aimed_tolerance)},
                                             {"solver.newton_iterations", iterations_per_step}};
  for (const Handle& handle : simulation.model().handles) {
    values.push_back({"handle." + handle.name + ".start", simulation.state().time});
    values.push_back({"handle." + handle.name + ".duration", 1.0});
  }
  const auto set = simulation.set_parameters(values);
  FLEXCAST_CHECK(set.ok());
  const auto is_stopped = [&] { return options.stop && options.stop->load(std::memory_order_relaxed); };
  for (int i = 0; i < increments && !is_stopped(); ++i) {
    if (!simulation.step()) return false;
  }
  const auto is_found = [&] { return simulation.statistics().converged || simulation.statistics().residual <= wanted; };
  for (int i = 0; i < options.most_steps && !is_found() && !is_stopped(); ++i) {
    if (!simulation.step()) return false;
  }
  return is_found();
}

}  // namespace flexcast
