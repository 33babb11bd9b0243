// Under what the microbenchmarks run: each with one and with two threads, and with AVX2 where the machine has more.
#pragma once

#include <string>
#include <vector>

#include "core/base/parallel.h"
#include "tests/bench/instruction_sets.h"

namespace flexcast::bench {

struct NamedVariant {
  std::string name;
  int threads = 1;
  InstructionSet set = InstructionSet::best;

  void take() const {
    set_thread_count(threads);
    use(set);
  }
};

inline std::vector<NamedVariant> make_named_variants() {
  std::vector<NamedVariant> variants = {{"threads:1/best", 1, InstructionSet::best},
                                        {"threads:2/best", 2, InstructionSet::best}};
  if (has_avx512()) variants.push_back({"threads:1/avx2", 1, InstructionSet::avx2});
  return variants;
}

}  // namespace flexcast::bench
