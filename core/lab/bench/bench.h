// The verb `bench`: what a scene's kernels and steps cost.
#pragma once

#include <atomic>
#include <filesystem>
#include <iosfwd>
#include <string>
#include <vector>

#include "core/base/result.h"
#include "core/lab/bench/bench_steps.h"

namespace flexcast {

struct BenchOptions {
  std::filesystem::path scene;
  std::vector<std::string> overrides;
  int threads = 1;  // of the engine
  bool json = false;
  const std::atomic<bool>* stop = nullptr;  // ends the steps early when it becomes true
};

struct Bench {
  std::string scene, integrator;
  int threads = 1;
  std::int64_t elements = 0;  // tetrahedra and springs
  std::int64_t particles = 0;
  double setup_seconds = 0.0;  // from the scene file to the simulation
  std::int64_t bytes = 0;      // that setup and the first step allocated and kept
  KernelTimes kernels;
  StepTimes steps;                     // the first of the scene
  std::optional<double> kernel_share;  // of a step; see bench_steps.h
};

// Errors: a scene that cannot be loaded, that has no element or nothing free to move, or that fails on its way.
Result<Bench> bench_scene(const BenchOptions& options, std::ostream& log);

// The program's verb; returns the exit code.
int bench_verb(const BenchOptions& options, std::ostream& out, std::ostream& log);

}  // namespace flexcast
