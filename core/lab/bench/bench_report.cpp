#include "core/lab/bench/bench_report.h"

#include <cstdarg>
#include <cstdio>

namespace flexcast {
namespace {

[[gnu::format(printf, 2, 3)]] std::string line(const char* label, const char* pattern, ...) {
  char text[256];
  va_list arguments;
  va_start(arguments, pattern);
  std::vsnprintf(text, sizeof text, pattern, arguments);
  va_end(arguments);
  char start[64];
  std::snprintf(start, sizeof start, "  %-14s ", label);
  return std::string(start) + text + "\n";
}

double per_element(const Bench& bench, double total) {
  return total / static_cast<double>(bench.elements);
}

}  // namespace

std::string make_bench_text(const Bench& bench) {
  const KernelTimes& kernels = bench.kernels;
  const auto ns = [&](double seconds) { return per_element(bench, 1e9 * seconds); };
  const double bytes = static_cast<double>(bench.bytes);
  std::string text = bench.scene + ": " + std::to_string(bench.elements) + " elements, " +
                     std::to_string(bench.particles) + " particles, " + bench.integrator + ", " +
                     std::to_string(bench.threads) + (bench.threads == 1 ? " thread\n" : " threads\n");
  text += line("force", "%.4g ns an element, %.3g x as fast as a plain loop, %.3g x as long as a copy",
               ns(kernels.force), kernels.scalar_force / kernels.force, kernels.force / kernels.copy);
  text += line("plain loop", "%.4g ns an element", ns(kernels.scalar_force));
  text += line("copy", "%.4g ns an element", ns(kernels.copy));
  text += line("tangent", "%.4g ns an element", ns(kernels.tangent));
  text += line("CG iteration", "%.4g ns an element", ns(kernels.cg_iteration));
  text += line("preconditioned", "%.4g ns an element, an iteration with the preconditioner of pcg",
               ns(kernels.chosen_iteration));
  text += line("step", "%.4g ms, median of the first %d, %g linear iterations", 1e3 * bench.steps.seconds,
               bench.steps.count, bench.steps.linear_iterations);
  if (bench.kernel_share) text += line("kernels", "%.3g of a step", *bench.kernel_share);
  text += line("memory", "%.4g bytes an element, %.4g a particle", per_element(bench, bytes),
               bytes / static_cast<double>(bench.particles));
  text += line("setup", "%.4g s", bench.setup_seconds);
  return text;
}

nlohmann::ordered_json make_bench_json(const Bench& bench) {
  const KernelTimes& kernels = bench.kernels;
  const auto ns = [&](double seconds) { return per_element(bench, 1e9 * seconds); };
  const double bytes = static_cast<double>(bench.bytes);
  nlohmann::ordered_json json = {
      {"scene", bench.scene},
      {"integrator", bench.integrator},
      {"threads", bench.threads},
      {"elements", bench.elements},
      {"particles", bench.particles},
      {"force_ns_per_element", ns(kernels.force)},
      {"scalar_force_ns_per_element", ns(kernels.scalar_force)},
      {"copy_ns_per_element", ns(kernels.copy)},
      {"scalar_over_force", kernels.scalar_force / kernels.force},
      {"force_over_copy", kernels.force / kernels.copy},
      {"tangent_ns_per_element", ns(kernels.tangent)},
      {"cg_iteration_ns_per_element", ns(kernels.cg_iteration)},
      {"preconditioned_iteration_ns_per_element", ns(kernels.chosen_iteration)},
      {"step_ms", 1e3 * bench.steps.seconds},
      {"steps", bench.steps.count},
      {"solver_iterations", bench.steps.linear_iterations},
      {"kernel_share", nullptr},
      {"bytes_per_element", per_element(bench, bytes)},
      {"bytes_per_particle", bytes / static_cast<double>(bench.particles)},
      {"setup_seconds", bench.setup_seconds},
  };
  if (bench.kernel_share) json["kernel_share"] = *bench.kernel_share;
  return json;
}

}  // namespace flexcast
