#include "core/lab/cost/scene_cost_report.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace flexcast {
namespace {

using Json = nlohmann::ordered_json;

template <class... Values>
std::string format(const char* pattern, Values... values) {
  char text[256];
  std::snprintf(text, sizeof text, pattern, values...);
  return text;
}

double calc_percent(const SceneCost& cost, double seconds) {
  return 100.0 * seconds / cost.step_seconds;
}

// Microseconds with three digits or more, without an exponent.
std::string time_text(double seconds) {
  const double us = 1e6 * seconds, size = std::abs(us);
  return format("%.*f", size > 0.0 && size < 0.1 ? 4 : size < 10.0 ? 2 : size < 1000.0 ? 1 : 0, us);
}

std::string count_text(std::int64_t count, const char* what) {
  return std::to_string(count) + " " + what + (count == 1 ? "" : "s");
}

// What the scene without it needs, when that differs by more than a twentieth.
std::string iterations_text(const SceneCost& cost, const FeatureCost& feature) {
  const auto differ = [](double a, double b) { return std::max(a, b) > 1.05 * std::min(a, b); };
  if (differ(cost.linear_iterations, feature.linear_iterations))
    return format("; %.3g linear iterations, %.3g without it", cost.linear_iterations, feature.linear_iterations);
  if (differ(cost.iterations, feature.iterations))
    return format("; %.3g iterations, %.3g without it", cost.iterations, feature.iterations);
  return "";
}

std::string feature_text(const SceneCost& cost, const FeatureCost& feature, int width) {
  std::string text = format("  %-*s ", width, feature.name.c_str());
  if (!feature.seconds) return text + "cannot be left out: " + feature.failure + "\n";
  text += format("%10s us  %6.2f %%", time_text(*feature.seconds).c_str(), calc_percent(cost, *feature.seconds));
  text += (feature.is_measurable() ? "  +- " : "  not measurable: the noise is ") + time_text(feature.spread) + " us";
  return text + iterations_text(cost, feature) + "\n";
}

}  // namespace

std::string make_scene_cost_text(const SceneCost& cost) {
  std::size_t longest = 4;
  for (const FeatureCost& feature : cost.features) longest = std::max(longest, feature.name.size());
  for (const ExtraCost& extra : cost.extras) longest = std::max(longest, extra.name.size());
  const int width = static_cast<int>(longest);

  std::string text = cost.scene + ": " + count_text(cost.elements, "element") + ", " +
                     count_text(cost.particles, "particle") + ", " + cost.integrator + ", " +
                     count_text(cost.threads, "thread") + ", " + count_text(cost.steps, "step") + " of each variant\n";
  text += format("  %-*s %10s us, median; the same scene once more differs by %s us\n", width, "step",
                 time_text(cost.step_seconds).c_str(), time_text(cost.noise).c_str());
  if (!cost.features.empty()) text += "in a step, by leaving it out:\n";
  for (const FeatureCost& feature : cost.features) text += feature_text(cost, feature, width);
  text += "beside the steps, each time it is asked for (report) or for every published frame (frame):\n";
  for (const ExtraCost& extra : cost.extras) {
    text += format("  %-*s %10s us  %6.2f %% of a step, %s\n", width, extra.name.c_str(),
                   time_text(extra.seconds).c_str(), calc_percent(cost, extra.seconds), extra.when.c_str());
  }
  return text;
}

Json make_scene_cost_json(const SceneCost& cost) {
  Json features = Json::array(), extras = Json::array();
  for (const FeatureCost& feature : cost.features) {
    Json entry = {{"name", feature.name},
                  {"us", nullptr},
                  {"percent", nullptr},
                  {"spread_us", nullptr},
                  {"measurable", feature.is_measurable()},
                  {"iterations", nullptr},
                  {"linear_iterations", nullptr},
                  {"failure", nullptr}};
    if (feature.seconds) {
      entry["us"] = 1e6 * *feature.seconds;
      entry["percent"] = calc_percent(cost, *feature.seconds);
      entry["spread_us"] = 1e6 * feature.spread;
      entry["iterations"] = feature.iterations;
      entry["linear_iterations"] = feature.linear_iterations;
    } else {
      entry["failure"] = feature.failure;
    }
    features.push_back(std::move(entry));
  }
  for (const ExtraCost& extra : cost.extras) {
    extras.push_back({{"name", extra.name},
                      {"when", extra.when},
                      {"us", 1e6 * extra.seconds},
                      {"percent", calc_percent(cost, extra.seconds)}});
  }
  return {{"scene", cost.scene},
          {"integrator", cost.integrator},
          {"threads", cost.threads},
          {"elements", cost.elements},
          {"particles", cost.particles},
          {"steps", cost.steps},
          {"step_us", 1e6 * cost.step_seconds},
          {"noise_us", 1e6 * cost.noise},
          {"iterations", cost.iterations},
          {"linear_iterations", cost.linear_iterations},
          {"features", features},
          {"extras", extras}};
}

}  // namespace flexcast
