#include "core/lab/trade/trade_runner.h"

#include <algorithm>

#include "core/lab/bench/bench_timing.h"
#include "core/lab/trade/trade_energy.h"
#include "core/lab/trade/trade_volume.h"
#include "core/scene/scene.h"

namespace flexcast {

Result<std::unique_ptr<Simulation>> TradeRunner::load(const std::vector<std::string>& overrides) const {
  std::vector<std::string> all = options_.overrides;
  all.insert(all.end(), overrides.begin(), overrides.end());
  auto scene = load_scene(options_.scene, all);
  if (!scene) return scene.error();
  return std::move(scene.value().simulation);
}

Result<double> TradeRunner::probe(std::vector<std::string> overrides, std::optional<double> h,
                                  double most_seconds) const {
  if (h) {
    overrides.push_back("time.step=" + to_text(ParameterValue(*h)));
    overrides.emplace_back("time.substeps=1");
  }
  const auto simulation = load(overrides);
  if (!simulation) return simulation.error();
  constexpr int most_steps = 6;
  constexpr double enough = 0.02;  // s
  double sum = 0.0;
  std::vector<double> samples;
  for (int i = 0; i < most_steps && sum < enough && sum < most_seconds && !budget_.is_stopped(); ++i) {
    const double start = budget_.clock().now();
    const bool good = simulation.value()->step();
    budget_.clock().stepped(1);
    const double seconds = budget_.clock().now() - start;
    sum += seconds;
    samples.push_back(seconds);
    if (!good) break;
  }
  // The first step also makes what the others use.
  if (samples.size() > 1) samples.erase(samples.begin());
  return samples.empty() ? 0.0 : calc_median(std::move(samples));
}

TradeFrame TradeRunner::make_frame(const Simulation& simulation, std::size_t mesh) const {
  const std::vector<std::int64_t>& compared = meshes_.all[mesh].compared;
  const VecX& positions = simulation.state().positions;
  TradeFrame frame{VecX(3 * static_cast<Eigen::Index>(compared.size())), calc_volumes(simulation.model(), positions)};
  for (std::size_t i = 0; i < compared.size(); ++i)
    block3(frame.positions, static_cast<std::int64_t>(i)) = block3(positions, compared[i]);
  return frame;
}

Result<TradeRun> TradeRunner::record(const std::vector<std::string>& overrides, std::size_t mesh, double most_seconds,
                                     TradeFrames& frames) const {
  const auto loaded = load(overrides);
  if (!loaded) return loaded.error();
  Simulation& simulation = *loaded.value();
  frames = {make_frame(simulation, mesh), {}};
  return run_to_end(simulation, times_, budget_, most_seconds,
                    [&](std::size_t) { frames.at.push_back(make_frame(simulation, mesh)); });
}

Result<TradeRun> TradeRunner::compare(const std::vector<std::string>& overrides, std::size_t mesh, double most_seconds,
                                      const TradeFrames& reference, TradeErrors& errors) const {
  const auto loaded = load(overrides);
  if (!loaded) return loaded.error();
  Simulation& simulation = *loaded.value();
  // Books are looked at now and then: a look costs as much as many steps of a small scene.
  constexpr std::size_t looks = 10;
  const std::size_t stride = std::max<std::size_t>(times_.compared.size() / looks, 1);
  TradeEnergy energy;
  energy.add(simulation);
  const TradeRun run = run_to_end(simulation, times_, budget_, most_seconds, [&](std::size_t i) {
    add_frame(make_frame(simulation, mesh), reference.at[i], meshes_.probes, errors);
    if (i % stride == stride - 1 || i + 1 == times_.compared.size()) energy.add(simulation);
  });
  errors.energy = energy.calc_error();
  return run;
}

Result<TradeRun> TradeRunner::time(const std::vector<std::string>& overrides, double most_seconds) const {
  const auto loaded = load(overrides);
  if (!loaded) return loaded.error();
  return run_to_end(*loaded.value(), times_, budget_, most_seconds);
}

}  // namespace flexcast
