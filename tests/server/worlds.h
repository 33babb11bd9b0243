// A small world and the commands to drive it, without threads and network.
#pragma once

#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <limits>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "server/world.h"
#include "tests/support/scene.h"

namespace flexcast::server::test {

inline constexpr double rope_step = 0.001;  // s
inline constexpr double nan = std::numeric_limits<double>::quiet_NaN();

inline std::string rope_scene(const std::string& more = {}) {
  return R"(name = "rope"
gravity = [0, 0, -9.81]
[time]
step = 0.001
[[body]]
name = "rope"
model = "mass_spring"
mesh = { shape = "rope", cells = [10], size = [1.0] }
springs = { stiffness = 100.0, damping = 0.1 }
mass = 0.01
pin = [ { select = { nodes = [0] } } ]
[[probe]]
name = "tip"
body = "rope"
node = 10
)" + more;
}

inline Scene load(const std::string& text) {
  auto scene = load_scene_text(text);
  if (!scene) throw std::runtime_error(scene.error().message);
  return std::move(scene).value();
}

// A folder that goes with the test.
class Folder {
 public:
  Folder() {
    std::string path = std::filesystem::temp_directory_path() / "flexcast-server-XXXXXX";
    if (mkdtemp(path.data()) == nullptr) throw std::runtime_error("cannot make " + path);
    path_ = path;
  }
  ~Folder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;
  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

inline Command make_command(CommandKind kind, CommandBody body) {
  static std::uint64_t request_id = 0;
  Command command;
  command.key = {"tester", ++request_id};
  command.kind = kind;
  command.body = std::move(body);
  return command;
}

inline Command set(std::vector<ParameterAssignment> values) {
  return make_command(CommandKind::set, SetCommand{std::move(values)});
}
inline Command pause() {
  return make_command(CommandKind::pause, PauseCommand{});
}
inline Command resume() {
  return make_command(CommandKind::resume, ResumeCommand{});
}
inline Command step(std::uint64_t count) {
  return make_command(CommandKind::step, StepCommand{count});
}
inline Command run_until(double time) {
  return make_command(CommandKind::run_until, RunUntilCommand{time});
}
inline Command reset(bool keep_parameters = false) {
  return make_command(CommandKind::reset, ResetCommand{keep_parameters});
}

inline Command load_scene(const std::string& name) {
  return make_command(CommandKind::load, LoadCommand{name});
}
inline Command save(const std::string& name) {
  return make_command(CommandKind::save, SaveCommand{name});
}
inline Command restore(const std::string& name) {
  return make_command(CommandKind::restore, RestoreCommand{name});
}
inline Command grab(std::int64_t particle, const Vec3& target, double stiffness = 0.0) {
  return make_command(CommandKind::grab, GrabCommand{particle, target, stiffness});
}
inline Command release(std::int64_t particle) {
  return make_command(CommandKind::release, ReleaseCommand{particle});
}

// A spring stiffness that makes the rope's explicit step blow up within a few steps.
inline Command set_explosive() {
  return set({{"rope.stiffness", 1e12}});
}

class TestWorld {
 public:
  explicit TestWorld(const WorldOptions& options = {}, const std::string& more_scene = {})
      : world_(load(rope_scene(more_scene)), options, run_ids_) {
    collect();
  }

  World& operator*() { return world_; }
  World* operator->() { return &world_; }
  const Simulation& simulation() const { return world_.simulation(); }
  std::int64_t step_now() const { return simulation().state().step; }

  void apply(const Command& command) {
    world_.apply(command, Clock::now());
    collect();
  }

  // As long as it runs, at most so many steps.
  void run(int steps) {
    for (int i = 0; i < steps && world_.running(); ++i) {
      world_.take_step();
      collect_frame();
      world_.settle(1e-6);
      collect();
    }
  }

  // The reply to the command, which must be there.
  Reply reply_to(const Command& command) const {
    const auto found = std::find_if(replies_.begin(), replies_.end(),
                                    [&](const Reply& reply) { return reply.key.request_id == command.key.request_id; });
    if (found == replies_.end()) throw std::runtime_error("there is no reply");
    return *found;
  }
  Reply ask(const Command& command) {
    apply(command);
    return reply_to(command);
  }
  bool is_answered(const Command& command) const { return count_replies(command) > 0; }
  std::ptrdiff_t count_replies(const Command& command) const {
    return std::count_if(replies_.begin(), replies_.end(),
                         [&](const Reply& reply) { return reply.key.request_id == command.key.request_id; });
  }

  std::vector<Event> events() const { return notices_of<Event>(); }
  template <class T>
  std::vector<T> notices_of() const {
    std::vector<T> found;
    for (const Notice& notice : notices_) {
      if (const T* one = std::get_if<T>(&notice)) found.push_back(*one);
    }
    return found;
  }
  const std::vector<FrameHeader>& frames() const { return frames_; }

  double parameter(const std::string& name) const {
    return std::get<double>(simulation().parameter(*simulation().find_parameter(name)));
  }

 private:
  void collect_frame() {
    if (auto frame = world_.take_due_frame()) frames_.push_back(*frame);
  }
  void collect() {
    collect_frame();
    for (Reply& reply : world_.take_replies()) replies_.push_back(std::move(reply));
    for (Notice& notice : world_.take_notices()) notices_.push_back(std::move(notice));
  }

  RunIds run_ids_;
  World world_;
  std::vector<Reply> replies_;
  std::vector<Notice> notices_;
  std::vector<FrameHeader> frames_;
};

inline WorldOptions started_paused() {
  WorldOptions options;
  options.paused = true;
  return options;
}

}  // namespace flexcast::server::test
