#include "tests/bench/report_rows.h"

#include <chrono>
#include <cstdio>
#include <cstdlib>

#include "core/base/parallel.h"
#include "core/lab/bench/bench_kernels.h"
#include "core/lab/bench/bench_steps.h"
#include "tests/bench/instruction_sets.h"

namespace flexcast::bench {
namespace {

struct Variant {
  int threads = 1;
  InstructionSet set = InstructionSet::best;
};

// The first is what the others are compared with.
std::vector<Variant> make_variants() {
  std::vector<Variant> variants = {{}, {.threads = 2}};
  if (has_avx512()) variants.push_back({.set = InstructionSet::avx2});
  return variants;
}

// Also wakes the threads, so that their start is not timed.
void take(const Variant& variant) {
  if (thread_count() != variant.threads) set_thread_count(variant.threads);
  use(variant.set);
  std::vector<double> partial;
  parallel_sum(64, 1, partial, [](std::int64_t first, std::int64_t end) { return static_cast<double>(end - first); });
}

ReportRow make_row(const NamedScene& scene, const char* what, const Model& model,
                   const std::vector<double>& of_variants) {
  ReportRow row;
  row.scene = scene.name;
  row.what = what;
  row.elements = count_elements(model);
  row.seconds = of_variants[0];
  row.two_threads = of_variants[1];
  if (of_variants.size() > 2) row.avx2 = of_variants[2];
  return row;
}

std::string text(const char* pattern, std::optional<double> value) {
  if (!value) return "";
  char buffer[64];
  std::snprintf(buffer, sizeof buffer, pattern, *value);
  return buffer;
}

std::optional<double> ratio(std::optional<double> upper, std::optional<double> lower) {
  if (!upper || !lower) return {};
  return *upper / *lower;
}

}  // namespace

std::vector<ReportRow> measure_kernel_rows(const NamedScene& scene, const TurnSettings& settings) {
  const std::vector<Variant> variants = make_variants();
  take(variants[0]);
  const std::unique_ptr<Simulation> simulation = make_simulation(scene.text);
  Kernels kernels(simulation->model());
  Turns turns;
  std::vector<std::unique_ptr<KernelTurns>> tasks;
  for (const Variant& variant : variants) {
    tasks.push_back(std::make_unique<KernelTurns>(kernels, turns, [variant] { take(variant); }));
  }
  const std::vector<double> seconds = turns.measure(settings);
  take(variants[0]);
  std::vector<double> force, tangent, cg_iteration, chosen_iteration;
  for (const auto& of_variant : tasks) {
    const KernelTimes times = of_variant->calc_times(seconds);
    force.push_back(times.force);
    tangent.push_back(times.tangent);
    cg_iteration.push_back(times.cg_iteration);
    chosen_iteration.push_back(times.chosen_iteration);
  }
  std::vector<ReportRow> rows = {make_row(scene, "force", simulation->model(), force),
                                 make_row(scene, "tangent", simulation->model(), tangent),
                                 make_row(scene, "CG iteration", simulation->model(), cg_iteration),
                                 make_row(scene, "preconditioned", simulation->model(), chosen_iteration)};
  const KernelTimes times = tasks[0]->calc_times(seconds);
  rows[0].plain_loop = times.scalar_force;
  rows[0].copy = times.copy;
  return rows;
}

ReportRow measure_step_row(const NamedScene& scene, const TurnSettings& settings) {
  using Clock = std::chrono::steady_clock;
  const std::vector<Variant> variants = make_variants();
  take(variants[0]);
  const std::int64_t bytes_before = count_allocated_bytes();
  const std::unique_ptr<Simulation> simulation = make_simulation(scene.text);
  std::vector<std::vector<double>> seconds(variants.size());
  std::vector<double> linear_iterations;
  // Thirty steps from the start and again: later the scene may be at rest, where a step costs nothing.
  constexpr std::int64_t most_steps = 30;
  const auto step = [&] {
    if (simulation->step()) return;
    std::fprintf(stderr, "%s: %s\n", scene.name.c_str(), simulation->failure()->text().c_str());
    std::exit(1);
  };
  step();
  const std::int64_t bytes = count_allocated_bytes() - bytes_before;
  const Clock::time_point begin = Clock::now();
  for (int turn = 0; turn < settings.turns; ++turn) {
    if (turn >= settings.least_turns && Clock::now() - begin > std::chrono::duration<double>(settings.budget)) break;
    for (std::size_t v = 0; v < variants.size(); ++v) {
      take(variants[v]);
      if (simulation->state().step >= most_steps) simulation->reset(), step();
      const Clock::time_point start = Clock::now();
      step();
      seconds[v].push_back(std::chrono::duration<double>(Clock::now() - start).count());
      linear_iterations.push_back(simulation->statistics().linear_iterations);
    }
  }
  take(variants[0]);
  std::vector<double> medians;
  for (std::vector<double>& of_variant : seconds) medians.push_back(calc_median(std::move(of_variant)));
  ReportRow row = make_row(scene, "step", simulation->model(), medians);
  row.linear_iterations = calc_median(std::move(linear_iterations));
  row.bytes_per_element = static_cast<double>(bytes) / static_cast<double>(row.elements);
  return row;
}

std::string make_header() {
  return "| scene | what | elements | ms | ns an element | plain loop / this | this / copy | one thread / two | AVX2 / "
         "AVX-512 | linear iterations | bytes an element |\n|---|---|--:|--:|--:|--:|--:|--:|--:|--:|--:|\n";
}

std::string make_line(const ReportRow& row) {
  const std::vector<std::string> cells = {row.scene,
                                          row.what,
                                          std::to_string(row.elements),
                                          text("%.4g", 1e3 * row.seconds),
                                          text("%.4g", 1e9 * row.seconds / static_cast<double>(row.elements)),
                                          text("%.2f", ratio(row.plain_loop, row.seconds)),
                                          text("%.1f", ratio(row.seconds, row.copy)),
                                          text("%.2f", ratio(row.seconds, row.two_threads)),
                                          text("%.2f", ratio(row.avx2, row.seconds)),
                                          text("%g", row.linear_iterations),
                                          text("%.0f", row.bytes_per_element)};
  std::string line = "|";
  for (const std::string& cell : cells) line += " " + cell + " |";
  return line + "\n";
}

}  // namespace flexcast::bench
