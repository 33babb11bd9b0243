#include "clients/record/ring_parts.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "clients/mcap/mapped_file.h"
#include "clients/record/new_file.h"
#include "clients/record/recording_copy.h"
#include "idl/wire/frame_head.h"

namespace flexcast::record {
namespace {

namespace fs = std::filesystem;

// Records of one file after the other.
class PartReader {
 public:
  explicit PartReader(std::vector<std::string> paths) : paths_(std::move(paths)) {}

  // The next record, null at the end of the last file. A file that cannot be opened counts as empty.
  const mcap::Record* next() {
    for (;;) {
      const mcap::Record* record = reader_ ? reader_->next() : nullptr;
      if (record != nullptr || !open_next()) return record;
    }
  }
  const mcap::Reader& reader() const { return *reader_; }

 private:
  bool open_next() {
    if (opened_ == paths_.size()) return false;
    auto file = mcap::MappedFile::open(paths_[opened_++]);
    reader_.reset();
    if (!file) return true;
    file_ = std::make_unique<mcap::MappedFile>(std::move(file).value());
    reader_ = std::make_unique<mcap::Reader>(file_->bytes());
    return true;
  }

  std::vector<std::string> paths_;
  std::size_t opened_ = 0;
  std::unique_ptr<mcap::MappedFile> file_;  // before the reader of it
  std::unique_ptr<mcap::Reader> reader_;
};

std::vector<std::string> list_parts(const std::string& path) {
  std::vector<std::string> parts;
  std::error_code ignored;
  for (const auto& entry : fs::directory_iterator(ring_folder(path), ignored)) {
    if (entry.path().filename().string().starts_with("ring-")) parts.push_back(entry.path().string());
  }
  std::sort(parts.begin(), parts.end());
  return parts;
}

bool is_frame(const mcap::Reader& reader, const mcap::Message& message) {
  return reader.channel(message.channel)->topic == wire::topic(wire::TopicId::frames).name;
}

// Which frames and statuses are new enough.
class Window {
 public:
  void note(const mcap::Reader& reader, const mcap::Message& message) {
    newest_ = std::max(newest_, message.log_time);
    const auto head = wire::peek_frame_head(message.data);
    if (!is_frame(reader, message) || !head) return;
    const auto [oldest, is_first] =
        oldest_chunk_.emplace(std::pair{head.value().run_id, head.value().frame}, message.log_time);
    if (!is_first) oldest->second = std::min(oldest->second, message.log_time);
  }
  void set_length(double seconds) {
    const auto length = static_cast<mcap::Time>(seconds * 1e9);
    begin_ = newest_ > length ? newest_ - length : 0;
  }
  bool contains(const mcap::Reader& reader, const mcap::Message& message) const {
    const auto head = wire::peek_frame_head(message.data);
    if (!is_frame(reader, message) || !head) return message.log_time >= begin_;
    return oldest_chunk_.at({head.value().run_id, head.value().frame}) >= begin_;
  }

 private:
  std::map<std::pair<std::uint64_t, std::uint64_t>, mcap::Time> oldest_chunk_;  // by run and frame
  mcap::Time newest_ = 0;
  mcap::Time begin_ = 0;
};

// How many seconds the base says; none if there is no such base.
std::optional<double> find_length(const std::string& base) {
  PartReader files({base});
  while (const mcap::Record* record = files.next()) {
    const auto* metadata = std::get_if<mcap::Metadata>(record);
    if (metadata == nullptr || metadata->name != ring_metadata) continue;
    return std::strtod(std::string(metadata->values.find("seconds").value_or("0")).c_str(), nullptr);
  }
  return std::nullopt;
}

Window find_window(std::vector<std::string> files, const std::string& base, double seconds) {
  Window window;
  files.push_back(base);
  PartReader reader(std::move(files));
  while (const mcap::Record* record = reader.next()) {
    const auto* message = std::get_if<mcap::Message>(record);
    if (message != nullptr) window.note(reader.reader(), *message);
  }
  window.set_length(seconds);
  return window;
}

// Everything of both, in the order of the log times.
mcap::Status join(RecordingCopy& copy, PartReader& base, PartReader& ring, const Window& window) {
  const mcap::Record* one = base.next();
  const mcap::Record* other = ring.next();
  while (one != nullptr || other != nullptr) {
    const auto* in_base = one ? std::get_if<mcap::Message>(one) : nullptr;
    const auto* in_ring = other ? std::get_if<mcap::Message>(other) : nullptr;
    const bool base_first = one && (!in_base || !other || (in_ring && in_base->log_time <= in_ring->log_time));
    if (base_first) {
      if (auto status = copy.take(base.reader(), *one); !status) return status;
      one = base.next();
      continue;
    }
    if (!in_ring || window.contains(ring.reader(), *in_ring)) {
      if (auto status = copy.take(ring.reader(), *other); !status) return status;
    }
    other = ring.next();
  }
  return {};
}

mcap::Compression compression_of(const std::string& path) {
  const auto file = mcap::MappedFile::open(path);
  return file ? find_compression(file.value().bytes()) : mcap::Compression::kLz4;
}

}  // namespace

std::string ring_folder(const std::string& path) {
  return path + ".parts";
}

std::string ring_base(const std::string& path) {
  return ring_folder(path) + "/base.mcap";
}

std::string ring_part(const std::string& path, std::uint64_t number) {
  return fmt::format("{}/ring-{:06}.mcap", ring_folder(path), number);
}

bool has_ring(const std::string& path) {
  std::error_code ignored;
  return fs::exists(ring_base(path), ignored);
}

void remove_ring(const std::string& path) {
  std::error_code ignored;
  for (const std::string& part : list_parts(path)) fs::remove(part, ignored);
  fs::remove(ring_base(path), ignored);
  fs::remove(ring_folder(path), ignored);
}

wire::Result<Report> join_ring(const std::string& path, const EndReport& make_report) {
  const std::string base = ring_base(path);
  const auto seconds = find_length(base);
  if (!seconds) return wire::Error{base + " is not the base of a recording of the last seconds"};
  const std::vector<std::string> parts = list_parts(path);
  const Window window = find_window(parts, base, *seconds);
  auto file = NewFile::create(path);
  if (!file) return file.error();
  RecordingCopy copy(file.value().sink(), compression_of(base));
  PartReader base_reader({base}), ring_reader(parts);
  if (auto status = join(copy, base_reader, ring_reader, window); !status) return wire::Error{status.message()};
  Report report = make_report(copy.ledger());
  if (auto status = copy.complete(report); !status) return wire::Error{status.message()};
  report.file = path;
  if (auto kept = file.value().keep(); !kept) return kept.error();
  return report;
}

}  // namespace flexcast::record
