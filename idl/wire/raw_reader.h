// RawReader: takes samples as the bytes that came off the wire, for the recorder. raw_reader.cpp is the only file that
// uses Cyclone's internal (not stable) serdata interface.
#pragma once

#include <cstddef>
#include <functional>
#include <span>

#include "idl/wire/reader.h"
#include "idl/wire/sample_bytes.h"

namespace flexcast::wire {

struct RawSample {
  std::span<const std::byte> bytes;  // CDR with its 4-byte header; valid during the call only
  SampleBytes shared;                // the same bytes; a copy keeps them
  SampleInfo info;
  std::int64_t receive_time = 0;  // ns since 1970, when it was taken
};

class RawReader : public UntypedReader {
 public:
  // Any topic of the table; the QoS is usually the row's for recorders (frames: frames_recorder_qos).
  static Result<RawReader> create(const Participant& participant, const TopicRow& row, const Qos& qos);
  static Result<RawReader> create(const Participant& participant, const TopicRow& row) {
    return create(participant, row, row.recorder);
  }

  const TopicRow& row() const { return *row_; }

  // Calls back with up to `most` samples in the order of arrival within an instance; returns how many. Samples without
  // data (disposed instances) come with info.valid == false and their serialised keys.
  Result<std::size_t> take_raw(const std::function<void(const RawSample&)>& receive, std::size_t most = 64) const;

 private:
  RawReader(Endpoint endpoint, const TopicRow& row) : UntypedReader(std::move(endpoint)), row_(&row) {}
  const TopicRow* row_;
};

}  // namespace flexcast::wire
