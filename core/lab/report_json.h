// A run as JSON: for programs.
#pragma once

#include <nlohmann/json.hpp>

#include "core/lab/run.h"

namespace flexcast {

// The object that `flexcast-lab run --json` prints. Keys keep their order; null: not computed.
nlohmann::ordered_json make_report_json(const Run& run);

}  // namespace flexcast
