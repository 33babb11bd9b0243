// A run as text: for people.
#pragma once

#include <string>

#include "core/lab/run.h"

namespace flexcast {

std::string make_report_text(const Run& run);

}  // namespace flexcast
