#include "clients/ctl/health.h"

#include <fmt/format.h>

#include <algorithm>

namespace flexcast::ctl {

std::string_view name_of(Health health) {
  switch (health) {
    case Health::ok:
      return "ok";
    case Health::hung:
      return "hung";
    case Health::gone:
      return "gone";
    case Health::ended:
      return "ended";
    case Health::not_found:
      break;
  }
  return "not_found";
}

void HealthJudge::see(const wire::StatusNews& news) {
  heard_ = news.heard;
  if (news.kind != wire::StatusNews::Kind::status) {
    end_ = news.kind == wire::StatusNews::Kind::goodbye ? Health::ended : Health::gone;
    pulse_ = false;
    return;
  }
  const bool same_server = status_ && !end_ && status_->server_id == news.status->server_id;
  const bool same_beat = same_server && status_->heartbeat == news.status->heartbeat;
  if (!same_beat) since_ = news.written;
  pulse_ = same_server && !same_beat;
  end_.reset();
  written_ = news.written;
  status_ = news.status;
}

double HealthJudge::still() const {
  return 1e-9 * static_cast<double>(written_ - since_);
}

double HealthJudge::patience() const {
  // Half a second, less what timers vary by: the third status comes 0.48 to 0.5 s after the first.
  constexpr double shortest = 0.47;
  return status_ ? std::max(shortest, 3.0 * status_->step_seconds) : shortest;
}

double HealthJudge::age(Clock::time_point now) const {
  return std::chrono::duration<double>(now - heard_).count();
}

Health HealthJudge::judge(Clock::time_point now) const {
  if (!status_) return Health::not_found;
  if (end_) return *end_;
  if (now - heard_ > silence) return Health::gone;
  return still() >= patience() ? Health::hung : Health::ok;
}

std::string describe(Health health, const HealthJudge& judge, HealthJudge::Clock::time_point now) {
  switch (health) {
    case Health::ok:
      return "alive and well";
    case Health::hung:
      return fmt::format(
          "alive, but its step loop stands still: heartbeat {} for {:.1f} s; a step hangs or takes that long, "
          "look at the server's machine and log",
          judge.status()->heartbeat, judge.still());
    case Health::gone:
      return fmt::format("gone or unreachable: its statuses stopped {:.1f} s ago without a goodbye", judge.age(now));
    case Health::ended:
      return "ended: its server said goodbye";
    case Health::not_found:
      break;
  }
  return "not there";
}

}  // namespace flexcast::ctl
