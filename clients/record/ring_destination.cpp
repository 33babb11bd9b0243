#include "clients/record/ring_destination.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "clients/record/part_report.h"
#include "clients/record/ring_parts.h"

namespace flexcast::record {
namespace {

namespace fs = std::filesystem;

constexpr int parts_in_length = 8;
constexpr std::int64_t shortest_part = 250'000'000;  // ns

bool is_ageing(const Message* message) {
  return message && (message->topic == wire::TopicId::frames || message->topic == wire::TopicId::status);
}

}  // namespace

wire::Result<std::unique_ptr<Destination>> RingDestination::create(const Options& options, MakeReport make_report) {
  if (options.force) remove_ring(options.file);
  std::error_code error;
  fs::create_directory(ring_folder(options.file), error);
  if (error) return wire::Error{"cannot create " + ring_folder(options.file) + ": " + error.message()};
  auto base = OpenFile::create(ring_base(options.file), options.compression, options.force);
  if (!base) return base.error();
  const mcap::TextPairs ring{{"seconds", fmt::format("{}", *options.keep_last)}};
  if (auto status = base.value().file().add_metadata(ring_metadata, ring); !status)
    return wire::Error{status.message()};
  return std::unique_ptr<Destination>(new RingDestination(options, std::move(make_report), std::move(base).value()));
}

RingDestination::RingDestination(const Options& options, MakeReport make_report, OpenFile base)
    : options_(options),
      make_report_(std::move(make_report)),
      length_(static_cast<std::int64_t>(*options.keep_last * 1e9)),
      part_length_(std::max(length_ / parts_in_length, shortest_part)),
      base_(std::move(base)) {}

mcap::Status RingDestination::write(const Item& item) {
  const auto* message = std::get_if<Message>(&item);
  // Of what is known of frames: it goes with the frames of its time.
  if (std::holds_alternative<AccountNote>(item) && part_) return part_->file().write(item);
  if (!is_ageing(message)) return base_.file().write(item);
  // Frames keep the file's thread busy: nobody else looks how old the chunk of the base is.
  if (auto status = base_.file().flush_if_older(message->log_time); !status) return status;
  if (!part_ || message->log_time - part_begin_ >= part_length_) {
    if (auto begun = next_part(message->log_time); !begun) return to_mcap(begun);
  }
  parts_.back().newest = std::max(parts_.back().newest, message->log_time);
  return part_->file().write(item);
}

wire::Result<void> RingDestination::next_part(std::int64_t log_time) {
  if (auto closed = close_part(); !closed) return closed;
  remove_old(log_time);
  auto file = OpenFile::create(ring_part(options_.file, next_number_), options_.compression, options_.force);
  if (!file) return file.error();
  part_.emplace(std::move(file).value());
  part_begin_ = log_time;
  parts_.push_back({next_number_++, log_time, 0});
  return {};
}

wire::Result<void> RingDestination::close_part() {
  if (!part_) return {};
  if (auto left = part_->leave(); !left) return left;
  parts_.back().bytes = part_->file().bytes_written();
  part_.reset();
  return {};
}

void RingDestination::remove_old(std::int64_t newest) {
  for (; !parts_.empty() && parts_.front().newest < newest - length_; parts_.pop_front()) {
    std::error_code ignored;
    fs::remove(ring_part(options_.file, parts_.front().number), ignored);
  }
}

mcap::Status RingDestination::flush_if_older(std::int64_t now) {
  if (auto status = base_.file().flush_if_older(now); !status || !part_) return status;
  return part_->file().flush_if_older(now);
}

std::uint64_t RingDestination::bytes_written() const {
  std::uint64_t bytes = base_.file().bytes_written() + (part_ ? part_->file().bytes_written() : 0);
  for (const Part& part : parts_) bytes += part.bytes;
  return bytes;
}

wire::Result<Report> RingDestination::complete() {
  if (!cut_) {
    if (auto closed = close_part(); !closed) return closed.error();
    if (auto left = base_.leave(); !left) return left.error();
  }
  // The parts stay when they cannot be put together: --recover can do it when there is room.
  auto report = join_ring(options_.file,
                          [this](const ContentLedger& content) { return restrict_report(make_report_(), content); });
  if (report) remove_ring(options_.file);
  return report;
}

// What the files hold is put together as it is, without the parts' ends.
wire::Result<std::vector<wire::FrameHead>> RingDestination::cut_back() {
  if (std::exchange(cut_, true)) {
    return wire::Error{ring_folder(options_.file) + " holds what was recorded: make room and --recover " +
                       options_.file};
  }
  return std::vector<wire::FrameHead>{};
}

}  // namespace flexcast::record
