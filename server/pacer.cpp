#include "server/pacer.h"

namespace flexcast::server {

void Pacer::set_rate(double rate) {
  if (rate == rate_) return;
  rate_ = rate;
  restart();
}

Clock::duration Pacer::calc_wait(Clock::time_point now, double time, double next_time) {
  if (rate_ <= 0.0) return Clock::duration::zero();
  if (!anchor_) anchor_ = {now, time};
  const auto due = anchor_->wall + from_seconds((next_time - anchor_->time) / rate_);
  if (due > now) return due - now;
  if (now - due > most_debt) anchor_ = {now, next_time};
  return Clock::duration::zero();
}

}  // namespace flexcast::server
