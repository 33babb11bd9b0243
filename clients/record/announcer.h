// Announcer: tells the domain, on flexcast/recorders, what this recorder is doing.
#pragma once

#include <chrono>
#include <optional>
#include <string>

#include "clients/record/receiver.h"
#include "idl/wire/writer.h"

namespace flexcast::record {

class Announcer {
 public:
  static wire::Result<Announcer> create(const wire::Participant& participant, const std::string& world,
                                        const std::string& file);

  // Publishes at changes of the state, and once a second. `bytes`: of the file.
  void announce(flexcast_RecorderState state, const Progress& progress, std::uint64_t bytes,
                const std::string& text = "");

 private:
  Announcer(wire::Writer<flexcast_RecorderInfo> writer, const std::string& world, const std::string& file);

  wire::Writer<flexcast_RecorderInfo> writer_;
  wire::Owned<flexcast_RecorderInfo> info_;
  std::optional<std::chrono::steady_clock::time_point> announced_;
};

}  // namespace flexcast::record
