// Writer<T>: writes one topic. Every call may be made from any thread.
#pragma once

#include <utility>

#include "idl/wire/endpoint.h"

namespace flexcast::wire {

class UntypedWriter : public Endpoint {
 public:
  // Readers of this writer, in this and other processes. dds_write serialises also when there is none: ask first where
  // samples are large and not transient-local.
  Matched matched() const;

  // The processes (participants) those readers belong to.
  std::vector<Guid> matched_participants() const;

 protected:
  explicit UntypedWriter(Endpoint endpoint) : Endpoint(std::move(endpoint)) {}
  static Result<Endpoint> create(const Participant& participant, const TopicRow& row, const Qos& qos) {
    return Endpoint::create(Kind::writer, participant, row, qos);
  }
  Result<void> write_sample(const void* sample) const;
  Result<void> dispose_sample(const void* sample) const;
};

template <class T>
class Writer : public UntypedWriter {
 public:
  // The topic is the type's row of the table, the QoS the row's unless another is given (frames_writer_qos).
  static Result<Writer> create(const Participant& participant, const Qos& qos = topic_of<T>().writer) {
    auto endpoint = UntypedWriter::create(participant, topic_of<T>(), qos);
    if (!endpoint) return endpoint.error();
    return Writer(std::move(endpoint).value());
  }

  // Copies (serialises) the sample before it returns. A null string is written as "".
  Result<void> write(const T& sample) const { return write_sample(&sample); }

  // Says that the instance is gone; only the keys of `sample` matter.
  Result<void> dispose(const T& sample) const { return dispose_sample(&sample); }

 private:
  explicit Writer(Endpoint endpoint) : UntypedWriter(std::move(endpoint)) {}
};

}  // namespace flexcast::wire
