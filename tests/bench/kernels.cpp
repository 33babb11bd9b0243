// Forces, tangents and solves; items are elements.
#include <benchmark/benchmark.h>

#include "core/lab/bench_kernels.h"
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
  void (*run)(Kernels&);
};

constexpr Kernel kernel_table[] = {
    {"force", [](Kernels& kernels) { kernels.run_force(); }},
    {"plain_force", [](Kernels& kernels) { kernels.run_scalar_force(); }},
    {"copy", [](Kernels& kernels) { kernels.run_copy(); }},
    {"tangent", [](Kernels& kernels) { kernels.run_tangent(); }},
    {"solve", [](Kernels& kernels) { kernels.run_long_solve(); }},
};

}  // namespace

void register_kernels() {
  for (const NamedScene& scene : make_kernel_scenes(false)) {
    for (const Kernel& kernel : kernel_table) {
      for (const NamedVariant& variant : make_named_variants()) {
        const std::string name = scene.name + "/" + kernel.name + "/" + variant.name;
        benchmark::RegisterBenchmark(name.c_str(), [=](benchmark::State& state) {
          Loaded& loaded = load(scene);
          variant.take();
          for ([[maybe_unused]] auto turn : state) kernel.run(loaded.kernels);
          state.SetItemsProcessed(state.iterations() * count_elements(loaded.simulation->model()));
        })->UseRealTime();
      }
    }
  }
}

}  // namespace flexcast::bench
