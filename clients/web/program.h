// The program: participant, feed, hub and network wired together.
#pragma once

#include "clients/web/options.h"

namespace flexcast::web {

// Serves until SIGINT or SIGTERM. The exit code: 0, or 1 with a sentence on stderr.
int run_program(const Options& options);

}  // namespace flexcast::web
