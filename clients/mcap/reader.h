// Reader: goes through an MCAP file from the first record to the last, into the chunks as well.
//
//   Result<MappedFile> file = MappedFile::open(path);
//   Reader reader(file.value().bytes());
//   while (const Record* record = reader.next()) {
//     if (const auto* message = std::get_if<Message>(record)) use(*message, *reader.channel(message->channel));
//   }
//   if (reader.end().ending != Ending::kComplete) warn(reader.end().message);
#pragma once

#include <cstdint>
#include <string>

#include "clients/mcap/decompressor.h"
#include "clients/mcap/definitions.h"
#include "clients/mcap/records.h"

namespace flexcast::mcap {

struct ReaderOptions {
  bool check_crcs = true;
  std::uint64_t max_chunk_bytes = 256ull * 1024 * 1024;      // a chunk that unpacks to more is damage
  std::uint64_t max_definition_bytes = 64ull * 1024 * 1024;  // schemas and channels with more text are damage
};

enum class Ending {
  kOpen,       // next() has more to say
  kComplete,   // read to the last magic byte, every checksum is right
  kTruncated,  // the file ends inside a record: a recorder was killed or the disk was full
  kDamaged,    // something is wrong with what is there
};

struct ReadEnd {
  Ending ending = Ending::kOpen;

  // The file up to here consists of whole and sound records outside of chunks.
  std::uint64_t intact_bytes = 0;

  // One sentence, such as "truncated after byte 4711: ..."; empty when complete.
  std::string message;
};

// Trusts nothing the file says: no read outside of it, no memory beyond the limits. A chunk is unpacked and its
// checksum compared before the first of its records is given, so that what was recorded before a truncation is given
// whole.
class Reader {
 public:
  // `file` is the whole file and must outlive the reader.
  explicit Reader(Bytes file, ReaderOptions options = {});

  // The next record, valid until the following call; null at the end, see end(). A chunk comes before its records,
  // schemas and channels come again in the summary. A message comes only after its channel and schema are known.
  const Record* next();

  // Goes on with the record at `offset`: a record_offset() that this reader has told, or 0 for the beginning. Schemas
  // and channels met so far stay known. Unless it is the beginning, the checksum of the whole data section is not
  // compared any more; that of each chunk still is.
  void seek(std::uint64_t offset);

  const ReadEnd& end() const { return end_; }

  // Of the current record, or of the chunk it is in.
  std::uint64_t record_offset() const { return record_offset_; }
  bool in_chunk() const { return in_chunk_; }
  bool in_summary() const { return summary_start_ != 0; }

  // Null if the file has not named it yet.
  const SchemaInfo* schema(SchemaId id) const { return definitions_.schema(id); }
  const ChannelInfo* channel(ChannelId id) const { return definitions_.channel(id); }
  const Definitions& definitions() const { return definitions_; }

 private:
  bool start();
  bool next_in_file();
  bool next_in_chunk();
  bool accept(Bytes whole_record);
  bool accept_chunk(const Chunk& chunk);
  bool accept_attachment(const Attachment& attachment);
  bool accept_data_end(const DataEnd& data_end);
  bool accept_footer(const Footer& footer);
  bool accept_definition();

  bool truncated(const std::string& what);
  bool damaged(const std::string& what);

  Bytes file_;
  ReaderOptions options_;
  Decompressor decompressor_;
  Definitions definitions_;

  Record record_;
  std::uint64_t position_ = 0;  // of the next record outside of chunks
  std::uint64_t record_offset_ = 0;
  std::uint64_t summary_start_ = 0;  // 0 before the end of the data section
  std::uint32_t data_crc_ = 0;
  bool read_from_start_ = true;  // every byte so far is in data_crc_
  Bytes chunk_rest_;             // records of the chunk that were not given yet
  bool in_chunk_ = false;
  ReadEnd end_;
};

}  // namespace flexcast::mcap
