// flexcast-microbench: takes the options of Google Benchmark, --benchmark_filter=REGEX above all.
#include "tests/bench/microbench.h"

#include <benchmark/benchmark.h>

int main(int argc, char** argv) {
  flexcast::bench::register_kernels();
  flexcast::bench::register_steps();
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 2;
  benchmark::RunSpecifiedBenchmarks();
  benchmark::Shutdown();
}
