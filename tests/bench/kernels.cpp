// Forces, tangents and solves; items are elements.
#include <benchmark/benchmark.h>

#include "core/lab/bench/bench_kernels.h"
#include "tests/bench/microbench.h"
#include "tests/bench/scenes.h"
#include "tests/bench/variants.h"

namespace flexcast::bench {
namespace {

// One scene is kept: the benchmarks of a scene follow each other.
struct Loaded {
  explicit Loaded(const NamedScene& scene)
      : name(scene.name), simulation(make_simulation(scene.text)), kernels(simulation->model()) {}
  std::string name;
  std::unique_ptr<Simulation> simulation;
  Kernels kernels;
};

Loaded& load(const NamedScene& scene) {
  static std::unique_ptr<Loaded> loaded;
  if (!loaded || loaded->name != scene.name) {
    loaded.reset();
    loaded = std::make_unique<Loaded>(scene);
  }
  return *loaded;
}

struct Kernel {
  const char* name;
  int (*run)(Kernels&);  // returns linear iterations
};

constexpr Kernel kernel_table[] = {
    {"force", [](Kernels& kernels) { return kernels.run_force(), 0; }},
    {"plain_force", [](Kernels& kernels) { return kernels.run_scalar_force(), 0; }},
    {"copy", [](Kernels& kernels) { return kernels.run_copy(), 0; }},
    {"tangent", [](Kernels& kernels) { return kernels.run_tangent(), 0; }},
    {"plain solve", [](Kernels& kernels) { return kernels.run_long_solve(Kernels::Iterations::plain); }},
    {"solve", [](Kernels& kernels) { return kernels.run_long_solve(Kernels::Iterations::chosen); }},
};

void run(benchmark::State& state, const NamedScene& scene, const Kernel& kernel, const NamedVariant& variant) {
  Loaded& loaded = load(scene);
  variant.take();
  double linear_iterations = 0.0;
  for ([[maybe_unused]] auto turn : state) linear_iterations += kernel.run(loaded.kernels);
  state.counters["linear_iterations"] = {linear_iterations, benchmark::Counter::kAvgIterations};
  state.SetItemsProcessed(state.iterations() * count_elements(loaded.simulation->model()));
}

}  // namespace

void register_kernels() {
  for (const NamedScene& scene : make_kernel_scenes(false)) {
    for (const Kernel& kernel : kernel_table) {
      for (const NamedVariant& variant : make_named_variants()) {
        const std::string name = scene.name + "/" + kernel.name + "/" + variant.name;
        const auto body = [=](benchmark::State& state) { run(state, scene, kernel, variant); };
        benchmark::RegisterBenchmark(name.c_str(), body)->UseRealTime();
      }
    }
  }
}

}  // namespace flexcast::bench
