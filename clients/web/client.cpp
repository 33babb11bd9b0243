#include "clients/web/client.h"

#include <algorithm>

#include "clients/web/messages.h"

namespace flexcast::web {

void Client::receive(bool is_text, std::string_view message) {
  if (may_go_on()) host_.handle(*this, is_text, message);
}

bool Client::may_go_on() {
  if (closing_) return false;
  if (rate_.pass(RateLimit::Clock::now())) return true;
  closing_ = true;
  line_.close(CloseCode::policy, "more than 200 messages a second");
  return false;
}

void Client::send(Outgoing message) {
  if (closing_) return;
  if (queue_.size() >= limits::queue_messages || queue_bytes_ + message.size() > limits::queue_bytes) {
    closing_ = true;
    queue_.clear();
    line_.close(CloseCode::policy, "too slow: a mebibyte of messages waits");
    return;
  }
  greet(std::move(message));
}

void Client::greet(Outgoing message) {
  queue_bytes_ += message.size();
  queue_.push_back(std::move(message));
  line_.wake();
}

std::string Client::subscribe(std::uint32_t id, const Channel& channel, const WorldRecord& world) {
  if (subscriptions_.contains(id)) return "there is a subscription " + std::to_string(id) + " already";
  for (const auto& [other, subscription] : subscriptions_)
    if (subscription.channel == &channel) return "there is a subscription to " + channel.topic + " already";
  Subscription& subscription = subscriptions_[id] = {&channel, &world};
  send_newest(id, subscription);
  line_.wake();
  return "";
}

void Client::send_newest(std::uint32_t id, Subscription& subscription) {
  const WorldRecord& world = *subscription.world;
  const ChannelRow& row = *subscription.channel->row;
  if (row.flow == Flow::state) {
    const auto keys = world.state_keys(row.id);
    subscription.keys = {keys.begin(), keys.end()};
  } else if (row.id == wire::TopicId::status && world.status()) {
    send(data_message(id, *world.status()));
  } else if (row.id == wire::TopicId::events) {
    for (const Sample& event : world.events()) send(data_message(id, event));
  }
}

bool Client::unsubscribe(std::uint32_t id) {
  if (begun_ && begun_->subscription == id) begun_.reset();
  return subscriptions_.erase(id) > 0;
}

void Client::drop(const WorldRecord& world) {
  std::erase_if(subscriptions_, [&](const auto& entry) { return entry.second.world == &world; });
  if (begun_ && !subscriptions_.contains(begun_->subscription)) begun_.reset();
}

void Client::note_state(const WorldRecord& world, wire::TopicId topic, std::uint64_t key) {
  for (auto& [id, subscription] : subscriptions_) {
    const ChannelRow& row = *subscription.channel->row;
    if (subscription.world != &world || row.flow != Flow::state || row.id != topic) continue;
    subscription.keys.insert(key);
    line_.wake();
  }
}

void Client::note_log(const WorldRecord& world, wire::TopicId topic, const Sample& sample) {
  for (const auto& [id, subscription] : subscriptions_) {
    if (subscription.world != &world || subscription.channel->row->id != topic) continue;
    return send(data_message(id, sample));
  }
}

void Client::note_frame(const WorldRecord& world) {
  if (wants(Flow::frames, world) || wants(Flow::points, world)) line_.wake();
}

bool Client::wants(Flow flow, const WorldRecord& world) const {
  return std::any_of(subscriptions_.begin(), subscriptions_.end(), [&](const auto& entry) {
    return entry.second.world == &world && entry.second.channel->row->flow == flow;
  });
}

bool Client::wants(Flow flow) const {
  return std::any_of(subscriptions_.begin(), subscriptions_.end(),
                     [&](const auto& entry) { return entry.second.channel->row->flow == flow; });
}

void Client::watch(const std::vector<std::string>& names) {
  if (names.empty()) watches_all_ = true;
  for (const std::string& name : names)
    if (watched_.size() < limits::watched_names) watched_.insert(name);
}

void Client::unwatch(const std::vector<std::string>& names) {
  if (names.empty()) {
    watches_all_ = false;
    watched_.clear();
  }
  for (const std::string& name : names) watched_.erase(name);
}

// The chunks of a frame stay together; then small messages, what describes the worlds, and at last frames.
std::optional<Outgoing> Client::next() {
  if (auto chunk = next_chunk()) return chunk;
  if (!queue_.empty()) {
    Outgoing message = std::move(queue_.front());
    queue_.pop_front();
    queue_bytes_ -= message.size();
    return message;
  }
  if (auto state = next_state()) return state;
  return next_frame();
}

std::optional<Outgoing> Client::next_chunk() {
  if (!begun_) return {};
  Outgoing message = data_message(begun_->subscription, begun_->frame->chunks[begun_->next_chunk]);
  if (++begun_->next_chunk == begun_->frame->chunks.size()) begun_.reset();
  return message;
}

std::optional<Outgoing> Client::next_state() {
  for (const wire::TopicId topic : {wire::TopicId::scene, wire::TopicId::topology, wire::TopicId::parameters}) {
    for (auto& [id, subscription] : subscriptions_) {
      if (subscription.channel->row->id != topic) continue;
      while (!subscription.keys.empty()) {
        const auto key = subscription.keys.extract(subscription.keys.begin()).value();
        if (const Sample* sample = subscription.world->find_state(topic, key)) return data_message(id, *sample);
      }
    }
  }
  return {};
}

// In turns, should there be several subscriptions to frames.
std::optional<Outgoing> Client::next_frame() {
  const auto serve = [&](auto first, auto last) -> std::optional<Outgoing> {
    for (; first != last; ++first) {
      const auto flow = first->second.channel->row->flow;
      if (flow != Flow::frames && flow != Flow::points) continue;
      if (auto message = begin_frame(first->first, first->second)) return message;
    }
    return {};
  };
  const auto middle = subscriptions_.upper_bound(last_served_);
  if (auto message = serve(middle, subscriptions_.end())) return message;
  return serve(subscriptions_.begin(), middle);
}

std::optional<Outgoing> Client::begin_frame(std::uint32_t id, Subscription& subscription) {
  const FramePointer& frame = subscription.world->frame();
  if (!frame || subscription.frame_number == subscription.world->frame_number()) return {};
  const bool as_points = subscription.channel->row->flow == Flow::points;
  if (as_points && !frame->points) return {};
  subscription.frame_number = subscription.world->frame_number();
  last_served_ = id;
  if (as_points) return data_message(id, *frame->points);
  begun_ = Begun{id, frame, 0};
  return next_chunk();
}

}  // namespace flexcast::web
