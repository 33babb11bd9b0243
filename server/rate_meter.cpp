#include "server/rate_meter.h"

namespace flexcast::server {
namespace {

constexpr auto window = std::chrono::seconds(1);
constexpr auto spacing = std::chrono::milliseconds(50);

}  // namespace

void RateMeter::start(Clock::time_point now, double time) {
  now_ = {now, time, 0.0, 0};
  marks_.assign(1, now_);
}

void RateMeter::stop() {
  marks_.clear();
}

void RateMeter::add_step(Clock::time_point now, double time, Clock::duration busy) {
  if (marks_.empty()) start(now - busy, time);
  now_ = {now, time, now_.busy + seconds(busy), now_.steps + 1};
  while (marks_.size() > 1 && marks_[1].wall <= now - window) marks_.pop_front();
  const Mark& oldest = marks_.front();
  step_seconds_ = (now_.busy - oldest.busy) / static_cast<double>(now_.steps - oldest.steps);
  if (now - marks_.back().wall >= spacing) marks_.push_back(now_);
}

double RateMeter::real_time_factor(Clock::time_point now) const {
  if (marks_.empty() || now <= marks_.front().wall) return 0.0;
  return (now_.time - marks_.front().time) / seconds(now - marks_.front().wall);
}

}  // namespace flexcast::server
