// What a recorder says of frames while it records is what its file says when it was killed.
#include "clients/record/account_note.h"

#include <gtest/gtest.h>

#include <fstream>
#include <random>

#include "clients/record/content_ledger.h"
#include "clients/record/gap_ledger.h"
#include "clients/record/recovery.h"
#include "tests/clients/record/recordings.h"

namespace flexcast::record {
namespace {

constexpr std::uint64_t the_server = 1;  // a writer

wire::FrameHead head_of(std::uint64_t run_id, std::uint64_t frame) {
  wire::FrameHead head;
  head.run_id = run_id;
  head.frame = frame;
  head.chunks = 1;
  return head;
}

TEST(AccountNote, ReadsFromMetadataAsItWasWritten) {
  const AccountNote note{.watched = {7, 8},
                         .paused = {{7, 1, 2}, {8, 0, 0}},
                         .dropped = {{7, 5, 9}},
                         .messages = {{wire::TopicId::frames, 5}, {wire::TopicId::events, 1}}};
  const AccountNote read = account_of(to_metadata(note));
  EXPECT_EQ(read.watched, note.watched);
  EXPECT_EQ(read.paused, note.paused);
  EXPECT_EQ(read.dropped, note.dropped);
  EXPECT_EQ(read.messages, note.messages);
}

TEST(AccountNote, PassesOverWhatMakesNoSense) {
  const AccountNote note = account_of({{"pause.0", "7 9 2"},
                                       {"pause.1", "7 9"},
                                       {"queue.0", "one two three"},
                                       {"queue.1", "7 0 18446744073709551615"},
                                       {"watched.0", ""},
                                       {"dropped.nothing", "3"},
                                       {"other", "1"}});
  EXPECT_TRUE(note.empty());
  EXPECT_TRUE(note.messages.empty());
}

// Any mixture of recorded, dropped, paused and lost frames, in several runs, noted at any moment.
TEST(AccountNote, TellsAnotherLedgerAllThatTheFramesThemselvesDoNot) {
  for (unsigned seed = 0; seed < 200; ++seed) {
    std::mt19937 random(seed);
    const auto one_of = [&](unsigned n) { return random() % n == 0; };
    GapLedger live, told;
    const std::uint64_t first_run = 1000;
    for (std::uint64_t run_id = first_run; run_id < first_run + 3; ++run_id) {
      std::uint64_t frame = run_id == first_run ? random() % 5 : 0;
      for (const std::uint64_t end = frame + 60; frame < end; ++frame) {
        if (one_of(12)) live.is_paused() ? live.resume() : live.pause();
        if (one_of(8)) told.note(account_of(to_metadata(live.take_news())));
        if (one_of(6)) continue;  // lost
        const wire::FrameHead head = head_of(run_id, frame);
        const Verdict verdict = live.judge(head);
        if (verdict == Verdict::paused) live.skip(head, the_server);
        if (verdict != Verdict::record) continue;
        if (one_of(5)) {
          live.drop(head, the_server);
        } else {
          live.add(head, the_server);
          ASSERT_EQ(told.judge(head), Verdict::record);
          told.add(head, 0);  // nobody knows who sent it
        }
      }
    }
    told.note(live.take_news());
    ASSERT_EQ(told.gaps(), live.gaps()) << seed;
    ASSERT_EQ(told.pauses(), live.pauses()) << seed;
    ASSERT_EQ(told.missing(), live.missing()) << seed;
    ASSERT_EQ(told.frames(), live.frames()) << seed;
    ASSERT_TRUE(live.take_news().empty());
  }
}

// Copies what a recorder has written so far, as if it had been killed now, and completes that.
Report recover_now(const std::string& path) {
  const mcap::MappedFile file = mcap::MappedFile::open(path).value();
  mcap::MemorySink sink;
  auto recovered = recover(file.bytes(), sink);
  if (!recovered) throw std::runtime_error(recovered.status().message());
  EXPECT_EQ(mcap::test::read(sink.bytes()).end.ending, mcap::Ending::kComplete);
  return recovered.value().report;
}

TEST(AccountNote, OfAPausedRecorderIsInItsFileBeforeItEnds) {
  const test::TemporaryFile file;
  const test::Publisher publisher("beam");
  auto options = test::options_for(file);
  options.paused = true;
  auto recorder = test::start(options);
  publisher.publish_frames(1000, 0, 9);
  std::optional<Report> report;
  ASSERT_TRUE(test::eventually([&] {
    report = recover_now(file.path());
    return !report->reception.pauses.empty();
  }));
  ASSERT_TRUE(test::eventually([&] {
    report = recover_now(file.path());
    return report->reception.pauses == std::vector<Pause>{{1000, 0, 9}};
  }));
  EXPECT_TRUE(report->reception.gaps.empty());
  EXPECT_EQ(frame_count(*report), 0u);
  ASSERT_TRUE(recorder->finish().ok());
  const auto contents = test::read(file);  // complete and sound
  EXPECT_EQ(contents.metadata.at("flexcast.gaps").at("pause.0"), "1000 0 9");
}

TEST(AccountNote, OfARecordingWithoutPausesAndDropsIsNone) {
  const test::TemporaryFile file;
  const test::Publisher publisher("beam");
  auto recorder = test::start(test::options_for(file));
  publisher.publish_frames(1000, 0, 9);
  test::finish(*recorder, 10);
  EXPECT_FALSE(test::read(file).metadata.contains(account_metadata));
}

}  // namespace
}  // namespace flexcast::record
