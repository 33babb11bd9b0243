// status --watch: one world, until interrupted.
#pragma once

#include <ostream>

#include "clients/ctl/interruption.h"
#include "clients/ctl/status.h"

namespace flexcast::ctl {

// On a terminal a view that is drawn again in place, else a line for every status. When the world goes it says so and
// goes on; when it comes back, too. Returns 0 when it is interrupted.
int run_watch(const Options& options, WorldFollower& follower, const Interruption& interruption, std::ostream& out,
              std::ostream& err);

}  // namespace flexcast::ctl
