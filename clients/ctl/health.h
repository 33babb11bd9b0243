// Whether a world is well, judged from its statuses alone.
#pragma once

#include <chrono>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "idl/wire/status_watch.h"

namespace flexcast::ctl {

enum class Health {
  ok,         // its step loop goes round
  hung,       // statuses come, but the step loop stands still
  gone,       // statuses have stopped without a goodbye
  ended,      // its server ended on purpose
  not_found,  // there never was one
};

// "ok", "hung", "gone", "ended", "not_found"
std::string_view name_of(Health health);

// Follows one world. Pure: times are given, nothing is waited for.
class HealthJudge {
 public:
  using Clock = std::chrono::steady_clock;

  // News of the world (the caller picks them).
  void see(const wire::StatusNews& news);

  Health judge(Clock::time_point now) const;

  // One status has come and a later one whose heartbeat says that the step loop goes round between them.
  bool has_pulse() const { return pulse_; }

  std::shared_ptr<const flexcast_Status> status() const { return status_; }  // the newest; null: none came
  double age(Clock::time_point now) const;                                   // s since the newest status came
  double still() const;  // s between the first and the newest status with this heartbeat

  // How long the same heartbeat is no reason to worry, s: half a second, or three steps where they take longer.
  double patience() const;

  static constexpr std::chrono::milliseconds silence{1500};  // statuses come four times a second

 private:
  std::shared_ptr<const flexcast_Status> status_;
  std::optional<Health> end_;
  std::int64_t since_ = 0;  // when the first status with this heartbeat was written, ns
  std::int64_t written_ = 0;
  Clock::time_point heard_;
  bool pulse_ = false;
};

// One sentence about a world that is not well: what is the case, and where it was looked for.
std::string describe(Health health, const HealthJudge& judge, HealthJudge::Clock::time_point now);

}  // namespace flexcast::ctl
