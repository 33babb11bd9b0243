// The figures of a benchmark, for people and for programs.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "core/lab/bench/bench.h"

namespace flexcast {

std::string make_bench_text(const Bench& bench);

// The object that `flexcast-lab bench --json` prints. kernel_share is null for schemes that have none.
nlohmann::ordered_json make_bench_json(const Bench& bench);

}  // namespace flexcast
