#include "clients/mcap/reader.h"

#include <algorithm>

#include "clients/mcap/crc32.h"
#include "clients/mcap/format.h"
#include "clients/mcap/record_parser.h"

namespace flexcast::mcap {
namespace {

bool is_known(std::uint8_t opcode) {
  return opcode <= static_cast<std::uint8_t>(Opcode::kDataEnd);
}

bool allowed_in_data(std::uint8_t opcode) {
  switch (static_cast<Opcode>(opcode)) {
    case Opcode::kSchema:
    case Opcode::kChannel:
    case Opcode::kMessage:
    case Opcode::kChunk:
    case Opcode::kMessageIndex:
    case Opcode::kAttachment:
    case Opcode::kMetadata:
    case Opcode::kDataEnd:
      return true;
    default:
      return !is_known(opcode);
  }
}

bool allowed_in_chunk(std::uint8_t opcode) {
  switch (static_cast<Opcode>(opcode)) {
    case Opcode::kSchema:
    case Opcode::kChannel:
    case Opcode::kMessage:
      return true;
    default:
      return !is_known(opcode);
  }
}

bool allowed_in_summary(std::uint8_t opcode) {
  switch (static_cast<Opcode>(opcode)) {
    case Opcode::kSchema:
    case Opcode::kChannel:
    case Opcode::kStatistics:
    case Opcode::kChunkIndex:
    case Opcode::kAttachmentIndex:
    case Opcode::kMetadataIndex:
    case Opcode::kSummaryOffset:
    case Opcode::kFooter:
      return true;
    default:
      return !is_known(opcode);
  }
}

// True if `bytes` starts with a whole record; `record` is that record, prefix included.
bool split_record(Bytes bytes, Bytes& record) {
  if (bytes.size() < kRecordPrefixBytes) return false;
  const auto body_bytes = load<std::uint64_t>(bytes.subspan(1));
  if (body_bytes > bytes.size() - kRecordPrefixBytes) return false;
  record = bytes.first(kRecordPrefixBytes + body_bytes);
  return true;
}

std::uint8_t opcode_of(Bytes record) {
  return std::to_integer<std::uint8_t>(record[0]);
}

}  // namespace

Reader::Reader(Bytes file, ReaderOptions options)
    : file_(file),
      options_(options),
      decompressor_(options.max_chunk_bytes),
      definitions_(options.max_definition_bytes) {}

const Record* Reader::next() {
  if (end_.ending != Ending::kOpen) return nullptr;
  if (position_ == 0 && !start()) return nullptr;
  in_chunk_ = !chunk_rest_.empty();
  return (in_chunk_ ? next_in_chunk() : next_in_file()) ? &record_ : nullptr;
}

void Reader::seek(std::uint64_t offset) {
  position_ = offset;
  summary_start_ = 0;
  read_from_start_ = offset == 0;
  data_crc_ = 0;
  chunk_rest_ = {};
  end_ = {};
}

bool Reader::start() {
  const std::size_t there = std::min(file_.size(), kMagic.size());
  if (!std::equal(file_.begin(), file_.begin() + static_cast<std::ptrdiff_t>(there), kMagic.begin())) {
    return damaged("this is not an MCAP file of version 0");
  }
  if (there < kMagic.size()) return truncated("the file is shorter than its first eight bytes");
  position_ = kMagic.size();
  return true;
}

bool Reader::next_in_file() {
  record_offset_ = position_;
  const Bytes rest = file_.subspan(position_);
  Bytes record;
  if (!rest.empty() && opcode_of(rest) == 0) return damaged("a record has the type 0");
  if (!split_record(rest, record)) return truncated("the file ends before the record that starts there");
  const std::uint8_t opcode = opcode_of(record);
  const bool is_first = position_ == kMagic.size();
  if (is_first != (opcode == static_cast<std::uint8_t>(Opcode::kHeader)) ||
      (!is_first && !(in_summary() ? allowed_in_summary(opcode) : allowed_in_data(opcode)))) {
    return damaged(record_name(opcode) + " in the wrong place");
  }
  const std::optional<Record> parsed = parse_record(opcode, record.subspan(kRecordPrefixBytes));
  if (!parsed) return damaged(record_name(opcode) + " with malformed fields");
  record_ = *parsed;
  position_ += record.size();
  return accept(record);
}

bool Reader::next_in_chunk() {
  Bytes record;
  if (!split_record(chunk_rest_, record)) return damaged("a record ends outside of its chunk");
  const std::uint8_t opcode = opcode_of(record);
  if (opcode == 0 || !allowed_in_chunk(opcode)) return damaged(record_name(opcode) + " inside of a chunk");
  const std::optional<Record> parsed = parse_record(opcode, record.subspan(kRecordPrefixBytes));
  if (!parsed) return damaged(record_name(opcode) + " with malformed fields inside of a chunk");
  record_ = *parsed;
  chunk_rest_ = chunk_rest_.subspan(record.size());
  return accept_definition();
}

bool Reader::accept(Bytes whole_record) {
  if (const auto* data_end = std::get_if<DataEnd>(&record_)) return accept_data_end(*data_end);
  if (const auto* footer = std::get_if<Footer>(&record_)) return accept_footer(*footer);
  if (options_.check_crcs && !in_summary()) data_crc_ = crc32(whole_record, data_crc_);
  if (const auto* chunk = std::get_if<Chunk>(&record_)) return accept_chunk(*chunk);
  if (const auto* attachment = std::get_if<Attachment>(&record_)) return accept_attachment(*attachment);
  return accept_definition();
}

bool Reader::accept_chunk(const Chunk& chunk) {
  const Result<Bytes> records = decompressor_.decompress(chunk.compression, chunk.packed, chunk.unpacked_bytes);
  if (!records) return damaged("a chunk cannot be read: " + records.status().message());
  if (options_.check_crcs && chunk.unpacked_crc != 0 && crc32(records.value()) != chunk.unpacked_crc) {
    return damaged("the checksum of a chunk is wrong");
  }
  chunk_rest_ = records.value();
  return true;
}

bool Reader::accept_attachment(const Attachment& attachment) {
  if (options_.check_crcs && attachment.crc != 0 && crc32(attachment.checked) != attachment.crc) {
    return damaged("the checksum of an attachment is wrong");
  }
  return true;
}

bool Reader::accept_data_end(const DataEnd& data_end) {
  // The checksum starts with the first byte of the file.
  const std::uint32_t crc = crc32_join(crc32(file_.first(kMagic.size())), data_crc_, record_offset_ - kMagic.size());
  const bool can_check = options_.check_crcs && read_from_start_;
  if (can_check && data_end.data_section_crc != 0 && data_end.data_section_crc != crc) {
    return damaged("the checksum of the data section is wrong");
  }
  summary_start_ = position_;
  return true;
}

bool Reader::accept_footer(const Footer& footer) {
  // Without a summary the footer follows the data section and its checksum covers only itself.
  if (footer.summary_start != 0 ? footer.summary_start != summary_start_ : record_offset_ != summary_start_) {
    return damaged("the footer is wrong about the start of the summary");
  }
  const std::uint64_t checked_end = record_offset_ + kRecordPrefixBytes + 8 + 8;
  const std::uint32_t crc = crc32(file_.first(checked_end).subspan(summary_start_));
  if (options_.check_crcs && footer.summary_crc != 0 && footer.summary_crc != crc) {
    return damaged("the checksum of the summary is wrong");
  }
  const Bytes rest = file_.subspan(position_);
  const std::size_t there = std::min(rest.size(), kMagic.size());
  if (!std::equal(rest.begin(), rest.begin() + static_cast<std::ptrdiff_t>(there), kMagic.begin()) ||
      rest.size() > kMagic.size()) {
    return damaged("the footer is not followed by the end of the file");
  }
  if (there < kMagic.size()) return truncated("the file ends before its last eight bytes");
  end_ = {.ending = Ending::kComplete, .intact_bytes = file_.size(), .message = ""};
  return true;
}

bool Reader::accept_definition() {
  Status status;
  if (const auto* schema = std::get_if<Schema>(&record_)) status = definitions_.add(*schema);
  if (const auto* channel = std::get_if<Channel>(&record_)) status = definitions_.add(*channel);
  if (const auto* message = std::get_if<Message>(&record_); message && !channel(message->channel)) {
    status = Status::failure("a message names channel " + std::to_string(message->channel) + ", which is not there");
  }
  return status ? true : damaged(status.message());
}

bool Reader::truncated(const std::string& what) {
  end_ = {.ending = Ending::kTruncated,
          .intact_bytes = record_offset_,
          .message = "truncated after byte " + std::to_string(record_offset_) + ": " + what};
  return false;
}

bool Reader::damaged(const std::string& what) {
  end_ = {.ending = Ending::kDamaged,
          .intact_bytes = record_offset_,
          .message = "damaged at byte " + std::to_string(record_offset_) + ": " + what};
  return false;
}

}  // namespace flexcast::mcap
