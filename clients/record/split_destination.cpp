#include "clients/record/split_destination.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

namespace flexcast::record {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t room = 32 * 1024;  // for the metadata and the indexes of the last messages

// Of a chunk of a frame: of the whole frame.
std::size_t size_with_rest(const Item& item) {
  const std::size_t size = payload_bytes(item);
  const auto* message = std::get_if<Message>(&item);
  if (message == nullptr || message->topic != wire::TopicId::frames) return size;
  const auto head = wire::peek_frame_head(message->bytes);
  return head ? size * std::max(head.value().chunks, 1u) : size;
}

}  // namespace

std::string part_path(const std::string& path, std::size_t number) {
  fs::path name(path);
  const std::string file = fmt::format("{}-{:04}{}", name.stem().string(), number, name.extension().string());
  return name.replace_filename(file).string();
}

wire::Result<std::unique_ptr<Destination>> SplitDestination::create(const Options& options, MakeReport make_report) {
  // Parts of an earlier, longer recording must not be taken for parts of this one.
  for (std::size_t i = 0; options.force && fs::exists(part_path(options.file, i)); ++i) {
    std::error_code ignored;
    fs::remove(part_path(options.file, i), ignored);
  }
  std::unique_ptr<SplitDestination> destination(new SplitDestination(options, std::move(make_report)));
  if (auto opened = destination->open_part(); !opened) return opened.error();
  return std::unique_ptr<Destination>(std::move(destination));
}

mcap::Status SplitDestination::write(const Item& item) {
  if (is_time_to_split(item)) {
    if (auto completed = complete_part(false); !completed) return to_mcap(completed);
    if (auto opened = open_part(); !opened) return to_mcap(opened);
  }
  repeats_.note(item);
  const auto* message = std::get_if<Message>(&item);
  if (message != nullptr) content_.note(message->topic, message->log_time, message->bytes);
  return part_->file().write(item);
}

// Not before the first frame: what a part begins with may be larger than a part should be.
bool SplitDestination::is_time_to_split(const Item& item) const {
  const bool has_frames = content_.frames().frames() > 0;
  const bool within_frame = content_.frames().in_progress() > 0;
  return has_frames && !within_frame &&
         part_->file().bytes_when_closed() + size_with_rest(item) + room > *options_.split_size;
}

wire::Result<void> SplitDestination::open_part() {
  auto file = OpenFile::create(part_path(options_.file, paths_.size()), options_.compression, options_.force);
  if (!file) return file.error();
  part_.emplace(std::move(file).value());
  content_ = {};
  for (const Item* item : repeats_.items()) {
    if (auto status = part_->file().write(*item); !status) return wire::Error{status.message()};
  }
  return {};
}

wire::Result<void> SplitDestination::complete_part(bool last) {
  Report report = reports_.divide(make_report_(), content_, last);
  report.file = part_->path();
  if (auto completed = part_->complete(report); !completed) return completed;
  reports_.accept();
  paths_.push_back(part_->path());
  bytes_ += report.bytes;
  messages_ += report.messages;
  part_.reset();
  return {};
}

wire::Result<Report> SplitDestination::complete() {
  if (part_) {
    if (auto completed = complete_part(true); !completed) return completed.error();
  }
  Report report = make_report_();
  report.parts = paths_;
  report.bytes = bytes_;
  report.messages = messages_;
  return report;
}

wire::Result<std::vector<wire::FrameHead>> SplitDestination::cut_back() {
  if (!part_) return std::vector<wire::FrameHead>{};
  if (!part_->file().has_chunks() && !paths_.empty()) return drop_part();
  auto cut = part_->cut_back(make_report_());
  if (!cut) return cut;
  for (const wire::FrameHead& head : cut.value()) content_.lose(head);
  return cut;
}

// The newest part has no whole chunk: the recording ends with the one before it.
std::vector<wire::FrameHead> SplitDestination::drop_part() {
  std::vector<wire::FrameHead> heads = part_->file().frames_before_first_chunk();
  std::error_code ignored;
  fs::remove(part_->path(), ignored);
  part_.reset();
  return heads;
}

}  // namespace flexcast::record
