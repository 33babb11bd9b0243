// flexcast-ctl called within the test.
#pragma once

#include <sstream>
#include <string>
#include <vector>

#include "clients/ctl/json.h"
#include "clients/ctl/verbs.h"
#include "tests/support/network.h"

namespace flexcast::ctl::test {

struct Outcome {
  int exit_code;
  std::string out, err;
  Json json() const { return Json::parse(out, nullptr, false); }
};

inline Outcome ctl(std::vector<std::string> words) {
  const std::string domain = std::to_string(flexcast::test::test_domain());
  words.insert(words.begin(), {"flexcast-ctl", "--domain", domain, "--profile", "loopback"});
  std::vector<const char*> arguments;
  for (const auto& word : words) arguments.push_back(word.c_str());
  std::ostringstream out, err;
  const int code = run(static_cast<int>(arguments.size()), arguments.data(), out, err);
  return {code, out.str(), err.str()};
}

}  // namespace flexcast::ctl::test
