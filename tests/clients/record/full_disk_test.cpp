// Recordings on a disk that becomes full, here by a limit on the size of files.
#include <sys/resource.h>
#include <csignal>

#include "clients/record/split_destination.h"
#include "tests/clients/record/recordings.h"

namespace flexcast::record {
namespace {

using namespace std::chrono_literals;

using test::eventually;
using test::Publisher;
using test::TemporaryFile;

// No file of this process grows beyond so many bytes while this object lives.
class SizeLimit {
 public:
  explicit SizeLimit(rlim_t bytes) {
    previous_handler_ = std::signal(SIGXFSZ, SIG_IGN);
    getrlimit(RLIMIT_FSIZE, &previous_);
    const rlimit limit{bytes, previous_.rlim_max};
    setrlimit(RLIMIT_FSIZE, &limit);
  }
  ~SizeLimit() {
    setrlimit(RLIMIT_FSIZE, &previous_);
    std::signal(SIGXFSZ, previous_handler_);
  }
  SizeLimit(const SizeLimit&) = delete;
  SizeLimit& operator=(const SizeLimit&) = delete;

 private:
  rlimit previous_{};
  void (*previous_handler_)(int) = SIG_DFL;
};

// Publishes frames of about a tenth of a megabyte until the recorder has had enough.
std::uint64_t publish_until_ended(const Publisher& server, const Recorder& recorder) {
  std::uint64_t frame = 0;
  for (; frame < 2000 && !recorder.ended(); ++frame) {
    server.publish_large_chunk(1000, frame, 0, 2);
    server.publish_large_chunk(1000, frame, 1, 2);
    std::this_thread::sleep_for(2ms);
  }
  return frame;
}

TEST(FullDisk, LeavesACompleteRecordingWithoutTheFramesThatItNames) {
  const Publisher server("beam");
  const TemporaryFile file;
  Options options = test::options_for(file);
  options.compression = mcap::Compression::kNone;
  auto recorder = test::start(options);
  const SizeLimit limit(5'000'000);
  ASSERT_LT(publish_until_ended(server, *recorder), 2000u);
  const auto report = recorder->finish();
  ASSERT_TRUE(report.ok()) << report.error().message;
  EXPECT_EQ(report.value().failure, "cannot write " + file.path() + ": File too large");

  const auto contents = test::read(file);
  EXPECT_LE(std::filesystem::file_size(file.path()), 5'000'000u);
  EXPECT_GE(std::filesystem::file_size(file.path()), 2'000'000u);
  const auto sequences = test::sequences_of(contents, "flexcast/frames");
  const std::uint64_t whole = frame_count(report.value());
  std::map<std::uint32_t, int> chunks;
  for (const std::uint32_t sequence : sequences) ++chunks[sequence];
  EXPECT_EQ(std::count_if(chunks.begin(), chunks.end(), [](const auto& frame) { return frame.second == 2; }),
            static_cast<std::ptrdiff_t>(whole));
  // What comes behind the frames that are there is named, without a hole.
  const std::vector<Gap>& gaps = report.value().reception.gaps;
  ASSERT_EQ(gaps.size(), 1u);
  EXPECT_EQ(gaps[0].cause, GapCause::disk);
  EXPECT_EQ(gaps[0].first, whole);
  EXPECT_EQ(contents.metadata.at("flexcast.recording").at("ended"), "failed");
  EXPECT_EQ(contents.metadata.at("flexcast.recording").at("frames"), std::to_string(whole));
  EXPECT_EQ(contents.metadata.at("flexcast.gaps").at("gap.0"),
            "1000 " + std::to_string(gaps[0].first) + " " + std::to_string(gaps[0].last) + " disk");
}

TEST(FullDisk, LeavesThePartsBeforeItComplete) {
  const Publisher server("beam");
  const TemporaryFile file;
  Options options = test::options_for(file);
  options.compression = mcap::Compression::kNone;
  options.split_size = 1'500'000;
  auto recorder = test::start(options);
  const std::string second = part_path(file.path(), 1);
  std::uint64_t frame = 0;
  for (; frame < 2000 && !std::filesystem::exists(second); ++frame) {
    server.publish_large_chunk(1000, frame, 0, 1);
    std::this_thread::sleep_for(2ms);
  }
  const SizeLimit limit(100'000);  // no whole chunk of the next part
  for (; frame < 4000 && !recorder->ended(); ++frame) {
    server.publish_large_chunk(1000, frame, 0, 1);
    std::this_thread::sleep_for(2ms);
  }
  const auto report = recorder->finish();
  ASSERT_TRUE(report.ok()) << report.error().message;
  EXPECT_NE(report.value().failure.find(": File too large"), std::string::npos) << report.value().failure;
  ASSERT_GE(report.value().parts.size(), 1u);
  std::size_t messages = 0;
  for (const std::string& path : report.value().parts) {
    const auto mapped = mcap::MappedFile::open(path);
    const auto contents = mcap::test::read(mapped.value().bytes());
    EXPECT_EQ(contents.end.ending, mcap::Ending::kComplete) << contents.end.message;
    messages += test::messages_of(contents, "flexcast/frames").size();
    std::filesystem::remove(path);
  }
  EXPECT_EQ(messages, frame_count(report.value()));
  ASSERT_EQ(report.value().reception.gaps.size(), 1u);
  EXPECT_EQ(report.value().reception.gaps[0].first, messages);
  EXPECT_EQ(report.value().reception.gaps[0].cause, GapCause::disk);
}

}  // namespace
}  // namespace flexcast::record
