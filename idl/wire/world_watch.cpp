#include "idl/wire/world_watch.h"

#include <algorithm>

namespace flexcast::wire {

using Clock = std::chrono::steady_clock;
using namespace std::chrono_literals;

Result<WorldWatch> WorldWatch::create(const Participant& participant) {
  auto reader = Reader<flexcast_Status>::create(participant);
  if (!reader) return reader.error();
  return WorldWatch(std::move(reader).value(), participant.security().empty() ? 1 : 4);
}

void WorldWatch::update() {
  const auto now = Clock::now();
  if (auto taken = reader_.take_owned()) {
    for (auto& sample : taken.value()) {
      if (sample.info.state != InstanceState::alive) {
        worlds_.erase(sample.info.writer);
        continue;
      }
      const auto participant = reader_.participant_of(sample.info.writer);
      if (!sample.info.valid || !participant) continue;
      const auto owned = std::make_shared<const Owned<flexcast_Status>>(std::move(sample.data));
      worlds_.insert_or_assign(sample.info.writer, World{{owned, &**owned}, *participant, now});
    }
  }
  std::erase_if(worlds_, [&](const auto& entry) {
    return now - entry.second.heard > silence || !reader_.participant_of(entry.first);
  });
}

void WorldWatch::discover(std::chrono::nanoseconds most) {
  const auto quiet = slowness_ * 250ms;  // processes answer within milliseconds of each other
  most *= slowness_;
  const auto start = Clock::now();
  auto last_news = start;
  for (;;) {
    const std::size_t known = worlds_.size();
    update();
    const auto now = Clock::now();
    if (worlds_.size() > known) last_news = now;
    if (now - start >= most || (!worlds_.empty() && now - last_news >= quiet)) return;
    reader_.wait(std::min<std::chrono::nanoseconds>(20ms, most - (now - start)));
  }
}

bool WorldWatch::wait_for(std::string_view world, std::chrono::nanoseconds timeout) {
  const auto end = Clock::now() + timeout;
  for (;;) {
    update();
    if (world.empty() ? !worlds_.empty() : find(world) != nullptr) return true;
    const auto now = Clock::now();
    if (now >= end) return false;
    reader_.wait(std::min<std::chrono::nanoseconds>(100ms, end - now));
  }
}

std::vector<const World*> WorldWatch::worlds() const {
  std::vector<const World*> list;
  for (const auto& [writer, world] : worlds_) list.push_back(&world);
  std::sort(list.begin(), list.end(), [](const World* a, const World* b) { return world_name(*a) < world_name(*b); });
  return list;
}

const World* WorldWatch::find(std::string_view world) const {
  for (const auto& [writer, entry] : worlds_)
    if (world_name(entry) == world) return &entry;
  return nullptr;
}

}  // namespace flexcast::wire
