// Steps from the start of a scene; items are elements.
#include <benchmark/benchmark.h>

#include "core/lab/bench/bench_loops.h"
#include "tests/bench/microbench.h"
#include "tests/bench/scenes.h"
#include "tests/bench/variants.h"

namespace flexcast::bench {

namespace {

void run(benchmark::State& state, const NamedScene& scene, const NamedVariant& variant) {
  variant.take();
  const std::unique_ptr<Simulation> simulation = make_simulation(scene.text);
  simulation->step();  // makes what later ones keep
  double linear_iterations = 0.0;
  for ([[maybe_unused]] auto turn : state) {
    if (!simulation->step()) return state.SkipWithError(simulation->failure()->text().c_str());
    linear_iterations += simulation->statistics().linear_iterations;
  }
  state.counters["linear_iterations"] = {linear_iterations, benchmark::Counter::kAvgIterations};
  state.SetItemsProcessed(state.iterations() * count_elements(simulation->model()));
}

}  // namespace

void register_steps() {
  for (const NamedScene& scene : make_step_scenes(false)) {
    for (const NamedVariant& variant : make_named_variants()) {
      const std::string name = scene.name + "/step/" + variant.name;
      const auto body = [=](benchmark::State& state) { run(state, scene, variant); };
      benchmark::RegisterBenchmark(name.c_str(), body)->UseRealTime()->Unit(benchmark::kMillisecond);
    }
  }
}

}  // namespace flexcast::bench
