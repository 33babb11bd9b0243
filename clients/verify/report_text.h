// What flexcast-verify prints.
#pragma once

#include <string>

#include "clients/verify/verify.h"

namespace flexcast::verify {

// A line a run, then the first difference and the gaps below it.
std::string to_text(const Report& report);

// One object: file, verified, warnings, runs [{number, run_id, world, scene, server_version, verdict, reason, steps,
// events, frames, differing, missing_frames, gaps [{first, last}], first_difference {frame, step, time, recorded_step,
// recorded_hash, computed_hash, after}}]. Hashes are texts of 16 hexadecimal digits.
std::string to_json(const Report& report);

}  // namespace flexcast::verify
