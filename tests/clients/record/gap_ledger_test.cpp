#include "clients/record/gap_ledger.h"

#include <gtest/gtest.h>

#include <array>

namespace flexcast::record {
namespace {

constexpr std::uint64_t server = 1;  // a writer
constexpr std::uint64_t run = 1000;

wire::FrameHead head_of(std::uint64_t frame, std::uint32_t chunk = 0, std::uint32_t chunks = 1,
                        std::uint64_t run_id = run) {
  wire::FrameHead head;
  head.run_id = run_id;
  head.frame = frame;
  head.step = 10 * frame;
  head.time = 0.5 * static_cast<double>(frame);
  head.chunk = chunk;
  head.chunks = chunks;
  return head;
}

// What the receiver does with a sample.
Verdict offer(GapLedger& ledger, const wire::FrameHead& head, std::uint64_t writer = server) {
  const Verdict verdict = ledger.judge(head);
  if (verdict == Verdict::record) ledger.add(head, writer);
  return verdict;
}

void offer_frames(GapLedger& ledger, std::uint64_t first, std::uint64_t last, std::uint64_t run_id = run,
                  std::uint64_t writer = server) {
  for (std::uint64_t frame = first; frame <= last; ++frame) offer(ledger, head_of(frame, 0, 1, run_id), writer);
}

TEST(GapLedger, HasNothingMissingOfContiguousFrames) {
  GapLedger ledger;
  EXPECT_EQ(ledger.missing(), 0u);
  offer_frames(ledger, 0, 99);
  EXPECT_EQ(ledger.frames(), 100u);
  EXPECT_EQ(ledger.missing(), 0u);
  EXPECT_EQ(ledger.next_frame(), 100u);
  EXPECT_TRUE(ledger.gaps().empty());
  ASSERT_EQ(ledger.runs().size(), 1u);
  const RunSummary summary = ledger.runs()[0];
  EXPECT_EQ(summary.run_id, run);
  EXPECT_EQ(summary.joined_at, 0u);
  EXPECT_EQ(summary.first_frame, 0u);
  EXPECT_EQ(summary.last_frame, 99u);
  EXPECT_EQ(summary.frames, 100u);
  EXPECT_EQ(summary.steps, 990u);
  EXPECT_EQ(summary.seconds, 49.5);
}

TEST(GapLedger, NamesEveryGapInTheMiddle) {
  GapLedger ledger;
  offer_frames(ledger, 0, 4);
  offer_frames(ledger, 8, 10);
  offer_frames(ledger, 12, 12);
  EXPECT_EQ(ledger.missing(), 4u);
  EXPECT_EQ(ledger.gaps(), (std::vector<Gap>{{run, 5, 7, GapCause::lost}, {run, 11, 11, GapCause::lost}}));
}

TEST(GapLedger, CountsARunThatWasJoinedLateFromWhereItWasJoined) {
  GapLedger ledger;
  offer_frames(ledger, 37, 40);
  EXPECT_EQ(ledger.missing(), 0u);
  EXPECT_TRUE(ledger.gaps().empty());
  EXPECT_EQ(ledger.runs()[0].joined_at, 37u);
}

TEST(GapLedger, ExpectsALaterRunOfTheSameServerFromItsFirstFrameOn) {
  GapLedger ledger;
  offer_frames(ledger, 5, 9);
  offer_frames(ledger, 2, 4, run + 1);
  offer_frames(ledger, 0, 1, run + 2);
  EXPECT_EQ(ledger.gaps(), (std::vector<Gap>{{run + 1, 0, 1, GapCause::lost}}));
  EXPECT_EQ(ledger.missing(), 2u);
  EXPECT_EQ(ledger.runs()[1].joined_at, 0u);
  EXPECT_EQ(ledger.runs()[1].first_frame, 2u);
  EXPECT_EQ(ledger.run_id(), run + 2);
  EXPECT_EQ(ledger.next_frame(), 2u);
}

TEST(GapLedger, JoinsTheFirstRunOfAServerThatWasStartedAgain) {
  GapLedger ledger;
  offer_frames(ledger, 0, 9, run, server);
  offer_frames(ledger, 3, 5, run + 1, server + 1);
  offer_frames(ledger, 1, 2, run + 2, server + 1);
  EXPECT_EQ(ledger.runs()[1].joined_at, 3u);
  EXPECT_EQ(ledger.gaps(), (std::vector<Gap>{{run + 2, 0, 0, GapCause::lost}}));
}

TEST(GapLedger, DropsAFrameThatIsNotNewerThanTheLast) {
  GapLedger ledger;
  offer_frames(ledger, 0, 5);
  EXPECT_EQ(offer(ledger, head_of(5)), Verdict::repeated);
  EXPECT_EQ(offer(ledger, head_of(2)), Verdict::repeated);
  EXPECT_EQ(offer(ledger, head_of(6)), Verdict::record);
  EXPECT_EQ(ledger.frames(), 7u);
  EXPECT_EQ(ledger.missing(), 0u);
}

TEST(GapLedger, KnowsRepeatedFramesOfAnEarlierRun) {
  GapLedger ledger;
  offer_frames(ledger, 0, 5);
  offer_frames(ledger, 0, 1, run + 1);
  EXPECT_EQ(offer(ledger, head_of(5)), Verdict::repeated);
  EXPECT_EQ(ledger.missing(), 0u);
}

TEST(GapLedger, CountsAFrameWithAMissingChunkAsMissing) {
  GapLedger ledger;
  for (std::uint64_t frame = 0; frame < 5; ++frame) {
    for (std::uint32_t chunk = 0; chunk < 3; ++chunk) {
      if (frame != 2 || chunk != 1) offer(ledger, head_of(frame, chunk, 3));
    }
  }
  EXPECT_EQ(ledger.frames(), 4u);
  EXPECT_EQ(ledger.missing(), 1u);
  EXPECT_EQ(ledger.gaps(), (std::vector<Gap>{{run, 2, 2, GapCause::incomplete}}));
}

TEST(GapLedger, CompletesFramesWhoseChunksComeChunkNumberByChunkNumber) {
  GapLedger ledger;
  for (std::uint32_t chunk = 0; chunk < 3; ++chunk) {
    for (std::uint64_t frame = 0; frame < 50; ++frame) {
      EXPECT_EQ(offer(ledger, head_of(frame, chunk, 3)), Verdict::record);
    }
  }
  EXPECT_EQ(ledger.frames(), 50u);
  EXPECT_EQ(ledger.missing(), 0u);
  EXPECT_TRUE(ledger.gaps().empty());
}

TEST(GapLedger, DoesNotCountAFrameInProgressAsMissingWhileItMayBecomeComplete) {
  GapLedger ledger;
  offer(ledger, head_of(0, 0, 2));
  EXPECT_EQ(ledger.in_progress(), 1u);
  EXPECT_EQ(ledger.missing(), 0u);
  EXPECT_EQ(ledger.gaps(), (std::vector<Gap>{{run, 0, 0, GapCause::incomplete}}));
  offer(ledger, head_of(0, 1, 2));
  EXPECT_EQ(ledger.in_progress(), 0u);
  EXPECT_TRUE(ledger.gaps().empty());
}

TEST(GapLedger, JoinsAfterAFrameOfWhichItSawTheEndOnly) {
  GapLedger ledger;
  offer(ledger, head_of(7, 1, 2));
  offer(ledger, head_of(8, 0, 2));
  offer(ledger, head_of(8, 1, 2));
  EXPECT_EQ(ledger.runs()[0].joined_at, 8u);
  EXPECT_TRUE(ledger.gaps().empty());
  EXPECT_EQ(ledger.missing(), 0u);
}

TEST(GapLedger, NamesTheQueueAsTheCauseOfWhatItDropped) {
  GapLedger ledger;
  offer_frames(ledger, 0, 2);
  for (std::uint64_t frame = 3; frame <= 5; ++frame) ledger.drop(head_of(frame), server);
  offer_frames(ledger, 8, 8);
  ledger.drop(head_of(9), server);
  EXPECT_EQ(
      ledger.gaps(),
      (std::vector<Gap>{{run, 3, 5, GapCause::queue}, {run, 6, 7, GapCause::lost}, {run, 9, 9, GapCause::queue}}));
  EXPECT_EQ(ledger.missing(), 6u);
}

TEST(GapLedger, TellsWhatTheServerDidNotPublishFromWhatWasLost) {
  GapLedger ledger;
  offer_frames(ledger, 0, 4);
  offer_frames(ledger, 10, 10);
  ledger.note_unpublished(run, std::array<std::uint64_t, 4>{3, 6, 9, 9});
  EXPECT_EQ(ledger.gaps(),
            (std::vector<Gap>{
                {run, 5, 6, GapCause::unpublished}, {run, 7, 8, GapCause::lost}, {run, 9, 9, GapCause::unpublished}}));
  EXPECT_TRUE(ledger.has_lost());
  ledger.note_unpublished(run, std::array<std::uint64_t, 2>{7, 8});
  EXPECT_EQ(ledger.gaps(), (std::vector<Gap>{{run, 5, 9, GapCause::unpublished}}));
  EXPECT_FALSE(ledger.has_lost());
}

TEST(GapLedger, RemembersWhatAStatusSaysBeforeTheFirstFrameOfItsRun) {
  GapLedger ledger;
  offer_frames(ledger, 0, 1, run - 1);
  ledger.note_unpublished(run, std::array<std::uint64_t, 2>{0, 2});
  offer_frames(ledger, 4, 4);
  EXPECT_EQ(ledger.gaps(), (std::vector<Gap>{{run, 0, 2, GapCause::unpublished}, {run, 3, 3, GapCause::lost}}));
}

TEST(GapLedger, PassesOverRangesOfAStatusThatMakeNoSense) {
  GapLedger ledger;
  offer_frames(ledger, 0, 0);
  offer_frames(ledger, 3, 3);
  ledger.note_unpublished(run, std::array<std::uint64_t, 3>{2, 1, 1});
  EXPECT_EQ(ledger.gaps(), (std::vector<Gap>{{run, 1, 2, GapCause::lost}}));
}

TEST(GapLedger, KeepsWhatCameWhilePausedApartFromGaps) {
  GapLedger ledger;
  offer_frames(ledger, 0, 4);
  ledger.pause();
  for (const std::uint64_t frame : {6, 7, 9}) {
    ASSERT_EQ(ledger.judge(head_of(frame)), Verdict::paused);
    ledger.skip(head_of(frame), server);
  }
  ledger.resume();
  EXPECT_EQ(ledger.judge(head_of(9)), Verdict::paused) << "it is sent again for late joiners";
  offer_frames(ledger, 11, 12);
  EXPECT_EQ(ledger.pauses(), (std::vector<Pause>{{run, 6, 9}})) << "8 was lost while paused: nobody wanted it";
  EXPECT_EQ(ledger.gaps(), (std::vector<Gap>{{run, 5, 5, GapCause::lost}, {run, 10, 10, GapCause::lost}}));
  EXPECT_EQ(ledger.missing(), 2u);
  EXPECT_EQ(ledger.frames(), 7u);
}

TEST(GapLedger, CompletesAFrameThatHadBegunBeforeThePause) {
  GapLedger ledger;
  offer(ledger, head_of(0, 0, 2));
  ledger.pause();
  EXPECT_EQ(offer(ledger, head_of(0, 1, 2)), Verdict::record);
  EXPECT_EQ(offer(ledger, head_of(1, 0, 2)), Verdict::paused);
  EXPECT_EQ(ledger.frames(), 1u);
}

TEST(GapLedger, CountsARunThatBeganWhilePausedAsPausedThere) {
  GapLedger ledger;
  offer_frames(ledger, 0, 1);
  ledger.pause();
  for (std::uint64_t frame = 0; frame < 5; ++frame) ledger.skip(head_of(frame, 0, 1, run + 1), server);
  ledger.resume();
  offer_frames(ledger, 5, 6, run + 1);
  EXPECT_EQ(ledger.pauses(), (std::vector<Pause>{{run + 1, 0, 4}}));
  EXPECT_TRUE(ledger.gaps().empty());
  EXPECT_EQ(ledger.missing(), 0u);
}

TEST(GapLedger, NamesTheDiskAsTheCauseOfWhatTheFileCouldNotTake) {
  GapLedger ledger;
  for (std::uint64_t frame = 0; frame < 6; ++frame) {
    for (std::uint32_t chunk = 0; chunk < 2; ++chunk) offer(ledger, head_of(frame, chunk, 2));
  }
  ledger.lose(head_of(5, 1, 2));
  ledger.lose(head_of(5, 0, 2));
  ledger.lose(head_of(4, 1, 2));
  EXPECT_EQ(ledger.frames(), 4u);
  EXPECT_EQ(ledger.missing(), 2u);
  EXPECT_EQ(ledger.gaps(), (std::vector<Gap>{{run, 4, 5, GapCause::disk}}));
}

TEST(GapLedger, IsContiguousUpToTheFirstFrameOfWhichNobodyKnows) {
  GapLedger ledger;
  EXPECT_EQ(ledger.contiguous_end(), 0u);
  offer_frames(ledger, 3, 5);
  EXPECT_EQ(ledger.contiguous_end(), 6u);
  offer_frames(ledger, 8, 9);
  EXPECT_EQ(ledger.contiguous_end(), 6u);
  ledger.note_unpublished(run, std::array<std::uint64_t, 2>{6, 7});
  EXPECT_EQ(ledger.contiguous_end(), 10u);
  EXPECT_EQ(ledger.next_frame(), 10u);
}

TEST(GapLedger, TakesADroppedFrameThatIsSentAgain) {
  GapLedger ledger;
  offer_frames(ledger, 0, 2);
  ledger.drop(head_of(3), server);
  EXPECT_EQ(offer(ledger, head_of(3)), Verdict::record);
  EXPECT_EQ(ledger.frames(), 4u);
  EXPECT_TRUE(ledger.gaps().empty());
}

TEST(GapLedger, CountsNoStepsBackwardWhenACheckpointFromBeforeTheRecordingIsRestored) {
  GapLedger ledger;
  offer_frames(ledger, 50, 60);
  wire::FrameHead restored = head_of(61);
  restored.step = 100;
  restored.time = 5.0;
  offer(ledger, restored);
  const RunSummary summary = ledger.runs().at(0);
  EXPECT_EQ(summary.frames, 12u);
  EXPECT_EQ(summary.steps, 0u);
  EXPECT_EQ(summary.seconds, 0.0);
  EXPECT_EQ(ledger.missing(), 0u);
}

TEST(GapLedger, TakesNoMoreThanTheFramesItWasAskedFor) {
  GapLedger ledger(3);
  offer_frames(ledger, 4, 5);
  EXPECT_FALSE(ledger.is_full());
  EXPECT_EQ(offer(ledger, head_of(6)), Verdict::record);
  EXPECT_TRUE(ledger.is_full());
  EXPECT_EQ(offer(ledger, head_of(7)), Verdict::beyond);
  EXPECT_EQ(ledger.frames(), 3u);
}

TEST(GapLedger, StartsNoFrameBeyondThoseItWasAskedFor) {
  GapLedger ledger(2);
  EXPECT_EQ(offer(ledger, head_of(0, 0, 2)), Verdict::record);
  EXPECT_EQ(offer(ledger, head_of(1, 0, 2)), Verdict::record);
  EXPECT_EQ(offer(ledger, head_of(2, 0, 2)), Verdict::beyond);
  EXPECT_EQ(offer(ledger, head_of(0, 1, 2)), Verdict::record);
  EXPECT_EQ(offer(ledger, head_of(1, 1, 2)), Verdict::record);
  EXPECT_TRUE(ledger.is_full());
  EXPECT_TRUE(ledger.gaps().empty());
}

TEST(GapLedger, DoesNotWaitForAFrameThatCanNoLongerBecomeComplete) {
  GapLedger ledger(1);
  EXPECT_EQ(offer(ledger, head_of(0, 0, 2)), Verdict::record);
  EXPECT_EQ(offer(ledger, head_of(1, 0, 2)), Verdict::beyond) << "frame 0 may be the one that was asked for";
  ledger.pass(head_of(1, 0, 2));
  EXPECT_EQ(offer(ledger, head_of(1, 1, 2)), Verdict::beyond);
  ledger.pass(head_of(1, 1, 2));
  EXPECT_EQ(ledger.in_progress(), 0u) << "the second chunk of frame 0 was lost";
  EXPECT_EQ(offer(ledger, head_of(2, 0, 2)), Verdict::record);
  EXPECT_EQ(offer(ledger, head_of(2, 1, 2)), Verdict::record);
  EXPECT_TRUE(ledger.is_full());
}

TEST(GapLedger, LetsFramesInProgressBecomeCompleteAfterTheEnd) {
  GapLedger ledger;
  offer(ledger, head_of(0, 0, 2));
  ledger.close();
  EXPECT_EQ(offer(ledger, head_of(1, 0, 2)), Verdict::beyond);
  EXPECT_EQ(offer(ledger, head_of(0, 1, 2)), Verdict::record);
  EXPECT_EQ(ledger.frames(), 1u);
}

TEST(GapLedger, RefusesChunkNumbersThatMakeNoSense) {
  GapLedger ledger;
  EXPECT_EQ(offer(ledger, head_of(0, 0, 0)), Verdict::invalid);
  EXPECT_EQ(offer(ledger, head_of(0, 2, 2)), Verdict::invalid);
  EXPECT_EQ(offer(ledger, head_of(0, 0, 0xffffffff)), Verdict::invalid);
  EXPECT_TRUE(ledger.runs().empty());
}

TEST(GapLedger, SurvivesTheLargestFrameNumber) {
  GapLedger ledger;
  constexpr std::uint64_t largest = GapLedger::no_limit;
  offer_frames(ledger, 0, 0);
  offer(ledger, head_of(largest));
  EXPECT_EQ(ledger.gaps(), (std::vector<Gap>{{run, 1, largest - 1, GapCause::lost}}));
}

}  // namespace
}  // namespace flexcast::record
