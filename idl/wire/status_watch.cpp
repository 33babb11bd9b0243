#include "idl/wire/status_watch.h"

#include "idl/wire/fill.h"

namespace flexcast::wire {

Result<StatusWatch> StatusWatch::create(const Participant& participant) {
  auto reader = Reader<flexcast_Status>::create(participant, topic_of<flexcast_Status>().recorder);
  if (!reader) return reader.error();
  return StatusWatch(std::move(reader).value());
}

std::vector<StatusNews> StatusWatch::take() {
  std::vector<StatusNews> news;
  auto taken = reader_.take_owned();
  if (!taken) return news;
  const auto now = std::chrono::steady_clock::now();
  for (auto& sample : taken.value()) {
    StatusNews one;
    one.written = sample.info.source_time;
    one.heard = now;
    if (sample.info.valid) {
      worlds_[sample.info.instance] = text(sample.data->world);
      one.world = worlds_[sample.info.instance];
      one.participant = reader_.participant_of(sample.info.writer).value_or(Guid{});
      const auto owned = std::make_shared<const Owned<flexcast_Status>>(std::move(sample.data));
      one.status = {owned, &**owned};
      news.push_back(one);
    }
    if (sample.info.state == InstanceState::alive) continue;
    // The samples that say so may carry data still, that of before.
    const auto known = worlds_.find(sample.info.instance);
    if (known == worlds_.end()) continue;
    one.kind = sample.info.state == InstanceState::disposed ? StatusNews::Kind::goodbye : StatusNews::Kind::vanished;
    one.world = known->second;
    one.status.reset();
    news.push_back(std::move(one));
  }
  return news;
}

}  // namespace flexcast::wire
