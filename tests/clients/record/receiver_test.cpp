// What happens when the queue to the disk is full.
#include "clients/record/receiver.h"

#include <thread>

#include "tests/clients/record/recordings.h"

namespace flexcast::record {
namespace {

using namespace std::chrono_literals;
using test::eventually;
using test::Publisher;

class FullQueue : public testing::Test {
 protected:
  void start(bool lockstep) {
    receiver = Receiver::create(participant, subscriptions, queue, "beam", {}).value();
    receiver->set_lockstep(lockstep);
    receiver->start();
    ASSERT_TRUE(eventually([&] { return server.frames().matched().current > 0; }));
    for (std::uint64_t frame = 0; frame < 50; ++frame) server.publish_frames(1000, frame, frame);
  }

  const Publisher server{"beam"};
  const wire::Participant participant = flexcast::test::join_test_domain();
  const Subscriptions subscriptions = Subscriptions::create(participant, "beam").value();
  ItemQueue queue{4000};  // some frames
  std::unique_ptr<Receiver> receiver;
};

TEST_F(FullQueue, LosesFramesThatAreNamed) {
  start(false);
  ASSERT_TRUE(eventually([&] { return receiver->progress().missing > 0; }));
  receiver->stop();
  const Reception reception = receiver->reception();
  ASSERT_EQ(reception.gaps.size(), 1u);
  EXPECT_EQ(reception.gaps[0].cause, GapCause::queue);
  EXPECT_EQ(reception.gaps[0].last, 49u);
}

TEST_F(FullQueue, LosesNothingWhereTheServerWaits) {
  start(true);
  const std::jthread disk([this](const std::stop_token& stop) {  // slow, but it goes on until the receiver has ended
    while (!stop.stop_requested()) {
      queue.pop(0ns);
      std::this_thread::sleep_for(1ms);
    }
  });
  EXPECT_TRUE(eventually([&] { return receiver->progress().frames == 50; }));
  EXPECT_EQ(receiver->progress().contiguous_end, 50u);
  receiver->stop();
  EXPECT_TRUE(receiver->reception().gaps.empty());
  EXPECT_TRUE(receiver->reception().dropped.empty());
}

TEST_F(FullQueue, DoesNotKeepAReceiverFromEndingWhereTheServerWaits) {
  start(true);
  std::this_thread::sleep_for(50ms);
  receiver->stop();
  EXPECT_TRUE(receiver->ended());
}

}  // namespace
}  // namespace flexcast::record
