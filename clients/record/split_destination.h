// SplitDestination: a recording in several files of at most a given size, RUN-0000.mcap, RUN-0001.mcap, ... Each is a
// complete recording by itself. A frame is never divided among two.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "clients/record/destination.h"
#include "clients/record/open_file.h"
#include "clients/record/part_report.h"
#include "clients/record/repeats.h"

namespace flexcast::record {

class SplitDestination final : public Destination {
 public:
  // With --split-size.
  static wire::Result<std::unique_ptr<Destination>> create(const Options& options, MakeReport make_report);

  mcap::Status write(const Item& item) override;
  mcap::Status flush_if_older(std::int64_t now) override {
    return part_ ? part_->file().flush_if_older(now) : mcap::Status();
  }
  std::uint64_t bytes_written() const override { return bytes_ + (part_ ? part_->file().bytes_written() : 0); }

  wire::Result<Report> complete() override;
  wire::Result<std::vector<wire::FrameHead>> cut_back() override;

 private:
  SplitDestination(const Options& options, MakeReport make_report)
      : options_(options), make_report_(std::move(make_report)) {}
  bool is_time_to_split(const Item& item) const;
  wire::Result<void> open_part();
  wire::Result<void> complete_part(bool last);
  std::vector<wire::FrameHead> drop_part();

  const Options options_;
  const MakeReport make_report_;
  std::optional<OpenFile> part_;
  ContentLedger content_;  // of the part
  Repeats repeats_;
  PartReports reports_;
  std::vector<std::string> paths_;  // of complete parts
  std::uint64_t bytes_ = 0;         // of those
  std::uint64_t messages_ = 0;
};

// "run.mcap", 3 -> "run-0003.mcap"
std::string part_path(const std::string& path, std::size_t number);

}  // namespace flexcast::record
