// Names of worlds, checkpoints and scenes: 1 to 64 of A-Z, a-z, 0-9, _ and -; so they are file names, too.
#pragma once

#include <string>
#include <string_view>

#include "core/base/result.h"

namespace flexcast::server {

// The error says what a name is.
inline Result<void> check_name(std::string_view name) {
  constexpr std::string_view letters = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789_-";
  if (!name.empty() && name.size() <= 64 && name.find_first_not_of(letters) == std::string_view::npos) return {};
  return Error{"'" + std::string(name) + "' is not a name: 1 to 64 of A-Z, a-z, 0-9, _ and -"};
}

}  // namespace flexcast::server
