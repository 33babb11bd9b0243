// Announcer: tells the domain, on flexcast/recorders, what this recorder is doing. Its calls may come from any thread.
#pragma once

#include <chrono>
#include <memory>
#include <mutex>
#include <optional>
#include <string>

#include "clients/record/reception.h"
#include "idl/wire/owned.h"
#include "idl/wire/writer.h"

namespace flexcast::record {

class Announcer {
 public:
  // `id` "": one of its own.
  static wire::Result<std::unique_ptr<Announcer>> create(const wire::Participant& participant, const std::string& world,
                                                         const std::string& file, const std::string& id = "");

  std::string id() const;

  // Publishes at changes of the state, after acknowledge(), and once a second. `bytes`: of the file.
  void announce(flexcast_RecorderState state, const Progress& progress, std::uint64_t bytes,
                const std::string& text = "");

  // Publishes every time, if the server waits for this recorder.
  void announce_batch(const Progress& progress);

  // The newest command that was carried out: published with the next announcement.
  void acknowledge(std::uint64_t request_id);

  // Whether the server waits for this recorder: it then has a reader of these announcements. Asks again each time;
  // publishes when it has come to be so.
  bool update_lockstep(const wire::Guid& server, const Progress& progress);

 private:
  using Clock = std::chrono::steady_clock;
  Announcer(wire::Writer<flexcast_RecorderInfo> writer, const std::string& world, const std::string& file,
            const std::string& id);
  void write(const Progress& progress);

  wire::Writer<flexcast_RecorderInfo> writer_;
  mutable std::mutex mutex_;  // for those below
  wire::Owned<flexcast_RecorderInfo> info_;
  std::optional<Clock::time_point> announced_;
};

}  // namespace flexcast::record
