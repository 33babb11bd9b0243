// The program flexcast-replay: replays until SIGINT or SIGTERM comes, or with --exit to the end of the recording.
#pragma once

#include "clients/replay/options.h"

namespace flexcast::replay {

// Returns the exit code. Blocks SIGINT and SIGTERM in the calling thread and waits for them: to be called before there
// are other threads.
int run_program(const Options& options);

}  // namespace flexcast::replay
