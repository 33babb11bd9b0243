#include "clients/ctl/interruption.h"

#include <array>
#include <csignal>
#include <cstddef>

namespace flexcast::ctl {
namespace {

volatile std::sig_atomic_t interrupted = 0;
constexpr std::array signals{SIGINT, SIGTERM};

}  // namespace

Interruption::Interruption() {
  interrupted = 0;
  for (std::size_t i = 0; i < signals.size(); ++i) {
    previous_[i] = std::signal(signals[i], [](int) { interrupted = 1; });
  }
}

Interruption::~Interruption() {
  for (std::size_t i = 0; i < signals.size(); ++i) std::signal(signals[i], previous_[i]);
}

bool Interruption::happened() const {
  return interrupted != 0;
}

}  // namespace flexcast::ctl
