// The view of `status --watch` on a terminal.
#pragma once

#include <string>
#include <vector>

#include "clients/ctl/health.h"

namespace flexcast::ctl {

// The same lines at the same place whatever the values; the last ones are warnings and trouble. At most 80 characters a
// line.
std::vector<std::string> make_watch_view(const std::string& world, const HealthJudge& judge,
                                         HealthJudge::Clock::time_point now);

}  // namespace flexcast::ctl
