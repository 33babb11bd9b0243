// Benchmarks on Google Benchmark. Names are SCENE/KERNEL/threads:N/INSTRUCTIONS.
#pragma once

namespace flexcast::bench {

void register_kernels();
void register_steps();

}  // namespace flexcast::bench
