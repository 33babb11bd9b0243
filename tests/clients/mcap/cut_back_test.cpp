// Writers whose disk becomes full.
#include "tests/clients/mcap/sample_recording.h"

namespace flexcast::mcap::test {
namespace {

// Takes so many bytes, part of the last write too, and then fails.
class SmallDisk final : public ByteSink {
 public:
  explicit SmallDisk(std::size_t capacity) : capacity_(capacity) {}
  Status write(Bytes bytes) override {
    const std::size_t fits = std::min(bytes.size(), capacity_ - memory_.bytes().size());
    if (Status status = memory_.write(bytes.first(fits)); !status) return status;
    return fits == bytes.size() ? Status() : Status::failure("the small disk is full");
  }
  Status flush() override { return {}; }
  Status cut(std::uint64_t bytes) override { return memory_.cut(bytes); }
  Bytes bytes() const { return memory_.bytes(); }

 private:
  std::size_t capacity_;
  MemorySink memory_;
};

// Cuts back until the file can be completed; false if it cannot.
bool complete(Writer& writer, Status status) {
  for (int tries = 0; !status && tries < 100; ++tries) {
    if (!writer.cut_back(0)) return false;
    status = writer.close();
  }
  return status.ok();
}

TEST(McapCutBack, LeavesACompleteFileOfWholeChunksWhereverTheDiskEnds) {
  const SampleOptions sample = {.messages = 120, .message_bytes = 200};
  const std::vector<MessageCopy> all = sample_messages(sample);
  std::size_t completed = 0;
  for (std::size_t capacity = 200; capacity < 30'000; capacity += 97) {
    SmallDisk disk(capacity);
    Writer writer(disk, {.compression = Compression::kNone, .chunk_bytes = 1000});
    const SchemaId schema =
        value_of(writer.add_schema("flexcast::ParticleFrame", "omgidl", "struct ParticleFrame {};"));
    const ChannelId frames = value_of(writer.add_channel("flexcast/frames", "cdr", schema));
    const ChannelId statuses = value_of(writer.add_channel("flexcast/status", "cdr", schema));
    Status status;
    for (std::size_t i = 0; i < all.size() && status; ++i) {
      status = writer.write_message(all[i].topic == "flexcast/frames" ? frames : statuses, all[i].sequence,
                                    all[i].log_time, all[i].publish_time, bytes_of(all[i].data));
    }
    if (status) status = writer.close();
    if (!complete(writer, status)) continue;
    ++completed;
    const Contents contents = read(disk.bytes());
    ASSERT_EQ(contents.end.ending, Ending::kComplete) << capacity << ": " << contents.end.message;
    ASSERT_EQ(contents.messages.size(), writer.totals().messages);
    ASSERT_EQ(contents.totals->messages, contents.messages.size());
    ASSERT_TRUE(std::equal(contents.messages.begin(), contents.messages.end(), all.begin())) << capacity;
  }
  EXPECT_GT(completed, 250u) << "of 308 disks nearly all have room for a chunk and a summary";
}

TEST(McapCutBack, FailsWithTheReasonOfTheDiskWhenThereIsNoWholeChunk) {
  SmallDisk disk(100);
  Writer writer(disk);
  expect_ok(writer.add_channel("flexcast/frames", "cdr", 0).status());
  Status status = writer.write_message(1, 0, 0, 0, bytes_of(std::string(3'000'000, 'x')));
  if (status) status = writer.flush();
  ASSERT_FALSE(status.ok());
  EXPECT_EQ(writer.cut_back(0).message(), "the small disk is full");
}

TEST(McapLargeMessages, AreTheSameInAFileWithoutCompression) {
  MemorySink sink;
  Writer writer(sink, {.compression = Compression::kNone});
  const ChannelId channel = value_of(writer.add_channel("flexcast/frames", "cdr", 0));
  for (std::uint32_t i = 0; i < 6; ++i) {
    const std::string data(i % 2 == 0 ? 300'000 : 100, static_cast<char>('a' + i));
    expect_ok(writer.write_message(channel, i, i, i, bytes_of(data)));
  }
  expect_ok(writer.close());
  const Contents contents = read(sink.bytes());
  EXPECT_EQ(contents.end.ending, Ending::kComplete) << contents.end.message;
  ASSERT_EQ(contents.messages.size(), 6u);
  for (std::uint32_t i = 0; i < 6; ++i) {
    EXPECT_EQ(contents.messages[i].data, std::string(i % 2 == 0 ? 300'000 : 100, static_cast<char>('a' + i)));
  }
  EXPECT_EQ(contents.chunk_offsets.size(), 4u) << "each large message ends a chunk";
}

}  // namespace
}  // namespace flexcast::mcap::test
