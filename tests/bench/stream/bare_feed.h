// BareFeed: writes samples that are ready to be sent, in as many chunks as the server's: what Cyclone DDS alone costs.
#pragma once

#include <cstdint>
#include <vector>

#include "idl/wire/owned.h"
#include "idl/wire/writer.h"

namespace flexcast::bench {

class BareFeed {
 public:
  BareFeed(const wire::Participant& participant, std::int64_t particles);

  // A frame, whose time is now, by monotonic_seconds().
  void push();

 private:
  wire::Writer<flexcast_ParticleFrame> writer_;
  wire::Owned<flexcast_ParticleFrame> frame_;
  std::vector<float> positions_;
};

}  // namespace flexcast::bench
