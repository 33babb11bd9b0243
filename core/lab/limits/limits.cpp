#include "core/lab/limits/limits.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <ostream>

#include "core/base/parallel.h"
#include "core/lab/limits/limits_report.h"
#include "core/lab/output_file.h"
#include "core/scene/scene.h"

namespace flexcast {
namespace {

using Clock = std::chrono::steady_clock;

// What has been measured of what there is to measure, in time or not.
class Budget {
 public:
  Budget(const LimitsOptions& options, std::size_t count, std::ostream& log)
      : options_(options), count_(count), log_(log), start_(Clock::now()) {}
  ~Budget() {
    if (shown_) log_ << "\r\x1b[K" << std::flush;
  }
  Budget(const Budget&) = delete;
  Budget& operator=(const Budget&) = delete;

  // Whether the next measurement may begin, given the part of the budget that may be used by then.
  bool begin(double share, const std::string& what) {
    const double spent = calc_spent();
    if (is_stopped() || spent > share * options_.budget) return false;
    if (options_.progress && done_ > 0) {
      const double rest = spent * static_cast<double>(count_ - done_) / static_cast<double>(done_);
      char line[200];
      std::snprintf(line, sizeof line, "\rmeasurement %zu of %zu, %s, %.0f s remaining\x1b[K", done_ + 1, count_,
                    what.c_str(), std::min(rest, options_.budget - spent));
      log_ << line << std::flush;
      shown_ = true;
    }
    ++done_;
    return true;
  }
  // Whether the measurement under way has to be given up.
  bool is_over() const { return is_stopped() || calc_spent() > options_.budget; }
  bool is_stopped() const { return options_.stop && options_.stop->load(std::memory_order_relaxed); }

 private:
  double calc_spent() const { return std::chrono::duration<double>(Clock::now() - start_).count(); }

  const LimitsOptions& options_;
  std::size_t count_, done_ = 0;
  std::ostream& log_;
  Clock::time_point start_;
  bool shown_ = false;
};

bool is_chosen(const std::vector<std::string>& chosen, std::string_view name) {
  return chosen.empty() || std::find(chosen.begin(), chosen.end(), name) != chosen.end();
}

std::vector<const IntegratorRow*> choose_schemes(const LimitsOptions& options, bool implicit) {
  std::vector<const IntegratorRow*> schemes;
  for (const IntegratorRow& row : integrators()) {
    // Without being asked for: not what knows no time.
    const bool wanted =
        is_chosen(options.integrators, row.name) && (!options.integrators.empty() || row.name != "quasi_static");
    if (row.implicit == implicit && wanted) schemes.push_back(&row);
  }
  return schemes;
}

std::string short_number(double value) {
  char text[40];
  std::snprintf(text, sizeof text, "%.6g", value);
  return text;
}

// Every second value first, so that a budget that ends early leaves a coarse curve rather than half a one.
std::vector<std::size_t> make_order(std::size_t count) {
  std::vector<std::size_t> order;
  for (const std::size_t first : {0U, 1U})
    for (std::size_t i = first; i < count; i += 2) order.push_back(i);
  return order;
}

LimitPanel measure_panel(const Variation& variation, const Model& quiet, double share,
                         const std::vector<const IntegratorRow*>& schemes, Budget& budget, Limits& limits) {
  LimitPanel panel{variation, {}};
  for (const IntegratorRow* scheme : schemes) panel.curves.push_back({std::string(scheme->name), {}});
  std::size_t missing = 0;
  std::vector<Model> models;
  for (const double value : variation.values) {
    models.push_back(variation.change(quiet, value));
    update_masses(models.back());
  }
  // Forward Euler, the first of the table and the last here, takes the longest.
  for (std::size_t k = schemes.size(); k-- > 0;) {
    for (const std::size_t i : make_order(variation.values.size())) {
      ++missing;
      if (!budget.begin(share, variation.name + " " + panel.curves[k].integrator)) continue;
      const Limit limit = find_limit(models[i], *schemes[k], [&] { return budget.is_over(); });
      if (budget.is_over()) continue;
      panel.curves[k].points.push_back({variation.values[i], limit});
      --missing;
    }
  }
  for (LimitCurve& curve : panel.curves)
    std::sort(curve.points.begin(), curve.points.end(), [](auto& a, auto& b) { return a.value < b.value; });
  if (missing > 0) {
    limits.notes.push_back(variation.name + ": " + std::to_string(missing) + " of " +
                           std::to_string(schemes.size() * variation.values.size()) + " measurements were left out, " +
                           (budget.is_stopped() ? "stopped" : "the budget (--budget) was used up"));
  }
  return panel;
}

void measure_implicit(const LimitsOptions& options, const Simulation& simulation, const Model& quiet, Budget& budget,
                      Limits& limits) {
  const GrowthWatch watch{100, 0.0, false, [&] { return budget.is_over(); }};
  const Perturbation perturbation(quiet);
  const double frame = simulation.settings().time.step;
  for (const IntegratorRow* scheme : choose_schemes(options, true)) {
    for (const double factor : {1.0, 10.0, 100.0}) {
      double gain = 0.0;
      const bool begun = budget.begin(1.0, std::string(scheme->name));
      if (begun) gain = perturbation.calc_gain(*scheme, simulation.settings().solver, factor * frame, watch);
      if (!begun || budget.is_over()) {
        limits.notes.push_back(std::string(scheme->name) + ": left out from a step of " + short_number(factor * frame) +
                               " s on, " + (budget.is_stopped() ? "stopped" : "the budget (--budget) was used up"));
        break;
      }
      limits.runs.push_back({std::string(scheme->name), factor * frame, gain});
    }
  }
}

void note_what_was_left_out(const Simulation& simulation, Limits& limits) {
  std::string steps;
  for (const IntegratorRow* scheme : choose_schemes({}, false)) {
    const GrowthWatch watch = choose_watch(*scheme);
    steps += (steps.empty() ? "" : ", ") + std::string(scheme->name) + " in " + std::to_string(watch.steps) + " steps" +
             (watch.steadily ? " or steadily" : "");
  }
  limits.notes.push_back(
      "measured about the rest state, without gravity, loads, contacts and moving handles: unstable is where a "
      "perturbation of 1e-9 of the shortest edge grows beyond what rounding can do (" +
      steps + ")");
  if (simulation.state().positions != simulation.model().rest_positions)
    limits.notes.emplace_back("the scene starts deformed; what is measured is its rest state");
}

Result<void> write(const std::filesystem::path& path, const std::string& text) {
  auto file = OutputFile::open(path);
  if (!file) return file.error();
  file.value().stream() << text;
  return file.value().close();
}

Result<void> write_files(const LimitsOptions& options, const Limits& limits) {
  if (auto done = write(options.folder / "limits.csv", make_limits_csv(limits)); !done) return done;
  if (auto done = write(options.folder / "limits.json", make_limits_json(limits).dump(2) + "\n"); !done) return done;
  return write(options.folder / "limits.svg", make_svg(make_limits_plot(limits)));
}

}  // namespace

std::optional<double> LimitPoint::calc_ratio() const {
  if (!limit.resolved || !limit.measured || !limit.predicted || !(*limit.predicted > 0.0)) return {};
  const double ratio = *limit.measured / *limit.predicted;
  return std::isfinite(ratio) ? std::optional(ratio) : std::nullopt;
}

Result<Limits> find_limits(const LimitsOptions& options, std::ostream& log) {
  auto scene = load_scene(options.scene, options.overrides);
  if (!scene) return scene.error();
  for (const std::string& note : scene.value().notes) log << "flexcast-lab: warning: " << note << std::endl;
  const Simulation& simulation = *scene.value().simulation;
  const Model quiet = make_quiet_model(simulation.model());
  if (std::all_of(quiet.fixed.begin(), quiet.fixed.end(), [](auto fixed) { return fixed != 0; }))
    return Error{options.scene.string() + ": the scene has no free particle, so nothing in it can blow up"};
  Model undamped = quiet;
  for (Body& body : undamped.bodies) body.stiffness_damping = body.damping = body.mass_damping = body.drag = 0.0;
  const double fastest = 2.0 / calc_predicted_step(undamped, "symplectic_euler");

  Limits limits;
  limits.scene = scene.value().name;
  note_what_was_left_out(simulation, limits);
  std::vector<Variation> variations;
  for (const std::string& name : variation_names()) {
    if (!is_chosen(options.quantities, name)) continue;
    auto variation = make_variation(name, quiet, options.points, fastest);
    if (variation) {
      variations.push_back(std::move(variation).value());
    } else {
      limits.notes.push_back(variation.error().message);
    }
  }
  const auto schemes = choose_schemes(options, false);
  std::size_t count = 3 * choose_schemes(options, true).size();
  for (const Variation& variation : variations) count += schemes.size() * variation.values.size();
  Budget budget(options, count, log);
  if (!schemes.empty()) {
    // Each quantity has its part of the budget, and what those before it left; a fifth is kept for implicit schemes.
    for (std::size_t i = 0; i < variations.size(); ++i) {
      const double share = 0.8 * static_cast<double>(i + 1) / static_cast<double>(variations.size());
      limits.panels.push_back(measure_panel(variations[i], quiet, share, schemes, budget, limits));
    }
  }
  measure_implicit(options, simulation, quiet, budget, limits);
  return limits;
}

int limits_verb(const LimitsOptions& options, std::ostream& out, std::ostream& log) {
  set_thread_count(options.threads);
  const auto refuse = [&](const std::string& reason) {
    log << "flexcast-lab: " << reason << std::endl;
    return 1;
  };
  std::error_code error;
  std::filesystem::create_directories(options.folder, error);
  if (error) return refuse(options.folder.string() + ": cannot be made: " + error.message());
  const auto limits = find_limits(options, log);
  if (!limits) return refuse(limits.error().message);
  if (const auto written = write_files(options, limits.value()); !written) return refuse(written.error().message);
  for (const std::string& note : limits.value().notes) log << "flexcast-lab: " << note << std::endl;
  if (options.json) {
    out << make_limits_json(limits.value()).dump(2) << std::endl;
  } else {
    out << make_limits_text(limits.value()) << std::flush;
  }
  if (options.stop && options.stop->load(std::memory_order_relaxed)) return refuse("stopped");
  return out ? 0 : refuse("the limits cannot be written");
}

}  // namespace flexcast
