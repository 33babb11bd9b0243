// Kernels as they run on another processor: those of one instruction set alone, as long as this lives.
#pragma once

#include <hwy/targets.h>

#include <cstdint>
#include <string>
#include <vector>

namespace flexcast::test {

struct InstructionSet {
  std::string name;
  std::int64_t target = 0;
};

// What this processor has, and kernels were compiled for, of the sets with fused multiply-add, which have to agree to
// the last bit.
inline std::vector<InstructionSet> fused_instruction_sets() {
  std::vector<InstructionSet> sets;
  for (const InstructionSet& set : {InstructionSet{"avx2", HWY_AVX2}, InstructionSet{"avx512", HWY_AVX3}}) {
    if ((hwy::SupportedTargets() & HWY_TARGETS & set.target) != 0) sets.push_back(set);
  }
  return sets;
}

class OnlyInstructionSet {
 public:
  explicit OnlyInstructionSet(std::int64_t target) { choose(target); }
  ~OnlyInstructionSet() { choose(0); }
  OnlyInstructionSet(const OnlyInstructionSet&) = delete;
  OnlyInstructionSet& operator=(const OnlyInstructionSet&) = delete;

 private:
  static void choose(std::int64_t target) {
    hwy::SetSupportedTargetsForTest(target);
    hwy::GetChosenTarget().Update(hwy::SupportedTargets());
  }
};

// The plain code for processors without any of them.
inline std::int64_t plain_instruction_set() {
  return HWY_EMU128;
}

inline std::vector<InstructionSet> all_instruction_sets() {
  std::vector<InstructionSet> sets = fused_instruction_sets();
  sets.push_back({"plain", plain_instruction_set()});
  return sets;
}

}  // namespace flexcast::test
