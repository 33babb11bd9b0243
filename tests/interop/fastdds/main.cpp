// flexcast-fastdds DOMAIN WORLD PARAMETER=NUMBER STEPS
//
// Sets a parameter of a paused world, does so many steps and prints what it receives, a line each:
//
//   reply REQUEST OUTCOME APPLIED_STEP REASON
//   frame NUMBER STEP STATE_HASH PARTICLES X0 Y0 Z0 X1 ...   (numbers of the stream's own precision, all digits)
//
// Ends with 0 when it has the frame of the last step, 1 if something did not come within half a minute.
#include <cinttypes>
#include <cstdio>
#include <cstdlib>
#include <exception>

#include "client.h"

namespace {

using namespace std::chrono_literals;
constexpr auto patience = 30s;

template <class T>
void print_positions(const std::vector<T>& positions) {
  for (const T x : positions) std::printf(" %.17g", static_cast<double>(x));
}

void print(const flexcast::ParticleFrame& frame) {
  std::printf("frame %" PRIu64 " %" PRIu64 " %" PRIu64 " %u", frame.frame(), frame.step(), frame.state_hash(),
              frame.total());
  print_positions(frame.positions());
  print_positions(frame.positions64());
  std::printf("\n");
}

flexcast::Command make_set(const std::string& assignment) {
  const std::size_t equals = assignment.find('=');
  flexcast::ParameterValue value;
  value.name(assignment.substr(0, equals));
  value.kind(flexcast::VALUE_NUMBER);
  value.numbers({std::strtod(assignment.c_str() + equals + 1, nullptr)});
  flexcast::Command command;
  command.kind(flexcast::COMMAND_SET);
  command.values({value});
  return command;
}

flexcast::Command make_step(std::uint64_t count) {
  flexcast::Command command;
  command.kind(flexcast::COMMAND_STEP);
  command.count(count);
  return command;
}

// The step after which the command acts; none: no reply.
std::optional<std::uint64_t> execute(flexcast_fastdds::Client& client, const flexcast::Command& command) {
  const auto reply = client.send(command, patience);
  if (!reply) return {};
  std::printf("reply %" PRIu64 " %d %" PRIu64 " %s\n", reply->request_id(), static_cast<int>(reply->outcome()),
              reply->applied_step(), reply->reason().c_str());
  return reply->applied_step();
}

bool run(int domain, const std::string& world, const std::string& assignment, std::uint64_t steps) {
  flexcast_fastdds::Client client(domain, world);
  if (!client.wait_for_match(patience)) return std::fprintf(stderr, "no server of %s\n", world.c_str()), false;
  const bool set = execute(client, make_set(assignment)).has_value();
  const auto last = execute(client, make_step(steps));
  if (!set || !last) return std::fprintf(stderr, "no reply\n"), false;
  for (std::uint64_t step = 0; step != *last;) {
    const auto frames = client.take_frames(patience);
    if (frames.empty()) return std::fprintf(stderr, "no more frames after step %" PRIu64 "\n", step), false;
    for (const auto& frame : frames) print(frame);
    step = frames.back().step();
  }
  return true;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 5) return std::fprintf(stderr, "usage: %s DOMAIN WORLD PARAMETER=NUMBER STEPS\n", argv[0]), 2;
  try {
    return run(std::atoi(argv[1]), argv[2], argv[3], std::strtoull(argv[4], nullptr, 10)) ? 0 : 1;
  } catch (const std::exception& error) {
    return std::fprintf(stderr, "%s\n", error.what()), 1;
  }
}
