#include "core/integrators/particle_passes.h"

#include "core/base/parallel.h"
#include "core/integrators/handle_work.h"
#include "core/integrators/particle_kernels.h"

namespace flexcast {
namespace {

constexpr std::int64_t block = 3 * 1024;  // numbers

// The books of a kernel's work over `count` numbers.
template <class Arrays>
double sum_blocks(double (*kernel)(const Arrays&, std::int64_t, std::int64_t), const Arrays& arrays, std::int64_t count,
                  std::vector<double>& partial) {
  return parallel_sum(count, block, partial,
                      [&](std::int64_t first, std::int64_t end) { return kernel(arrays, first, end); });
}

KickArrays make_kick(const System& system, double h, const VecX& F, const VecX& v0, VecX& v1) {
  v1.resize(v0.size());
  return {system.inverse_masses().data(), F.data(), v0.data(), v1.data(), h};
}

void add_drift(KickArrays& arrays, double h, const VecX& x0, VecX& x1) {
  x1.resize(x0.size());
  arrays.x0 = x0.data();
  arrays.x1 = x1.data();
  arrays.drift = h;
}

}  // namespace

void ParticlePasses::find_friction(const System& system, const VecX& x) {
  points_.clear();
  if (system.has_friction()) system.find_friction_points(x, points_);
}

void ParticlePasses::kick(const System& system, double h, const VecX& F, const VecX& x, const VecX& v0, VecX& v1,
                          StepStatistics& statistics) {
  find_friction(system, x);
  statistics.force_work += sum_blocks(run_kick, make_kick(system, h, F, v0, v1), F.size(), partial_);
  system.apply_friction(h, points_, F, v1, statistics);
}

void ParticlePasses::drift(double h, const VecX& v, const VecX& x0, VecX& x1, StepStatistics& statistics) {
  x1.resize(x0.size());
  statistics.force_work += sum_blocks(run_drift, {v.data(), x0.data(), x1.data(), h}, v.size(), partial_);
}

void ParticlePasses::kick_and_drift(const System& system, KickAndDrift h, const VecX& F, const State& from, State& to,
                                    StepStatistics& statistics) {
  if (system.has_friction()) {  // it comes in between
    kick(system, h.kick, F, from.positions, from.velocities, to.velocities, statistics);
    drift(h.drift, to.velocities, from.positions, to.positions, statistics);
    return;
  }
  KickArrays arrays = make_kick(system, h.kick, F, from.velocities, to.velocities);
  add_drift(arrays, h.drift, from.positions, to.positions);
  statistics.force_work += sum_blocks(run_kick, arrays, F.size(), partial_);
}

void ParticlePasses::drift_and_kick(const System& system, double h, const VecX& F, const State& from, State& to,
                                    StepStatistics& statistics) {
  find_friction(system, from.positions);
  KickArrays arrays = make_kick(system, h, F, from.velocities, to.velocities);
  add_drift(arrays, h, from.positions, to.positions);
  arrays.by_old_velocities = true;
  statistics.force_work += sum_blocks(run_kick, arrays, F.size(), partial_);
  system.apply_friction(h, points_, F, to.velocities, statistics);
}

void ParticlePasses::follow(const System& system, double h, const DisplacementRule& rule, const VecX& base,
                            const VecX& u, const VecX& F, State& state, StepStatistics& statistics) {
  statistics.force_work += h * calc_handle_power(system, F, state.velocities);
  const FollowArrays arrays{
      system.masses().data(), system.free().data(),    base.data(), u.data(),  state.velocities.data(),
      state.positions.data(), state.velocities.data(), rule.reach,  rule.time, rule.past};
  statistics.force_work += sum_blocks(run_follow, arrays, u.size(), partial_);
  move_handles(system, state.time + h, h, F, state.positions, state.velocities, statistics);
}

}  // namespace flexcast
