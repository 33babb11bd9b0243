// What each verb of flexcast-ctl does.
#pragma once

#include <ostream>

#include "clients/ctl/options.h"

namespace flexcast::ctl {

// Parses, acts and prints; returns the exit code.
int run(int argc, const char* const* argv, std::ostream& out, std::ostream& err);

int run_list(const Options& options, std::ostream& out, std::ostream& err);
int run_command(const Options& options, client::Connection& connection, std::ostream& out, std::ostream& err);

}  // namespace flexcast::ctl
