// MCAP files: any bytes are read to an end that says what it is, and the messages of our topics decode or are refused.
#include <unistd.h>

#include <fstream>
#include <vector>

#include "clients/recording/recording.h"
#include "idl/wire/decode.h"
#include "tests/fuzz/targets/fuzz.h"

namespace flexcast::fuzz {
namespace {

// Limits that keep an input of a few kilobytes from asking for more memory than the fuzzer grants.
constexpr mcap::ReaderOptions small{.max_chunk_bytes = 1 << 20, .max_definition_bytes = 1 << 16};

void read_records(std::span<const std::byte> file, bool check_crcs) {
  mcap::ReaderOptions options = small;
  options.check_crcs = check_crcs;
  mcap::Reader reader(file, options);
  while (const mcap::Record* record = reader.next()) {
    const auto* message = std::get_if<mcap::Message>(record);
    if (!message) continue;
    require(reader.channel(message->channel) != nullptr, "a message without its channel");
    for (const wire::TopicRow& row : wire::topic_table()) {
      std::vector<std::byte> sample(row.descriptor->m_size);
      if (wire::decode(sample.data(), *row.descriptor, message->data))
        wire::free_contents(sample.data(), *row.descriptor);
    }
  }
  require(reader.end().ending != mcap::Ending::kOpen, "an end that is none");
  require(reader.end().intact_bytes <= file.size(), "more intact bytes than there are");
}

// By its file, as the programs do.
void read_recording(std::span<const std::byte> file) {
  const std::string path = "/dev/shm/flexcast-fuzz-" + std::to_string(getpid()) + ".mcap";
  std::ofstream(path, std::ios::binary)
      .write(reinterpret_cast<const char*>(file.data()), static_cast<std::streamsize>(file.size()));
  if (auto recording = recording::Recording::open(path)) {
    std::size_t messages = 0, again = 0;
    while (recording.value().next()) ++messages;
    recording.value().rewind();
    while (recording.value().next()) ++again;
    require(messages == again, "a recording that has other messages after a rewind");
  }
  unlink(path.c_str());
}

}  // namespace
}  // namespace flexcast::fuzz

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace flexcast;
  const auto file = fuzz::as_bytes(data, size);
  fuzz::read_records(file, true);
  fuzz::read_records(file, false);  // else no change of a byte would come past the checksums
  fuzz::read_recording(file);
  return 0;
}
