// DDS domains for tests: loopback only, and one of its own for every test process.
#pragma once

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <string>

#include "idl/wire/participant.h"

namespace flexcast::test {

// The first of 100..199, from the process id on, whose lock no other test process of this machine holds. The lock goes
// with the process.
inline int claim_test_domain() {
  for (int i = 0; i < 100; ++i) {
    const int domain = 100 + static_cast<int>((getpid() + i) % 100);
    const auto file = std::filesystem::temp_directory_path() / ("flexcast-test-domain-" + std::to_string(domain));
    const int lock = open(file.c_str(), O_CREAT | O_RDWR | O_CLOEXEC, 0666);
    if (lock >= 0 && flock(lock, LOCK_EX | LOCK_NB) == 0) return domain;
    if (lock >= 0) close(lock);
  }
  std::abort();
}

// A child process that shall meet its parent gets FLEXCAST_TEST_DOMAIN.
inline int test_domain() {
  static const char* const given = std::getenv("FLEXCAST_TEST_DOMAIN");
  static const int domain = given ? std::atoi(given) : claim_test_domain();
  return domain;
}

// Ends the program if there is no loopback interface: no test of the network could say anything then.
inline wire::Participant join_test_domain() {
  auto participant = wire::Participant::create({.domain = test_domain(), .profile = "loopback"});
  if (!participant) std::abort();
  return std::move(participant).value();
}

}  // namespace flexcast::test
