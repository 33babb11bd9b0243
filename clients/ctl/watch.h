// status and status --watch.
#pragma once

#include <ostream>

#include "clients/ctl/options.h"

namespace flexcast::ctl {

// Prints the next status, or with --watch each one until SIGINT or SIGTERM (0). 1 when no status comes.
int run_status(const Options& options, client::Connection& connection, std::ostream& out, std::ostream& err);

}  // namespace flexcast::ctl
