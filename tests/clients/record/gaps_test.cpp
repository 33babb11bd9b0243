// Frames that are missing between a server and the file.
#include "tests/clients/record/recordings.h"

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

  const std::vector<Gap> gaps{{1000, 10, 14, GapCause::not_received},
                              {1000, 20, 20, GapCause::not_received},
                              {1001, 0, 1, GapCause::not_received}};
  EXPECT_EQ(report.reception.gaps, gaps);
  EXPECT_EQ(missing_count(report), 8u);
  EXPECT_EQ(frame_count(report), 20u);
  EXPECT_EQ(step_count(report), 210u + 30u);
  EXPECT_NEAR(simulated_seconds(report), 0.24, 1e-12);

  const auto contents = test::read(file);
  EXPECT_EQ(contents.metadata.at("flexcast.gaps"), (mcap::TextPairs{{"missing", "8"},
                                                                    {"gaps", "3"},
                                                                    {"gap.0", "1000 10 14 not received"},
                                                                    {"gap.1", "1000 20 20 not received"},
                                                                    {"gap.2", "1001 0 1 not received"}}));
  const mcap::TextPairs& recording = contents.metadata.at("flexcast.recording");
  EXPECT_EQ(recording.at("world"), "beam");
  EXPECT_EQ(recording.at("version"), FLEXCAST_VERSION);
  EXPECT_EQ(recording.at("server_version"), "9.8.7");
  EXPECT_EQ(recording.at("frames"), "20");
  EXPECT_EQ(recording.at("run.0"), "1000 0 21 16 0");
  EXPECT_EQ(recording.at("run.1"), "1001 2 5 4 0");
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
