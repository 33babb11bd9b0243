#include "clients/record/report.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace flexcast::record {
namespace {

Report sample() {
  Report report{.file = "run.mcap", .world = "beam", .domain = 3, .profile = "lan", .reception = {}};
  report.reception.runs = {
      {.run_id = 11, .joined_at = 4, .first_frame = 4, .last_frame = 9, .frames = 5, .steps = 50, .seconds = 0.5},
      {.run_id = 12, .first_frame = 0, .last_frame = 0, .frames = 1}};
  report.reception.gaps = {{11, 6, 6, GapCause::queue}, {11, 10, 12, GapCause::incomplete}};
  report.reception.dropped[wire::TopicId::frames] = 2;
  report.reception.seconds = 1.25;
  report.messages = 42;
  report.bytes = 1'500'000;
  return report;
}

TEST(Report, IsOneJsonObjectForPrograms) {
  EXPECT_EQ(to_json(sample()),
            R"({"file":"run.mcap","world":"beam","frames":6,"gaps":4,"missing":[)"
            R"({"run_id":11,"first":6,"last":6,"cause":"queue"},)"
            R"({"run_id":11,"first":10,"last":12,"cause":"incomplete"}],"causes":{"incomplete":3,"queue":1},)"
            R"("paused":[],"paused_frames":0,"runs":[)"
            R"({"run_id":11,"first_frame":4,"last_frame":9,"frames":5,"joined_at":4},)"
            R"({"run_id":12,"first_frame":0,"last_frame":0,"frames":1,"joined_at":0}],)"
            R"("bytes":1500000,"seconds":1.25,"messages":42,"dropped":2,"simulated_seconds":0.5,"steps":50})");
}

TEST(Report, HasALineForEveryGapForPeople) {
  EXPECT_EQ(to_text(sample()), R"(run.mcap: world beam, 6 frames in 2 runs
  50 steps, 0.5 s simulated, 1.250 s recorded; 42 messages, 1.500 MB
  run 11: joined at frame 4
  gap: run 11, frame 6 (queue: the disk was too slow)
  gap: run 11, frames 10..12 (incomplete: some of their chunks are missing)
  dropped: 2 messages of flexcast/frames
  4 frames missing in 2 gaps: 3 incomplete, 1 queue
)");
}

TEST(Report, DoesNotFloodPeopleWithGapsButGivesAllToPrograms) {
  Report report = sample();
  report.reception.gaps.clear();
  for (std::uint64_t i = 0; i < 130; ++i) report.reception.gaps.push_back({11, 2 * i, 2 * i, GapCause::queue});
  const std::string text = to_text(report);
  EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), 2 + 1 + 100 + 1 + 1 + 1) << text;
  EXPECT_NE(text.find("and 30 more"), std::string::npos);
  EXPECT_NE(text.find("130 frames missing in 130 gaps"), std::string::npos);
  EXPECT_NE(to_json(report).find(R"("first":258)"), std::string::npos);
  EXPECT_EQ(gaps_metadata(report).size(), 133u);
}

TEST(Report, KeepsPausesApart) {
  Report report = sample();
  report.reception.pauses = {{11, 20, 29}, {12, 1, 1}};
  const std::string text = to_text(report);
  EXPECT_NE(text.find("  paused: run 11, frames 20..29\n  paused: run 12, frame 1\n"), std::string::npos) << text;
  EXPECT_NE(text.find("11 frames not recorded while paused"), std::string::npos) << text;
  EXPECT_NE(text.find("4 frames missing in 2 gaps"), std::string::npos) << text;
  EXPECT_NE(to_json(report).find(R"("paused":[{"run_id":11,"first":20,"last":29},{"run_id":12,"first":1,"last":1}])"
                                 R"(,"paused_frames":11)"),
            std::string::npos);
  EXPECT_EQ(gaps_metadata(report).at("pause.0"), "11 20 29");
  EXPECT_EQ(gaps_metadata(report).at("paused"), "11");
}

TEST(Report, SaysThatNothingIsMissing) {
  Report report = sample();
  report.reception.gaps.clear();
  EXPECT_NE(to_text(report).find("no frame is missing"), std::string::npos);
}

}  // namespace
}  // namespace flexcast::record
