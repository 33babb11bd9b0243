#include "clients/replay/pacer.h"

#include <algorithm>
#include <cmath>

namespace flexcast::replay {

void Pacer::set_rate(double rate) {
  rate_ = rate;
  restart();
}

Clock::duration Pacer::calc_wait(Clock::time_point now, double time, double next_time) {
  constexpr double year = 365.0 * 86400.0;  // s: longer would not fit a duration
  if (rate_ <= 0.0 || !std::isfinite(time) || !std::isfinite(next_time)) return Clock::duration::zero();
  if (next_time < time) anchor_ = {now, next_time};
  if (!anchor_) anchor_ = {now, time};
  const std::chrono::duration<double> span(std::min((next_time - anchor_->time) / rate_, year));
  const auto due = anchor_->wall + std::chrono::duration_cast<Clock::duration>(span);
  if (due > now) return due - now;
  if (now - due > most_debt) anchor_ = {now, next_time};
  return Clock::duration::zero();
}

}  // namespace flexcast::replay
