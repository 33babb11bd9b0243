// WorldRecord: what is known of one world, for those who come later.
#pragma once

#include <chrono>
#include <deque>
#include <map>

#include "clients/web/news.h"

namespace flexcast::web {

enum class Life {
  unknown,  // not heard yet
  alive,
  silent,  // its server hangs, was killed or is out of reach
  ended,   // on purpose
};

class WorldRecord {
 public:
  using Clock = std::chrono::steady_clock;
  explicit WorldRecord(std::string name) : name_(std::move(name)) {}
  WorldRecord(const WorldRecord&) = delete;
  WorldRecord& operator=(const WorldRecord&) = delete;

  const std::string& name() const { return name_; }

  Life life = Life::unknown;
  std::string prefix{};  // of its channels, services and parameters: "" or "NAME/"
  bool advertised = false;
  Clock::time_point heard{};
  std::uint64_t server_id = 0;
  wire::Guid server{};

  // Returns the parameters that are new or have changed.
  std::vector<client::Parameter> add_state(const StateNews& news);
  void add_status(const Sample& sample) { status_ = sample; }
  void add_event(const EventNews& news);
  void add_frame(FramePointer frame);
  void forget_frame() { frame_.reset(); }
  void clear();  // all samples

  const Sample* find_state(wire::TopicId topic, std::uint64_t key) const;  // null: there is none
  std::vector<std::uint64_t> state_keys(wire::TopicId topic) const;
  const std::optional<Sample>& status() const { return status_; }
  const std::deque<Sample>& events() const { return events_; }  // of the present run, the newest
  const ParameterTable& parameters() const;
  const FramePointer& frame() const { return frame_; }          // null: none
  std::uint64_t frame_number() const { return frame_number_; }  // counts the frames that came

  static constexpr std::size_t most_events = 256;
  static constexpr std::size_t most_event_bytes = 512 * 1024;

 private:
  using States = std::map<std::uint64_t, Sample>;  // by key

  std::string name_;
  std::map<wire::TopicId, States> states_;
  std::pair<std::uint64_t, std::uint64_t> topology_{};  // run and revision
  std::shared_ptr<const ParameterTable> parameters_;    // shared: with the news
  std::optional<Sample> status_;
  std::deque<Sample> events_;
  std::size_t event_bytes_ = 0;
  std::uint64_t events_run_ = 0;
  FramePointer frame_;
  std::uint64_t frame_number_ = 0;
};

// Those of `now` that `before` has not, or has with another value.
std::vector<client::Parameter> find_changes(const ParameterTable& before, const ParameterTable& now);

}  // namespace flexcast::web
