// FrameFeed: publishes frames of one state through the server's mailbox and publisher, without a simulation.
#pragma once

#include <cstdint>
#include <memory>

#include "server/publisher.h"
#include "server/queue.h"

namespace flexcast::bench {

class FrameFeed {
 public:
  // Ends the bench when it cannot join the domain.
  FrameFeed(const wire::Participant& participant, std::int64_t particles);
  ~FrameFeed();

  // Hands a frame over as the simulation thread does; waits for room. Its time is when it came, by monotonic_seconds().
  void push();
  // Hands frames over as fast as they go.
  void push_for(double seconds);

 private:
  server::FrameMailbox mailbox_;
  State state_;
  server::FrameHeader header_;
  server::Queue<int> room_;
  server::Publications publications_;
  server::Publisher publisher_;
};

// A participant of the domain, and the server's writers of the world "ours"; both end the bench when they cannot be
// had.
wire::Participant join(int domain);
server::Publications make_publications(const wire::Participant& participant, std::int64_t particles);

}  // namespace flexcast::bench
