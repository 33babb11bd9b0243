// flexcast-verify from its options to its exit code.
#pragma once

#include <ostream>

#include "clients/verify/options.h"

namespace flexcast::verify {

// SIGINT and SIGTERM end it. Results go to `out`, messages and, on a terminal, progress to `err`.
int run_program(const Options& options, std::ostream& out, std::ostream& err);

}  // namespace flexcast::verify
