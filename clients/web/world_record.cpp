#include "clients/web/world_record.h"

#include <algorithm>

namespace flexcast::web {

std::vector<client::Parameter> WorldRecord::add_state(const StateNews& news) {
  States& states = states_[news.topic];
  if (news.topic == wire::TopicId::topology && topology_ != std::pair(news.run_id, news.revision)) {
    states.clear();
    topology_ = {news.run_id, news.revision};
  }
  states[news.key] = news.sample;
  if (!news.parameters) return {};
  auto changes = find_changes(parameters(), *news.parameters);
  parameters_ = news.parameters;
  return changes;
}

void WorldRecord::add_event(const EventNews& news) {
  if (news.run_id != events_run_) {
    events_.clear();
    event_bytes_ = 0;
    events_run_ = news.run_id;
  }
  events_.push_back(news.sample);
  event_bytes_ += news.sample.bytes.size();
  while (events_.size() > most_events || event_bytes_ > most_event_bytes) {
    event_bytes_ -= events_.front().bytes.size();
    events_.pop_front();
  }
}

void WorldRecord::add_frame(FramePointer frame) {
  frame_ = std::move(frame);
  ++frame_number_;
}

void WorldRecord::clear() {
  states_.clear();
  topology_ = {};
  parameters_.reset();
  status_.reset();
  events_.clear();
  event_bytes_ = 0;
  frame_.reset();
}

const Sample* WorldRecord::find_state(wire::TopicId topic, std::uint64_t key) const {
  const auto states = states_.find(topic);
  if (states == states_.end()) return nullptr;
  const auto sample = states->second.find(key);
  return sample == states->second.end() ? nullptr : &sample->second;
}

std::vector<std::uint64_t> WorldRecord::state_keys(wire::TopicId topic) const {
  std::vector<std::uint64_t> keys;
  const auto states = states_.find(topic);
  if (states == states_.end()) return keys;
  for (const auto& [key, sample] : states->second) keys.push_back(key);
  return keys;
}

const ParameterTable& WorldRecord::parameters() const {
  static const ParameterTable none;
  return parameters_ ? *parameters_ : none;
}

std::vector<client::Parameter> find_changes(const ParameterTable& before, const ParameterTable& now) {
  std::vector<client::Parameter> changes;
  for (const client::Parameter& parameter : now.values)
    if (std::find(before.values.begin(), before.values.end(), parameter) == before.values.end())
      changes.push_back(parameter);
  return changes;
}

}  // namespace flexcast::web
