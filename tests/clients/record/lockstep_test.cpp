// A server that waits for its recorders has a reader of what they say.
#include "idl/wire/reader.h"
#include "tests/clients/record/recordings.h"

namespace flexcast::record {
namespace {

using test::eventually;
using test::TemporaryFile;

// What recorders have said, in order.
class Infos {
 public:
  explicit Infos(const wire::Participant& participant)
      : reader_(
            wire::Reader<flexcast_RecorderInfo>::create(participant, wire::topic_of<flexcast_RecorderInfo>().recorder)
                .value()) {}

  bool await_next_frame(std::uint64_t run_id, std::uint64_t frame) {
    return eventually([&] {
      const auto samples = reader_.take();
      for (const auto [info, sample] : samples.value()) {
        lockstep_ = info.lockstep;
        run_id_ = info.run_id;
        next_frame_ = info.next_frame;
      }
      return lockstep_ && run_id_ == run_id && next_frame_ == frame;
    });
  }

  bool lockstep() const { return lockstep_; }
  std::uint64_t next_frame() const { return next_frame_; }

 private:
  wire::Reader<flexcast_RecorderInfo> reader_;
  bool lockstep_ = false;
  std::uint64_t run_id_ = 0, next_frame_ = 0;
};

TEST(Lockstep, IsAnnouncedAtOnceAndThenAfterEveryFrameWithoutAnybodyTending) {
  const test::Publisher server("beam");
  Infos infos(server.participant());
  const TemporaryFile file;
  auto recorder = test::start(test::options_for(file));
  EXPECT_TRUE(infos.await_next_frame(0, 0));
  for (std::uint64_t frame = 0; frame < 50; ++frame) {
    server.publish_frames(1000, frame, frame, 2);
    ASSERT_TRUE(infos.await_next_frame(1000, frame + 1)) << frame << ": " << infos.next_frame();
  }
  server.publish_frames(1001, 0, 0);
  EXPECT_TRUE(infos.await_next_frame(1001, 1));
  EXPECT_EQ(missing_count(test::finish(*recorder, 51)), 0u);
}

TEST(Lockstep, AnnouncesWhatIsContiguous) {
  const test::Publisher server("beam");
  Infos infos(server.participant());
  const TemporaryFile file;
  auto recorder = test::start(test::options_for(file));
  server.publish_frames(1000, 0, 4);
  server.publish_frames(1000, 6, 9);
  ASSERT_TRUE(eventually([&] { return recorder->progress().frames == 9; }));
  EXPECT_TRUE(infos.await_next_frame(1000, 5));
  test::finish(*recorder, 9);
}

// Frame 5 is lost, as the status does not say that it was not published: the world may not stand still for ever.
TEST(Lockstep, GivesAFrameUpThatGotLostAndCountsItAsLost) {
  const test::Publisher server("beam");
  Infos infos(server.participant());
  const TemporaryFile file;
  auto recorder = test::start(test::options_for(file));
  server.publish_frames(1000, 0, 4, 2);
  server.publish_chunk(1000, 5, 0, 2);
  server.publish_frames(1000, 6, 7, 2);
  server.publish_frames(1000, 9, 9, 2);
  ASSERT_TRUE(eventually([&] { return recorder->progress().frames == 8; }));
  EXPECT_TRUE(infos.await_next_frame(1000, 5));
  EXPECT_TRUE(infos.await_next_frame(1000, 10)) << infos.next_frame();
  server.publish_frames(1000, 10, 12, 2);
  EXPECT_TRUE(infos.await_next_frame(1000, 13)) << infos.next_frame();
  server.publish_frames(1000, 14, 14, 2);  // the next hole has its own time
  EXPECT_TRUE(infos.await_next_frame(1000, 15)) << infos.next_frame();
  EXPECT_EQ(test::finish(*recorder, 12).reception.gaps,
            (std::vector<Gap>{
                {1000, 5, 5, GapCause::incomplete}, {1000, 8, 8, GapCause::lost}, {1000, 13, 13, GapCause::lost}}));
}

TEST(Lockstep, AFrameThatWasGivenUpMayStillBeSaidNotToHaveBeenPublished) {
  GapLedger ledger;
  for (const std::uint64_t frame : {0, 1, 4}) {
    wire::FrameHead head;
    head.run_id = 1000;
    head.frame = frame;
    head.chunks = 1;
    ledger.add(head, 1);
  }
  EXPECT_TRUE(ledger.has_hole());
  EXPECT_EQ(ledger.contiguous_end(), 2u);
  ledger.give_up_holes();
  EXPECT_FALSE(ledger.has_hole());
  EXPECT_EQ(ledger.contiguous_end(), 5u);
  EXPECT_EQ(ledger.gaps(), (std::vector<Gap>{{1000, 2, 3, GapCause::lost}}));
  const std::uint64_t range[] = {2, 3};
  ledger.note_unpublished(1000, range);
  EXPECT_EQ(ledger.gaps(), (std::vector<Gap>{{1000, 2, 3, GapCause::unpublished}}));
}

TEST(Lockstep, IsNoneWhereSomebodyElseReadsTheAnnouncements) {
  const test::Publisher server("beam");
  const auto other = flexcast::test::join_test_domain();
  Infos infos(other);
  const TemporaryFile file;
  auto recorder = test::start(test::options_for(file));
  server.publish_frames(1000, 0, 4);
  ASSERT_TRUE(eventually([&] { return recorder->progress().frames == 5; }));
  recorder->tend();
  test::finish(*recorder, 5);
  EXPECT_FALSE(infos.lockstep());
}

}  // namespace
}  // namespace flexcast::record
