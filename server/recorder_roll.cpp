#include "server/recorder_roll.h"

#include <algorithm>

namespace flexcast::server {
namespace {

bool has_begun(const RecorderRoll::Standing& standing, const RecorderRoll::Position& position) {
  return standing.run_id == position.run_id && standing.next_frame > 0;
}

}  // namespace

void RecorderRoll::note(const std::string& recorder, const Standing& standing) {
  const std::scoped_lock lock(mutex_);
  recorders_[recorder] = standing;
}

void RecorderRoll::forget(const std::string& recorder) {
  const std::scoped_lock lock(mutex_);
  recorders_.erase(recorder);
}

std::uint64_t RecorderRoll::calc_window(std::size_t history, std::size_t mailbox) {
  const std::size_t half = std::min(history, mailbox) / 2;
  return half > 2 ? half - 1 : 1;
}

bool RecorderRoll::holds(const Standing& standing, const Position& position) const {
  if (standing.paused) return false;
  if (!has_begun(standing, position)) return true;
  return position.frame >= standing.next_frame + calc_window(rules_.history, position.mailbox);
}

std::size_t RecorderRoll::count_beginners(const Position& position) const {
  return static_cast<std::size_t>(std::count_if(recorders_.begin(), recorders_.end(),
                                                [&](const auto& entry) { return has_begun(entry.second, position); }));
}

bool RecorderRoll::may_step(const Position& position) {
  const std::scoped_lock lock(mutex_);
  if (!assembled_ && count_beginners(position) < rules_.recorders) return false;
  assembled_ = true;
  return std::none_of(recorders_.begin(), recorders_.end(),
                      [&](const auto& entry) { return holds(entry.second, position); });
}

bool RecorderRoll::have_all(const Position& position) const {
  const std::scoped_lock lock(mutex_);
  return std::all_of(recorders_.begin(), recorders_.end(), [&](const auto& entry) {
    const Standing& standing = entry.second;
    return standing.paused || (has_begun(standing, position) && standing.next_frame > position.frame);
  });
}

std::vector<std::string> RecorderRoll::calc_waits(const Position& position) const {
  const std::scoped_lock lock(mutex_);
  std::vector<std::string> waits;
  for (const auto& [recorder, standing] : recorders_) {
    if (!holds(standing, position)) continue;
    const std::string has = has_begun(standing, position)
                                ? "has the frames before " + std::to_string(standing.next_frame) + " of " +
                                      std::to_string(position.frame + 1)
                                : "has no frame of this run yet";
    waits.push_back("lockstep: the world waits for recorder '" + recorder + "', which " + has);
  }
  const std::size_t begun = count_beginners(position);
  if (!assembled_ && begun < rules_.recorders) {
    waits.push_back("lockstep: the world waits for " + std::to_string(rules_.recorders) + " recorders, of which " +
                    std::to_string(begun) + " have its first frame");
  }
  return waits;
}

}  // namespace flexcast::server
