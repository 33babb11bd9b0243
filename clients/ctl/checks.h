// The doctor's checks: a table, one row each.
#pragma once

#include <span>
#include <string>
#include <string_view>

#include "clients/ctl/findings.h"

namespace flexcast::ctl {

enum class Level { ok, warn, fail };

// "ok", "warn", "fail"
std::string_view name_of(Level level);

struct Diagnosis {
  Level level = Level::ok;
  std::string finding;  // what is the case
  std::string remedy;   // what to do; "" when ok
};

struct Check {
  std::string_view name;
  Diagnosis (*examine)(const Findings& findings);
};

std::span<const Check> check_table();

}  // namespace flexcast::ctl
