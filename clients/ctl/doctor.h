// doctor: what keeps programs apart, and what to do about it.
#pragma once

#include <ostream>

#include "clients/ctl/findings.h"
#include "clients/ctl/options.h"

namespace flexcast::ctl {

int run_doctor(const Options& options, std::ostream& out, std::ostream& err);

// Prints a line for every check (with --json one object). 1 when one fails.
int report(const Options& options, const Findings& findings, std::ostream& out);

}  // namespace flexcast::ctl
