// The rows of the table that flexcast-bench prints.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/lab/bench/bench_timing.h"
#include "tests/bench/scenes.h"

namespace flexcast::bench {

// One kernel or step of a scene. Times are medians of interleaved repeats in one run.
struct ReportRow {
  std::string scene, what;
  std::int64_t elements = 0;                                  // tetrahedra and springs
  double seconds = 0.0;                                       // on one thread, with the machine's best instructions
  std::optional<double> plain_loop, copy, two_threads, avx2;  // s, of the same
  std::optional<double> linear_iterations;                    // of a step, median
  std::optional<double> bytes_per_element;                    // that setup and the first step kept
};

// force, tangent, CG iteration.
std::vector<ReportRow> measure_kernel_rows(const NamedScene& scene, const TurnSettings& settings);

// The first steps of a scene: one thread, two threads, AVX2 in turns, `settings.turns` each.
ReportRow measure_step_row(const NamedScene& scene, const TurnSettings& settings);

std::string make_header();
std::string make_line(const ReportRow& row);

}  // namespace flexcast::bench
