#include "core/lab/trade/trade_settings.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace flexcast {
namespace {

constexpr double most_substeps = 1e6;  // what time.substeps allows
constexpr int ladder_length = 14;

// One combination of the sweep before it has steps.
struct Combination {
  std::optional<int> iterations;
  bool linearly_implicit = false;
};

bool has_sweeps(const IntegratorRow& row) {
  return row.name == "xpbd" || row.name == "vbd";
}

std::vector<Combination> make_combinations(const TradeOptions& options, const IntegratorRow& row) {
  std::vector<Combination> combinations;
  if (has_sweeps(row)) {
    for (int count : options.iterations) combinations.push_back({count, false});
  }
  if (combinations.empty()) combinations.emplace_back();
  if (row.implicit && !has_sweeps(row) && std::ranges::find(options.iterations, 1) != options.iterations.end())
    combinations.push_back({std::nullopt, true});
  return combinations;
}

Result<std::vector<const IntegratorRow*>> choose_integrators(const TradeOptions& options) {
  std::vector<const IntegratorRow*> rows;
  for (const IntegratorRow& row : integrators())
    if (options.integrators.empty() && row.name != "quasi_static") rows.push_back(&row);
  for (const std::string& name : options.integrators) {
    const IntegratorRow* row = find_integrator(name);
    if (!row) return Error{"--integrators " + name + ": there is no such integrator"};
    if (std::ranges::find(rows, row) == rows.end()) rows.push_back(row);
  }
  return rows;
}

// The scene on one mesh, asked for the stable steps of one scheme after the other.
class StableSteps {
 public:
  static Result<StableSteps> load(const TradeOptions& options, const TradeMesh& mesh) {
    std::vector<std::string> overrides = options.overrides;
    overrides.insert(overrides.end(), mesh.overrides.begin(), mesh.overrides.end());
    auto scene = load_scene(options.scene, overrides);
    if (!scene) return scene.error();
    return StableSteps(std::move(scene.value().simulation));
  }

  // s, infinite for implicit schemes. A scheme that is stable at next to no step, as forward Euler without damping, is
  // still accurate for a while at steps at which symplectic Euler is stable.
  double calc_useful(const IntegratorRow& row) const {
    if (row.implicit) return std::numeric_limits<double>::infinity();
    const double own = calc(std::string(row.name)), symplectic = calc("symplectic_euler");
    return own < 0.1 * symplectic ? symplectic : own;
  }

 private:
  explicit StableSteps(std::unique_ptr<Simulation> simulation) : simulation_(std::move(simulation)) {}

  double calc(const std::string& integrator) const {
    const ParameterAssignment assignment{"time.integrator", integrator};
    const auto set = simulation_->set_parameters({&assignment, 1});
    FLEXCAST_CHECK(set.ok());
    return simulation_->calc_stable_step();
  }

  std::unique_ptr<Simulation> simulation_;
};

// Halved from the frame, or from the stable limit, downwards; one above the limit before them.
std::vector<TradeStep> make_ladder(double frame, double limit) {
  const double least = std::max(1.0, std::ceil(frame / limit * (1.0 - 1e-12)));
  std::vector<TradeStep> steps;
  if (!(least <= most_substeps)) return steps;
  const auto first = static_cast<int>(least);
  if (first > 1) steps.push_back({1, first / 2, true});
  for (int i = 0; i < ladder_length; ++i) {
    const double substeps = std::ldexp(static_cast<double>(first), i);
    if (substeps <= most_substeps) steps.push_back({1, static_cast<int>(substeps), false});
  }
  return steps;
}

// The listed steps, falling; of those above the limit the last.
std::vector<TradeStep> make_listed(const std::vector<double>& listed, double frame, double limit) {
  std::vector<TradeStep> steps;
  for (double h : listed) steps.push_back(round_step(h, frame));
  const auto size = [&](const TradeStep& step) { return step.calc_seconds(frame); };
  std::ranges::sort(steps, std::greater<>(), size);
  steps.erase(std::ranges::unique(steps, {}, size).begin(), steps.end());
  for (TradeStep& step : steps) step.above_limit = size(step) > limit;
  const auto above = std::ranges::count(steps, true, &TradeStep::above_limit);
  if (above > 1) steps.erase(steps.begin(), steps.begin() + (above - 1));
  return steps;
}

std::string make_name(const TradeGroup& group, const TradeMesh& mesh) {
  std::string name(group.row->name);
  if (group.iterations)
    name += ", " + std::to_string(*group.iterations) + (*group.iterations > 1 ? " sweeps" : " sweep");
  if (group.linearly_implicit) name += ", 1 Newton iteration";
  if (group.tolerance) name += ", tolerance " + to_text(ParameterValue(*group.tolerance));
  return mesh.name.empty() ? name : name + ", " + mesh.name;
}

void add_contracts(const TradeOptions& options, const Scene& base, const std::vector<TradeMesh>& meshes,
                   const std::vector<const IntegratorRow*>& rows, std::vector<TradeGroup>& groups) {
  const IntegratorRow* own = find_integrator(base.simulation->settings().time.integrator);
  for (std::size_t m = 0; m < meshes.size(); ++m) {
    for (const IntegratorRow* row : rows) {
      if (options.integrators.empty() && row != own) continue;
      for (double tolerance : options.tolerances) {
        TradeGroup group{row, {}, false, tolerance, m, "", {{}}, false};
        group.name = make_name(group, meshes[m]);
        groups.push_back(std::move(group));
      }
    }
  }
}

}  // namespace

TradeStep round_step(double h, double frame) {
  TradeStep step;
  if (h <= frame) {
    step.substeps = static_cast<int>(std::clamp(std::round(frame / h), 1.0, most_substeps));
  } else {
    step.frames = static_cast<std::int64_t>(std::clamp(std::round(h / frame), 1.0, 1e9));
  }
  return step;
}

Result<std::vector<TradeGroup>> make_trade_groups(const TradeOptions& options, const Scene& base,
                                                  const std::vector<TradeMesh>& meshes) {
  const auto rows = choose_integrators(options);
  if (!rows) return rows.error();
  const double frame = base.simulation->settings().time.step;
  std::vector<TradeGroup> groups;
  for (std::size_t m = 0; m < meshes.size(); ++m) {
    const auto stable = StableSteps::load(options, meshes[m]);
    if (!stable) return stable.error();
    for (const IntegratorRow* row : rows.value()) {
      const double limit = stable.value().calc_useful(*row);
      for (const Combination& combination : make_combinations(options, *row)) {
        TradeGroup group{row, combination.iterations, combination.linearly_implicit, {}, m, "", {}, false};
        group.name = make_name(group, meshes[m]);
        group.open_ended = options.steps.empty();
        group.steps = group.open_ended ? make_ladder(frame, limit) : make_listed(options.steps, frame, limit);
        groups.push_back(std::move(group));
      }
    }
  }
  add_contracts(options, base, meshes, rows.value(), groups);
  return groups;
}

TradeSetting make_setting(const std::vector<TradeGroup>& groups, std::size_t group, const TradeStep& step,
                          const std::vector<TradeMesh>& meshes, double frame) {
  const TradeGroup& of = groups[group];
  TradeSetting setting{group, step, {}, ""};
  std::vector<std::string>& overrides = setting.overrides;
  overrides.push_back("time.integrator=" + std::string(of.row->name));
  if (of.tolerance) {
    overrides.push_back("time.tolerance=" + to_text(ParameterValue(*of.tolerance)));
  } else {
    if (step.frames > 1)
      overrides.push_back("time.step=" + to_text(ParameterValue(frame * static_cast<double>(step.frames))));
    overrides.push_back("time.substeps=" + std::to_string(step.substeps));
  }
  if (of.iterations) overrides.push_back("solver.iterations=" + std::to_string(*of.iterations));
  if (of.linearly_implicit) overrides.emplace_back("solver.newton_iterations=1");
  for (const std::string& assignment : meshes[of.mesh].overrides) overrides.push_back(assignment);
  for (const std::string& assignment : overrides) setting.label += (setting.label.empty() ? "" : " ") + assignment;
  return setting;
}

std::int64_t calc_common_frames(const std::vector<double>& steps, double frame) {
  constexpr std::int64_t most = 1'000'000'000'000;
  std::int64_t common = 1;
  for (double h : steps) {
    const std::int64_t frames = round_step(h, frame).frames;
    common = common / std::gcd(common, frames) > most / frames ? most : std::lcm(common, frames);
  }
  return common;
}

}  // namespace flexcast
