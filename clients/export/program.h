// The program flexcast-export.
#pragma once

#include "clients/export/options.h"

namespace flexcast::exporting {

// Exports and prints; returns the exit code.
int run_program(const Options& options);

}  // namespace flexcast::exporting
