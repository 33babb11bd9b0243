// Finds out what the doctor judges: the machine, the domain, who is there.
#pragma once

#include "clients/ctl/findings.h"
#include "clients/ctl/options.h"

namespace flexcast::ctl {

// Listens for as long as the user waits. Where no server is found it looks under the other built-in profile, too.
Findings examine(const Options& options);

}  // namespace flexcast::ctl
