// Identities for --security, made by the script that users run.
#pragma once

#include <filesystem>
#include <stdexcept>
#include <string>
#include <vector>

#include "tests/support/process.h"

namespace flexcast::test {

// One folder below `folder` for each of `identities` ("NAME:operator", "NAME:watcher"). A folder of its own: an
// authority of its own.
inline void make_identities(const std::filesystem::path& folder, std::vector<std::string> identities) {
  identities.insert(identities.begin(), folder.string());
  Process script(std::filesystem::path(FLEXCAST_SOURCE_DIR) / "server/security/make_identities.sh", identities);
  if (script.wait(std::chrono::seconds(60)) != 0) throw std::runtime_error("no identities: " + script.err());
}

}  // namespace flexcast::test
