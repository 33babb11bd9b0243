// DDS domains for tests: loopback only, and one of its own for every test process.
#pragma once

#include <unistd.h>

#include <cstdlib>

#include "idl/wire/participant.h"

namespace flexcast::test {

// 100..199 by process id; a child process that shall meet its parent gets FLEXCAST_TEST_DOMAIN.
inline int test_domain() {
  const char* given = std::getenv("FLEXCAST_TEST_DOMAIN");
  return given ? std::atoi(given) : 100 + static_cast<int>(getpid() % 100);
}

// Ends the program if there is no loopback interface: no test of the network could say anything then.
inline wire::Participant join_test_domain() {
  auto participant = wire::Participant::create({.domain = test_domain(), .profile = "loopback"});
  if (!participant) std::abort();
  return std::move(participant).value();
}

}  // namespace flexcast::test
