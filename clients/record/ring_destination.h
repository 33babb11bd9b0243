// RingDestination: only the newest seconds of frames and statuses survive, everything else is kept. While it records
// there are short parts in RUN.mcap.parts (ring_parts.h); at the end they become RUN.mcap.
#pragma once

#include <cstdint>
#include <deque>
#include <memory>
#include <optional>

#include "clients/record/destination.h"
#include "clients/record/open_file.h"

namespace flexcast::record {

class RingDestination final : public Destination {
 public:
  // With --keep-last.
  static wire::Result<std::unique_ptr<Destination>> create(const Options& options, MakeReport make_report);

  mcap::Status write(const Item& item) override;
  mcap::Status flush_if_older(std::int64_t now) override;
  std::uint64_t bytes_written() const override;  // what is on the disk now

  wire::Result<Report> complete() override;
  wire::Result<std::vector<wire::FrameHead>> cut_back() override;

 private:
  struct Part {
    std::uint64_t number = 0;
    std::int64_t newest = 0;  // log time, ns since 1970
    std::uint64_t bytes = 0;
  };
  RingDestination(const Options& options, MakeReport make_report, OpenFile base);
  wire::Result<void> next_part(std::int64_t log_time);
  wire::Result<void> close_part();
  void remove_old(std::int64_t newest);

  const Options options_;
  const MakeReport make_report_;
  const std::int64_t length_;       // ns that are kept
  const std::int64_t part_length_;  // ns
  OpenFile base_;
  std::optional<OpenFile> part_;  // the newest
  std::int64_t part_begin_ = 0;   // log time
  std::deque<Part> parts_;        // the newest one too
  std::uint64_t next_number_ = 0;
  bool cut_ = false;
};

}  // namespace flexcast::record
