// Which vectors the kernels may use.
#pragma once

namespace flexcast::bench {

enum class InstructionSet {
  best,  // of the machine
  avx2   // at most
};

// Whether `best` is more than `avx2` on this machine.
bool has_avx512();

// Of the whole process. Not to be called while a kernel runs.
void use(InstructionSet set);

}  // namespace flexcast::bench
