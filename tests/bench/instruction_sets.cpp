#include "tests/bench/instruction_sets.h"

#include <hwy/targets.h>

namespace flexcast::bench {
namespace {

// Targets with better instructions have lower bits.
constexpr std::int64_t above_avx2 = HWY_AVX2 - 1;

}  // namespace

bool has_avx512() {
  use(InstructionSet::best);
  return (hwy::SupportedTargets() & HWY_TARGETS & HWY_AVX3) != 0;
}

void use(InstructionSet set) {
  hwy::DisableTargets(set == InstructionSet::avx2 ? above_avx2 : 0);
}

}  // namespace flexcast::bench
