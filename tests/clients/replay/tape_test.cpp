#include "clients/replay/tape.h"

#include <gtest/gtest.h>

#include "tests/support/recording_maker.h"

namespace flexcast::replay {
namespace {

using flexcast::test::RecordingMaker;
using wire::TopicId;

class TapeTest : public testing::Test {
 protected:
  Tape make_tape(std::optional<double> from = {}, std::optional<double> to = {}) {
    auto recording = recording::Recording::open(path_).value();
    auto index = recording::Index::make(recording, {}).value();
    auto clips = make_clips(index, from, to);
    return Tape(std::move(recording), std::move(index), std::move(clips));
  }

  // Two runs; each message has its place in the file as sequence.
  void make_recording() {
    RecordingMaker maker(path_, 800);
    maker.add_run(100, 6);  // 0 scene, 1 2 topology, 3 parameters, 4 event, 5 to 10 frames
    maker.add_run(200, 2);  // 11 to 15, 16 17 frames
    maker.add_event(200, 1);
    maker.close();
  }

  std::vector<std::uint32_t> play(Tape& tape) {
    std::vector<std::uint32_t> sequences;
    tape.play([&](const recording::RecordedMessage& message) { sequences.push_back(message.sequence); });
    return sequences;
  }

  const flexcast::test::TemporaryFolder folder_;
  const std::string path_ = folder_.path("run.mcap");
};

using Sequences = std::vector<std::uint32_t>;

TEST_F(TapeTest, PlaysEveryMessageOnceInTheOrderOfTheFile) {
  make_recording();
  Tape tape = make_tape();
  EXPECT_TRUE(tape.is_from_start());
  Sequences all;
  while (!tape.at_end()) {
    const Sequences played = play(tape);
    all.insert(all.end(), played.begin(), played.end());
  }
  tape.play_rest([&](const recording::RecordedMessage& message) { all.push_back(message.sequence); });
  Sequences expected;
  for (std::uint32_t i = 0; i < 19; ++i) expected.push_back(i);
  EXPECT_EQ(all, expected);
}

TEST_F(TapeTest, ChunksOfAFrameComeTogether) {
  RecordingMaker maker(path_);
  maker.add_run(100, 2, 2);
  maker.close();
  Tape tape = make_tape();
  EXPECT_EQ(play(tape), (Sequences{0, 1, 2, 3, 4, 5, 6}));
  EXPECT_EQ(play(tape), (Sequences{7, 8}));
  EXPECT_TRUE(tape.at_end());
}

TEST_F(TapeTest, AJumpPlaysWhatIsInForceFirst) {
  make_recording();
  Tape tape = make_tape();
  play(tape);
  tape.go_to(0, 3);
  EXPECT_EQ(play(tape), (Sequences{0, 1, 2, 3, 8}));
  EXPECT_EQ(play(tape), (Sequences{9}));
  tape.go_to(1, 6);  // the start of a run: with what belongs to it and came before its first frame
  EXPECT_EQ(play(tape), (Sequences{11, 12, 13, 14, 11, 12, 13, 14, 15, 16}));
}

TEST_F(TapeTest, ClipsLeaveOutWhatLiesBetweenThem) {
  make_recording();
  Tape tape = make_tape({}, 0.1);
  EXPECT_TRUE(tape.is_from_start());
  EXPECT_EQ(play(tape).back(), 5U);
  EXPECT_EQ(play(tape), (Sequences{6}));
  ASSERT_FALSE(tape.at_end());
  EXPECT_TRUE(tape.begins_clip());
  EXPECT_EQ(play(tape).back(), 16U);
  EXPECT_EQ(tape.played_clip(), 1U);
  Tape later = make_tape(0.2, 0.3);
  EXPECT_FALSE(later.is_from_start());
  EXPECT_EQ(play(later), (Sequences{0, 1, 2, 3, 7}));
  EXPECT_EQ(play(later), (Sequences{8}));
  EXPECT_TRUE(later.at_end());
  later.play_rest([](const recording::RecordedMessage&) { FAIL() << "the clip ends before the rest"; });
}

TEST_F(TapeTest, TheLastFrameCanBePlayedAgainWithoutLosingThePlace) {
  make_recording();
  Tape tape = make_tape();
  play(tape);
  play(tape);
  Sequences again;
  tape.play_last_again([&](const recording::RecordedMessage& message) { again.push_back(message.sequence); });
  EXPECT_EQ(again, (Sequences{6}));
  EXPECT_EQ(play(tape), (Sequences{7}));
}

}  // namespace
}  // namespace flexcast::replay
