#include "tests/bench/stream/stream_world.h"

#include <spdlog/spdlog.h>

#include <cstdlib>

#include "core/scene/scene.h"

namespace flexcast::bench {
namespace {

using server::Clock;

template <class T, class R>
T value_or_exit(R result) {
  if (result) return std::move(result).value();
  spdlog::error("{}", result.error().message);
  std::exit(1);
}

Scene make_scene(const StreamCase& stream) {
  const std::string text =
      "name = \"bench\"\n[time]\nstep = " + std::to_string(stream.step) +
      "\nintegrator = \"symplectic_euler\"\n[[body]]\nname = \"sheet\"\nmodel = \"mass_spring\"\n" +
      "mesh = { shape = \"grid\", cells = [" + std::to_string(stream.cells_x) + ", " + std::to_string(stream.cells_y) +
      "], size = [3.0, 3.0] }\n" + "springs = { stiffness = 0.01 }\nmass = 0.01\n" +
      "velocity = [ { select = { box = [[0, 0, -1], [1, 1, 1]] }, value = [0.1, 0.2, 1.0] } ]\n";
  return value_or_exit<Scene>(load_scene_text(text));
}

}  // namespace

StreamWorld::StreamWorld(const StreamCase& stream, int domain)
    : participant_(value_or_exit<wire::Participant>(wire::Participant::create({.domain = domain}))),
      world_(make_scene(stream), {.rate = 1.0}, run_ids_),
      mailbox_(world_.simulation().model().particle_count()),
      simulation_(world_, commands_, replies_, mailbox_),
      publications_(value_or_exit<server::Publications>(server::Publications::create(
          participant_, "bench", run_ids_.next(), wire::frames_writer_qos(stream.frame_bytes())))),
      publisher_(publications_, mailbox_) {
  publisher_.start();
}

StreamWorld::~StreamWorld() {
  publisher_.stop();
}

std::vector<double> StreamWorld::run(double seconds) {
  std::vector<double> steps;
  const auto end = Clock::now() + server::from_seconds(seconds);
  while (Clock::now() < end) {
    const auto step = world_.simulation_state().step;
    const auto begin = Clock::now();
    const auto sleep = simulation_.turn(begin);
    if (world_.simulation_state().step > step) steps.push_back(server::seconds(Clock::now() - begin));
    if (sleep > Clock::duration::zero()) commands_.wait_for(sleep);
  }
  return steps;
}

}  // namespace flexcast::bench
