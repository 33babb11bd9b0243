// The program flexcast-record: records until a limit is reached or SIGINT or SIGTERM comes.
#pragma once

#include "clients/record/options.h"

namespace flexcast::record {

// Returns the exit code: 0 the file is complete (frames may be missing: the summary says so), 1 it is not. Blocks
// SIGINT and SIGTERM in the calling thread and waits for them: to be called before there are other threads.
int run_program(const Options& options);

}  // namespace flexcast::record
