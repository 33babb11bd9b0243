// What came of one run.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "clients/verify/frame_check.h"

namespace flexcast::verify {

enum class Verdict {
  equal,           // every recorded frame
  empty,           // there is no frame to compare
  differs,         // a frame, or what happened
  not_verifiable,  // the recording lacks something
};

// "equal", "empty", "differs", "not_verifiable"
std::string_view name_of(Verdict verdict);

struct RunReport {
  std::uint64_t number = 0;  // of the runs in the recording, from 1
  std::uint64_t run_id = 0;
  std::string world;
  std::string scene;
  std::string server_version;
  Verdict verdict = Verdict::equal;
  std::string reason;                                         // a sentence unless equal
  std::uint64_t steps = 0;                                    // executed
  std::uint64_t events = 0;                                   // applied
  std::uint64_t frames = 0;                                   // compared
  std::uint64_t differing = 0;                                // frames
  std::uint64_t missing_frames = 0;                           // between frame 0 and the newest recorded one
  std::vector<std::pair<std::uint64_t, std::uint64_t>> gaps;  // first and last of each missing range
  std::optional<Difference> first_difference;
};

}  // namespace flexcast::verify
