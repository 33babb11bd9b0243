// Commands off the wire to a small world: any bytes are a command or refused, every command is answered once at most
// and with finite values, and no frame falls due that is not finite. An input is a row of samples, each after its
// length (two bytes, the lower first).
#include <unistd.h>

#include <cmath>
#include <filesystem>

#include "core/state/state.h"
#include "idl/wire/decode.h"
#include "idl/wire/fill.h"
#include "server/convert/commands.h"
#include "server/convert/events.h"
#include "server/convert/status.h"
#include "server/world.h"
#include "tests/fuzz/targets/fuzz.h"

namespace flexcast::fuzz {
namespace {

using namespace server;

constexpr int most_steps = 8;        // after each command
constexpr int most_commands = 16;    // of one input
constexpr int most_iterations = 50;  // substeps, sweeps: an input is a matter of milliseconds

constexpr const char* scene_text = R"(name = "pair"
gravity = [0, 0, -9.81]
[time]
step = 0.001
integrator = "backward_euler"
[[body]]
name = "beam"
model = "fem"
mesh = { shape = "beam", cells = [1, 1, 1], size = [0.1, 0.1, 0.1] }
material = { law = "corotational", young = 1e5, poisson = 0.3, density = 1000.0 }
pin = [ { select = { nodes = [0] } } ]
[[body]]
name = "rope"
model = "mass_spring"
mesh = { shape = "rope", cells = [4], size = [1.0] }
springs = { stiffness = 50.0, damping = 0.01 }
mass = 0.05
pin = [ { select = { nodes = [0] } } ]
[[contact]]
name = "ground"
shape = "plane"
point = [0, 0, -1]
normal = [0, 0, 1]
)";

Result<Scene> load_any(const std::string&) {
  return load_scene_text(scene_text);
}

// Checkpoints go here; emptied before every input, so that each is for itself.
std::filesystem::path make_folder() {
  const auto folder = std::filesystem::path("/dev/shm") / ("flexcast-fuzz-" + std::to_string(getpid()));
  std::filesystem::remove_all(folder);
  return folder;
}

bool is_cheap(const Settings& settings) {
  return settings.time.substeps <= most_iterations && settings.solver.iterations <= most_iterations &&
         settings.solver.newton_iterations <= most_iterations;
}

void check_outcome(World& world) {
  if (world.take_due_frame()) require(is_publishable(world.simulation_state()), "a frame that is not finite");
  for (const Reply& reply : world.take_replies()) {
    const auto sample = to_wire(reply, "pair");
    require(std::isfinite(sample->time), "a time that is not finite");
    require(sample->outcome == flexcast_OUTCOME_APPLIED || !wire::text(sample->reason).empty(), "a no without reason");
    for (const auto& value : wire::elements(sample->values))
      for (const double number : wire::elements(value.numbers))
        require(std::isfinite(number), "a value in force that is not finite");
  }
  for (const Notice& notice : world.take_notices())
    if (const auto* event = std::get_if<Event>(&notice)) (void)to_wire(*event, "pair");
  (void)to_wire(world.calc_status(), {}, {"pair", 1});
}

void execute(World& world, const flexcast_Command& message) {
  const auto now = Clock::time_point{};
  world.apply(from_wire(message, now), now);
  check_outcome(world);
  for (int i = 0; i < most_steps && world.running() && is_cheap(world.simulation().settings()); ++i) {
    world.take_step();
    world.settle(1e-3);
    check_outcome(world);
  }
}

}  // namespace
}  // namespace flexcast::fuzz

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace flexcast;
  auto bytes = fuzz::as_bytes(data, size);
  server::RunIds run_ids;
  server::World world(fuzz::load_any("").value(),
                      {.paused = true, .checkpoints = fuzz::make_folder(), .load_scene = fuzz::load_any}, run_ids);
  for (int i = 0; i < fuzz::most_commands && bytes.size() > 2; ++i) {
    const auto low = std::to_integer<std::size_t>(bytes[0]), high = std::to_integer<std::size_t>(bytes[1]);
    bytes = bytes.subspan(2);
    const auto sample = bytes.first(std::min(bytes.size(), low + 256 * high));
    bytes = bytes.subspan(sample.size());
    if (const auto command = wire::decode<flexcast_Command>(sample)) fuzz::execute(world, *command.value());
  }
  world.close();
  fuzz::check_outcome(world);
  return 0;
}
