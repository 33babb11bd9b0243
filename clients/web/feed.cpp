#include "clients/web/feed.h"

#include "clients/web/decode_news.h"
#include "clients/web/point_cloud.h"
#include "idl/wire/decode.h"
#include "idl/wire/fill.h"
#include "idl/wire/message_head.h"

namespace flexcast::web {
namespace {

using namespace std::chrono_literals;
using wire::TopicId;

constexpr std::size_t batch = 64;
constexpr auto longest_wait = 500ms;
// A chunk may come before the one of the frame before has been taken.
constexpr wire::Qos frames_qos{.depth = 4};

Sample keep(const wire::RawSample& sample) {
  return {sample.shared, sample.info.source_time};
}

// Takes batch after batch, a bounded number of them; true if there was anything.
template <class Receive>
bool take_each(const wire::RawReader& reader, const Receive& receive) {
  bool any = false;
  for (int i = 0; i < 64; ++i) {
    const auto count = reader.take_raw(receive, batch);
    if (!count || count.value() == 0) break;
    any = true;
    if (count.value() < batch) break;
  }
  return any;
}

}  // namespace

wire::Result<std::unique_ptr<Feed>> Feed::create(const wire::Participant& participant, std::string client_id,
                                                 std::function<void()> wake) {
  const auto make = [&](TopicId topic) {
    return wire::RawReader::create(participant, wire::topic(topic), wire::topic(topic).monitor);
  };
  auto status = make(TopicId::status);
  if (!status) return status.error();
  auto events = make(TopicId::events);
  if (!events) return events.error();
  Readers readers{{}, std::move(status).value(), std::move(events).value()};
  for (const TopicId topic : {TopicId::scene, TopicId::topology, TopicId::parameters}) {
    auto reader = make(topic);
    if (!reader) return reader.error();
    readers.states.push_back(std::move(reader).value());
  }
  auto replies = wire::Reader<flexcast_Reply>::create(participant);
  if (!replies) return replies.error();
  auto guard = wire::GuardCondition::create(participant);
  if (!guard) return guard.error();
  std::unique_ptr<Feed> feed(new Feed(participant, std::move(client_id), std::move(wake), std::move(readers),
                                      std::move(replies).value(), std::move(guard).value()));
  if (auto made = feed->make_wait_set(); !made) return made.error();
  return feed;
}

Feed::Feed(const wire::Participant& participant, std::string client_id, std::function<void()> wake, Readers readers,
           wire::Reader<flexcast_Reply> replies, wire::GuardCondition guard)
    : participant_(participant),
      client_id_(std::move(client_id)),
      wake_(std::move(wake)),
      readers_(std::move(readers)),
      replies_(std::move(replies)),
      guard_(std::move(guard)) {}

Feed::~Feed() {
  stop();
}

void Feed::stop() {
  stopping_ = true;
  guard_.trigger();
  if (thread_.joinable()) thread_.join();
}

void Feed::start() {
  thread_ = std::thread(&Feed::run, this);
}

void Feed::want(const Wanted& wanted) {
  {
    const std::scoped_lock lock(mutex_);
    wanted_ = wanted;
  }
  guard_.trigger();
}

Wanted Feed::wanted() const {
  const std::scoped_lock lock(mutex_);
  return wanted_;
}

wire::Result<void> Feed::make_wait_set() {
  wait_set_.reset();
  auto made = wire::WaitSet::create(participant_);
  if (!made) return made.error();
  wait_set_ = std::move(made).value();
  if (auto attached = wait_set_->attach(guard_); !attached) return attached;
  for (const auto& reader : readers_.states)
    if (auto attached = wait_set_->attach_data(reader); !attached) return attached;
  if (auto attached = wait_set_->attach_data(readers_.status); !attached) return attached;
  if (auto attached = wait_set_->attach_data(readers_.events); !attached) return attached;
  if (auto attached = wait_set_->attach_data(replies_); !attached) return attached;
  if (frames_) return wait_set_->attach_data(*frames_);
  return {};
}

void Feed::run() {
  while (!stopping_) {
    if (wait_set_) wait_set_->wait(longest_wait);
    guard_.reset();
    now_wanted_ = wanted();
    tend_frames_reader();
    if (take_all()) wake_();
  }
}

// What describes a world comes before its frames.
bool Feed::take_all() {
  bool any = false;
  for (const auto& reader : readers_.states) any |= take_states(reader);
  any |= take_status();
  any |= take_events();
  any |= take_replies();
  return take_frames() || any;
}

// A wait set cannot let go of a reader, so it is made anew. What fails is tried again at the next turn.
void Feed::tend_frames_reader() {
  if (now_wanted_.frames == frames_.has_value()) return;
  wait_set_.reset();
  frames_.reset();
  groupers_.clear();
  if (now_wanted_.frames) {
    auto reader = wire::RawReader::create(participant_, wire::topic(TopicId::frames), frames_qos);
    if (reader) frames_.emplace(std::move(reader).value());
  }
  (void)make_wait_set();
}

bool Feed::take_states(const wire::RawReader& reader) {
  return take_each(reader, [&](const wire::RawSample& sample) {
    if (!sample.info.valid) return;
    if (auto news = decode_state(reader.row().id, keep(sample))) box_.put(std::move(*news));
  });
}

bool Feed::take_status() {
  return take_each(readers_.status, [&](const wire::RawSample& sample) { add_status(sample); });
}

void Feed::add_status(const wire::RawSample& sample) {
  if (sample.info.valid) {
    const auto status = wire::decode<flexcast_Status>(sample.bytes);
    if (!status) return;
    std::string world(wire::text(status.value()->world));
    statuses_[sample.info.instance] = world;
    const auto server = readers_.status.participant_of(sample.info.writer).value_or(wire::Guid{});
    box_.put(StatusNews{std::move(world), status.value()->server_id, server, keep(sample)});
  }
  if (sample.info.state == wire::InstanceState::alive) return;
  // The samples that say so may carry data still, that of before.
  const auto known = statuses_.find(sample.info.instance);
  if (known == statuses_.end()) return;
  box_.put(EndNews{known->second, sample.info.state == wire::InstanceState::disposed});
}

bool Feed::take_events() {
  return take_each(readers_.events, [&](const wire::RawSample& sample) {
    const auto event = wire::decode<flexcast_Event>(sample.bytes);
    if (!sample.info.valid || !event) return;
    box_.put(EventNews{std::string(wire::text(event.value()->world)), event.value()->run_id, keep(sample)});
  });
}

bool Feed::take_replies() {
  const auto samples = replies_.take(batch);
  if (!samples) return false;
  bool any = false;
  for (const auto [reply, info] : samples.value()) {
    if (!info.valid || wire::text(reply.client_id) != client_id_) continue;
    box_.put(ReplyNews{std::string(wire::text(reply.world)), reply.request_id, client::from_wire(reply)});
    any = true;
  }
  return any;
}

bool Feed::take_frames() {
  return frames_ && take_each(*frames_, [&](const wire::RawSample& sample) { add_frame(sample); });
}

void Feed::add_frame(const wire::RawSample& sample) {
  const auto head = wire::peek_frame_head(sample.bytes);
  if (!sample.info.valid || !head) return;
  const std::string world(head.value().world);
  auto frame = groupers_[world].add(head.value(), keep(sample));
  if (!frame) return;
  if (now_wanted_.points.contains(world)) frame->points = make_points(*frame);
  box_.put_frame(world, std::make_shared<const WholeFrame>(std::move(*frame)));
}

}  // namespace flexcast::web
