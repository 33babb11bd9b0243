#include "tests/bench/stream/fault_run.h"

#include <algorithm>
#include <csignal>
#include <memory>
#include <nlohmann/json.hpp>

#include "tests/bench/stream/child.h"

namespace flexcast::bench {
namespace {

constexpr int subscriber_count = 3;
using Subscribers = std::vector<std::unique_ptr<Child>>;

// All of them, matched while the world goes on.
Subscribers start_subscribers(const StreamCase& stream, StreamWorld& world, int domain) {
  Subscribers subscribers;
  const std::vector<std::string> arguments = {"--subscriber", std::to_string(stream.frame_bytes()), "--domain",
                                              std::to_string(domain)};
  for (int i = 0; i < subscriber_count; ++i) {
    subscribers.push_back(std::make_unique<Child>("/proc/self/exe", arguments));
  }
  for (auto& subscriber : subscribers) subscriber->hear();
  world.run(1.0);
  for (auto& subscriber : subscribers) subscriber->tell("clear");
  world.run(0.2);
  return subscribers;
}

void begin_fault(std::unique_ptr<Child>& subscriber, Fault fault) {
  if (fault == Fault::stop) subscriber->signal(SIGSTOP);
  if (fault == Fault::throttle) subscriber->tell("slow");
  if (fault == Fault::kill) subscriber.reset();
}

void end_fault(const std::unique_ptr<Child>& subscriber, Fault fault) {
  if (fault == Fault::stop) subscriber->signal(SIGCONT);
  if (fault == Fault::throttle) subscriber->tell("fast");
}

// What is missing at the subscriber but was published.
std::uint64_t ask_lost(Child& subscriber, std::uint64_t skipped) {
  subscriber.tell("report");
  const auto report = nlohmann::json::parse(subscriber.hear());
  const auto missing = report.at("bench").at("missing").get<std::uint64_t>();
  return missing - std::min(missing, skipped);
}

}  // namespace

const char* name_of(Fault fault) {
  switch (fault) {
    case Fault::none:
      return "none";
    case Fault::stop:
      return "stop";
    case Fault::kill:
      return "kill";
    case Fault::throttle:
      return "throttle";
  }
  return "?";
}

FaultResult run_with_fault(const StreamCase& stream, Fault fault, double seconds, int domain) {
  StreamWorld world(stream, domain);
  Subscribers subscribers = start_subscribers(stream, world, domain);
  FaultResult result;
  const auto skipped_before = world.frames_skipped();
  result.healthy_steps = world.run(seconds / 3.0);
  begin_fault(subscribers[0], fault);
  result.faulty_steps = world.run(seconds / 3.0);
  end_fault(subscribers[0], fault);
  const auto after = world.run(seconds / 3.0);
  if (fault != Fault::kill) result.healthy_steps.insert(result.healthy_steps.end(), after.begin(), after.end());
  world.run(0.3);  // what was skipped shows in a status, what is under way arrives
  result.skipped = world.frames_skipped() - skipped_before;
  result.lost = ask_lost(*subscribers[1], result.skipped) + ask_lost(*subscribers[2], result.skipped);
  return result;
}

}  // namespace flexcast::bench
