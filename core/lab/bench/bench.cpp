#include "core/lab/bench/bench.h"

#include <chrono>
#include <ostream>

#include "core/base/parallel.h"
#include "core/lab/bench/bench_report.h"
#include "core/scene/scene.h"

namespace flexcast {
Result<Bench> bench_scene(const BenchOptions& options, std::ostream& log) {
  const std::int64_t bytes_before = count_allocated_bytes();
  const auto start = std::chrono::steady_clock::now();
  auto loaded = load_scene(options.scene, options.overrides);
  if (!loaded) return loaded.error();
  const auto setup = std::chrono::steady_clock::now() - start;
  const Scene& scene = loaded.value();
  for (const std::string& note : scene.notes) log << "flexcast-lab: warning: " << note << std::endl;
  Simulation& simulation = *scene.simulation;
  const Model& model = simulation.model();

  Bench bench;
  bench.scene = scene.name;
  bench.integrator = simulation.settings().time.integrator;
  bench.threads = options.threads;
  bench.elements = count_elements(model);
  bench.particles = model.particle_count();
  bench.setup_seconds = std::chrono::duration<double>(setup).count();
  if (bench.elements == 0) return Error{"the scene has neither tetrahedra nor springs: there is nothing to time"};

  StepBench steps;
  bool well = steps.run(simulation, {.count = 1});
  bench.bytes = count_allocated_bytes() - bytes_before;
  well = well && steps.run(simulation, {.stop = options.stop});
  if (!well) return Error{simulation.failure()->text()};
  bench.steps = steps.calc_times();

  Kernels kernels(model);
  Turns turns;
  const KernelTurns kernel_turns(kernels, turns);
  bench.kernels = kernel_turns.calc_times(turns.measure());
  if (bench.kernels.cg_iteration == 0.0) return Error{"the scene has no free particle: there is nothing to solve"};
  bench.kernel_share = calc_kernel_share(simulation.settings().time, bench.steps, bench.kernels);
  return bench;
}

int bench_verb(const BenchOptions& options, std::ostream& out, std::ostream& log) {
  set_thread_count(options.threads);
  const auto bench = bench_scene(options, log);
  if (!bench) {
    log << "flexcast-lab: " << bench.error().message << std::endl;
    return 1;
  }
  if (options.json) {
    out << make_bench_json(bench.value()).dump(2) << std::endl;
  } else {
    out << make_bench_text(bench.value()) << std::flush;
  }
  if (!out) log << "flexcast-lab: the figures cannot be written" << std::endl;
  return out ? 0 : 1;
}

}  // namespace flexcast
