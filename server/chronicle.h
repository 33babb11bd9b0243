// Chronicle: the events of a run, numbered without gaps, and the other notices a world gives.
#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "server/convert/notice_types.h"

namespace flexcast::server {

// Where the world stands when something happens.
struct Moment {
  std::int64_t step = 0;
  double time = 0.0;
  WorldState state = WorldState::paused;
  std::uint64_t parameter_revision = 0;
};

class Chronicle {
 public:
  // Numbers start at 0 again.
  void begin_run(RunStarted run);
  std::uint64_t run_id() const { return run_id_; }

  // An applied command that changed something. `values`: see Event; its other fields come from the command.
  void note_command(const Moment& moment, const Command& command, std::string text,
                    std::vector<ParameterAssignment> values = {});
  void note_state(const Moment& moment, std::string text);
  // What a contract chose, in force from the moment on.
  void note_choice(const Moment& moment, std::string text, std::vector<ParameterAssignment> values);
  void note_warning(const Moment& moment, std::string text);
  void note_parameters(ParametersChanged parameters) { notices_.emplace_back(std::move(parameters)); }

  std::vector<Notice> take() { return std::exchange(notices_, {}); }

 private:
  Event make_event(const Moment& moment, EventKind kind, std::string text);

  std::uint64_t run_id_ = 0;
  std::uint64_t next_index_ = 0;
  std::vector<Notice> notices_;
};

}  // namespace flexcast::server
