// SingleDestination: the whole recording in one file.
#pragma once

#include <utility>

#include "clients/record/destination.h"
#include "clients/record/open_file.h"

namespace flexcast::record {

class SingleDestination final : public Destination {
 public:
  SingleDestination(OpenFile file, MakeReport make_report)
      : file_(std::move(file)), make_report_(std::move(make_report)) {}

  mcap::Status write(const Item& item) override { return file_.file().write(item); }
  mcap::Status flush_if_older(std::int64_t now) override { return file_.file().flush_if_older(now); }
  std::uint64_t bytes_written() const override { return file_.file().bytes_written(); }

  wire::Result<Report> complete() override {
    Report report = make_report_();
    if (auto completed = file_.complete(report); !completed) return completed.error();
    return report;
  }
  wire::Result<std::vector<wire::FrameHead>> cut_back() override { return file_.cut_back(make_report_()); }

 private:
  OpenFile file_;
  MakeReport make_report_;
};

}  // namespace flexcast::record
