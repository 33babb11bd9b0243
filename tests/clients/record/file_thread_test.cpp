#include "clients/record/file_thread.h"

#include <gtest/gtest.h>

#include <thread>

#include "clients/record/recording_file.h"
#include "tests/clients/mcap/contents.h"

namespace flexcast::record {
namespace {

using namespace std::chrono_literals;

// Takes so many bytes and then fails, as a full disk does.
class SmallDisk final : public mcap::ByteSink {
 public:
  explicit SmallDisk(std::size_t capacity) : left_(capacity) {}
  mcap::Status write(mcap::Bytes bytes) override {
    if (bytes.size() > left_) return mcap::Status::failure("the small disk is full");
    left_ -= bytes.size();
    return {};
  }
  mcap::Status flush() override { return {}; }

 private:
  std::size_t left_;
};

Item frame(std::uint32_t number) {
  return Message{.topic = wire::TopicId::frames, .sequence = number, .bytes = std::vector<std::byte>(100'000)};
}

TEST(FileThread, WritesEverythingThatIsInTheQueueBeforeItFinishes) {
  mcap::MemorySink sink;
  auto file = RecordingFile::create(sink, mcap::Compression::kNone);
  ItemQueue queue(1 << 28);
  FileThread thread(queue, *file.value());
  for (std::uint32_t i = 0; i < 100; ++i) ASSERT_EQ(queue.push(frame(i)), Pushed::taken);
  thread.start();
  EXPECT_TRUE(thread.finish().ok());
  EXPECT_TRUE(file.value()->close().ok());
  const auto contents = mcap::test::read(sink.bytes());
  ASSERT_EQ(contents.messages.size(), 100u);
  for (std::uint32_t i = 0; i < 100; ++i) EXPECT_EQ(contents.messages[i].sequence, i);
}

TEST(FileThread, ClosesTheQueueAndKeepsTheReasonWhenTheDiskFails) {
  SmallDisk disk(1'500'000);
  auto file = RecordingFile::create(disk, mcap::Compression::kNone);
  ItemQueue queue(1 << 28);
  FileThread thread(queue, *file.value());
  thread.start();
  Pushed pushed = Pushed::taken;
  for (int i = 0; i < 10'000 && pushed != Pushed::closed; ++i) {
    pushed = queue.push(frame(0));
    std::this_thread::sleep_for(1ms);
  }
  EXPECT_EQ(pushed, Pushed::closed);
  EXPECT_TRUE(thread.failed());
  EXPECT_EQ(thread.finish().message(), "the small disk is full");
}

TEST(FileThread, HandsOverAnOpenChunkWhenNothingMoreComes) {
  mcap::MemorySink sink;
  auto file = RecordingFile::create(sink, mcap::Compression::kNone);
  ItemQueue queue(1 << 28);
  FileThread thread(queue, *file.value());
  thread.start();
  ASSERT_EQ(queue.push(Message{.topic = wire::TopicId::events, .log_time = 1, .bytes = {}}), Pushed::taken);
  for (int i = 0; i < 1000 && thread.bytes_written() < 1000; ++i) std::this_thread::sleep_for(10ms);
  EXPECT_GE(thread.bytes_written(), 1000u) << "the chunk with the schemas was not written";
  EXPECT_TRUE(thread.finish().ok());
}

}  // namespace
}  // namespace flexcast::record
