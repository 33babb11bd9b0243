// Frames that are missing between a server and the file.
#include <map>
#include <random>
#include <set>

#include "tests/clients/record/recordings.h"
#include "tests/support/fake_server.h"

namespace flexcast::record {
namespace {

using test::Publisher;
using test::TemporaryFile;

TEST(Gaps, AreReportedExactly) {
  const Publisher server("beam");
  const TemporaryFile file;
  auto recorder = test::start(test::options_for(file));
  server.publish_frames(1000, 0, 9);
  server.publish_frames(1000, 15, 19);
  server.publish_frames(1000, 21, 21);
  server.publish_frames(1001, 2, 5);
  const Report report = test::finish(*recorder, 20);

  const std::vector<Gap> gaps{
      {1000, 10, 14, GapCause::lost}, {1000, 20, 20, GapCause::lost}, {1001, 0, 1, GapCause::lost}};
  EXPECT_EQ(report.reception.gaps, gaps);
  EXPECT_EQ(missing_count(report), 8u);
  EXPECT_EQ(frame_count(report), 20u);
  EXPECT_EQ(step_count(report), 210u + 30u);
  EXPECT_NEAR(simulated_seconds(report), 0.24, 1e-12);

  const auto contents = test::read(file);
  EXPECT_EQ(contents.metadata.at("flexcast.gaps"), (mcap::TextPairs{{"missing", "8"},
                                                                    {"gaps", "3"},
                                                                    {"gap.0", "1000 10 14 lost"},
                                                                    {"gap.1", "1000 20 20 lost"},
                                                                    {"gap.2", "1001 0 1 lost"},
                                                                    {"paused", "0"}}));
  const mcap::TextPairs& recording = contents.metadata.at("flexcast.recording");
  EXPECT_EQ(recording.at("world"), "beam");
  EXPECT_EQ(recording.at("version"), FLEXCAST_VERSION);
  EXPECT_EQ(recording.at("server_version"), "9.8.7");
  EXPECT_EQ(recording.at("frames"), "20");
  EXPECT_EQ(recording.at("run.0"), "1000 0 21 16 0");
  EXPECT_EQ(recording.at("run.1"), "1001 2 5 4 0");
}

// Of the frames 0 to 199 of a run; of `half` the last chunk is missing.
struct Losses {
  std::set<std::uint64_t> unpublished, lost, half;
};

Losses random_losses(std::mt19937& random) {
  Losses losses;
  for (std::uint64_t frame = 1; frame < 199; ++frame) {
    const auto dice = random() % 12;
    if (dice < 2) losses.unpublished.insert(frame);
    if (dice == 2) losses.lost.insert(frame);
    if (dice == 3) losses.half.insert(frame);
  }
  return losses;
}

void publish(flexcast::test::FakeServer& server, std::uint64_t run_id, const Losses& losses) {
  std::vector<std::uint64_t> ranges;
  for (const std::uint64_t frame : losses.unpublished) ranges.insert(ranges.end(), {frame, frame});
  for (std::uint64_t frame = 0; frame < 200; ++frame) {
    // No faster than a server: the writer keeps 64 samples of each chunk for a reader that lags.
    if (frame % 10 == 0) std::this_thread::sleep_for(std::chrono::milliseconds(10));
    if (losses.unpublished.contains(frame) || losses.lost.contains(frame)) continue;
    server.publish(run_id, frame, 3, losses.half.contains(frame) ? 2 : 3);
  }
  server.say_unpublished(run_id, ranges);
}

std::map<std::uint64_t, GapCause> causes_of(const Losses& losses) {
  std::map<std::uint64_t, GapCause> causes;
  for (const std::uint64_t frame : losses.unpublished) causes[frame] = GapCause::unpublished;
  for (const std::uint64_t frame : losses.lost) causes[frame] = GapCause::lost;
  for (const std::uint64_t frame : losses.half) causes[frame] = GapCause::incomplete;
  return causes;
}

TEST(Gaps, AreExactlyTheFramesThatAServerLeftOutWithTheirCauses) {
  flexcast::test::FakeServer server("beam");
  const TemporaryFile file;
  auto recorder = test::start(test::options_for(file));
  std::mt19937 random(11);
  std::map<std::uint64_t, Losses> runs;
  std::uint64_t whole = 0;
  for (const std::uint64_t run_id : {1000, 1001, 1002}) {
    const Losses& losses = runs[run_id] = random_losses(random);
    publish(server, run_id, losses);
    whole += 200 - causes_of(losses).size();
    ASSERT_TRUE(test::eventually([&] { return recorder->progress().frames == whole; }));
  }
  const Report report = test::finish(*recorder, whole);
  std::map<std::uint64_t, std::map<std::uint64_t, GapCause>> found;
  for (const Gap& gap : report.reception.gaps) {
    for (std::uint64_t frame = gap.first; frame <= gap.last; ++frame) found[gap.run_id][frame] = gap.cause;
  }
  for (const auto& [run_id, losses] : runs) EXPECT_EQ(found[run_id], causes_of(losses)) << run_id;
  EXPECT_EQ(test::read(file).metadata.at("flexcast.gaps").at("missing"), std::to_string(600 - whole));
}

TEST(Gaps, WaitForOneMoreStatusBeforeAFrameIsSaidToBeLost) {
  flexcast::test::FakeServer server("beam");
  const TemporaryFile file;
  auto recorder = test::start(test::options_for(file));
  server.quiet = true;
  for (const std::uint64_t frame : {0, 1, 2, 5}) server.publish(1000, frame);
  ASSERT_TRUE(test::eventually([&] { return recorder->progress().frames == 4; }));
  std::jthread late([&] {
    std::this_thread::sleep_for(std::chrono::milliseconds(100));
    server.say_unpublished(1000, {3, 4});
    server.quiet = false;
  });
  const Report report = test::finish(*recorder, 4);
  EXPECT_EQ(report.reception.gaps, (std::vector<Gap>{{1000, 3, 4, GapCause::unpublished}}));
}

TEST(Gaps, ThereAreNoneWhenTheNewestFrameIsSentAgain) {
  const Publisher server("beam");
  const TemporaryFile file;
  auto recorder = test::start(test::options_for(file));
  server.publish_frames(1000, 0, 3);
  for (int i = 0; i < 3; ++i) server.publish_frames(1000, 3, 3);
  server.publish_frames(1000, 4, 5);
  const Report report = test::finish(*recorder, 6);
  EXPECT_EQ(frame_count(report), 6u);
  EXPECT_EQ(missing_count(report), 0u);
  EXPECT_EQ(test::sequences_of(test::read(file), "flexcast/frames"), (std::vector<std::uint32_t>{0, 1, 2, 3, 4, 5}));
}

TEST(Gaps, ChunkedFramesComeInTheOrderOfTheirNumbersAndOneWithoutAllChunksIsMissing) {
  const Publisher server("beam");
  const TemporaryFile file;
  auto recorder = test::start(test::options_for(file));
  server.publish_frames(1000, 0, 29, 3);
  server.publish_chunk(1000, 30, 0, 3);
  server.publish_chunk(1000, 30, 2, 3);
  server.publish_frames(1000, 31, 59, 3);
  const Report report = test::finish(*recorder, 59);
  EXPECT_EQ(report.reception.gaps, (std::vector<Gap>{{1000, 30, 30, GapCause::incomplete}}));
  const auto sequences = test::sequences_of(test::read(file), "flexcast/frames");
  EXPECT_EQ(sequences.size(), 60u * 3 - 1);
  EXPECT_TRUE(std::is_sorted(sequences.begin(), sequences.end()));
}

TEST(Gaps, AServerThatIsStartedAgainIsRecordedOn) {
  auto server = std::make_unique<Publisher>("beam");
  const TemporaryFile file;
  auto recorder = test::start(test::options_for(file));
  server->publish_frames(1000, 0, 4);
  ASSERT_TRUE(test::eventually([&] { return recorder->progress().frames == 5; }));
  server.reset();
  server = std::make_unique<Publisher>("beam", "again = true\n");
  ASSERT_TRUE(test::eventually([&] { return server->frames().matched().current > 0; }));
  server->publish_frames(2000, 3, 7);
  const Report report = test::finish(*recorder, 10);
  ASSERT_EQ(report.reception.runs.size(), 2u);
  EXPECT_EQ(report.reception.runs[0].last_frame, 4u);
  EXPECT_EQ(report.reception.runs[1].run_id, 2000u);
  EXPECT_EQ(report.reception.runs[1].joined_at, 3u);
  EXPECT_EQ(missing_count(report), 0u);
  EXPECT_EQ(test::messages_of(test::read(file), "flexcast/scene").size(), 2u);
}

}  // namespace
}  // namespace flexcast::record
