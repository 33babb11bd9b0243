// Reader<T>: takes samples of one topic. Every call may be made from any thread.
#pragma once

#include <chrono>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "idl/wire/endpoint.h"
#include "idl/wire/owned.h"

namespace flexcast::wire {

enum class InstanceState { alive, disposed, no_writers };

struct SampleInfo {
  bool valid = false;  // false: no data, only the keys; something happened to the instance
  InstanceState state = InstanceState::alive;
  std::int64_t source_time = 0;  // ns since 1970, when it was written
  std::uint64_t instance = 0;    // one number for each key, local to this process
  std::uint64_t writer = 0;      // who wrote it, local to this process
};

class UntypedReader : public Endpoint {
 public:
  Matched matched() const;
  std::vector<Guid> matched_participants() const;

  // The process (participant) of a SampleInfo's writer; none when that writer is gone.
  std::optional<Guid> participant_of(std::uint64_t writer) const;

  // Waits until there is something to take; false on timeout.
  bool wait(std::chrono::nanoseconds timeout) const;

 protected:
  explicit UntypedReader(Endpoint endpoint) : Endpoint(std::move(endpoint)) {}
  static Result<Endpoint> create(const Participant& participant, const TopicRow& row, const Qos& qos) {
    return Endpoint::create(Kind::reader, participant, row, qos);
  }
  // Fills `samples` (pointers to structs, or null for a loan) and `infos` with up to infos.size(); returns the count.
  Result<std::size_t> take_samples(void** samples, std::vector<SampleInfo>& infos) const;
};

// Samples on loan from the reader, given back on destruction: must not outlive the reader.
class UntypedLoan {
 public:
  UntypedLoan(EntityHandle reader, std::vector<void*> samples, std::vector<SampleInfo> infos)
      : reader_(reader), samples_(std::move(samples)), infos_(std::move(infos)) {}
  UntypedLoan(UntypedLoan&& other) noexcept = default;
  UntypedLoan& operator=(UntypedLoan&& other) = delete;
  ~UntypedLoan();

  std::size_t size() const { return infos_.size(); }
  bool empty() const { return infos_.empty(); }
  const SampleInfo& info(std::size_t i) const { return infos_[i]; }

 protected:
  const void* sample(std::size_t i) const { return samples_[i]; }

 private:
  EntityHandle reader_;
  std::vector<void*> samples_;
  std::vector<SampleInfo> infos_;
};

// for (auto [data, info] : samples) if (info.valid) ...
template <class T>
class Samples : public UntypedLoan {
 public:
  using UntypedLoan::UntypedLoan;

  struct Item {
    const T& data;
    const SampleInfo& info;
  };
  Item operator[](std::size_t i) const { return {*static_cast<const T*>(sample(i)), info(i)}; }

  class Iterator {
   public:
    Iterator(const Samples* samples, std::size_t i) : samples_(samples), i_(i) {}
    Item operator*() const { return (*samples_)[i_]; }
    Iterator& operator++() { return ++i_, *this; }
    bool operator!=(const Iterator& other) const { return i_ != other.i_; }

   private:
    const Samples* samples_;
    std::size_t i_;
  };
  Iterator begin() const { return {this, 0}; }
  Iterator end() const { return {this, size()}; }
};

// A sample that outlives its reader.
template <class T>
struct OwnedSample {
  Owned<T> data;
  SampleInfo info;
};

template <class T>
class Reader : public UntypedReader {
 public:
  // The topic is the type's row of the table; the QoS the row's for monitors (newest wins) unless another is given.
  static Result<Reader> create(const Participant& participant, const Qos& qos = topic_of<T>().monitor) {
    auto endpoint = UntypedReader::create(participant, topic_of<T>(), qos);
    if (!endpoint) return endpoint.error();
    return Reader(std::move(endpoint).value());
  }

  // Takes up to `most` samples without copying them twice: on loan. Empty when there is none. Every call on one reader
  // must ask for the same number: Cyclone 0.10.2 fills as many pointers as its largest loan so far had.
  Result<Samples<T>> take(std::size_t most = 64) const {
    std::vector<void*> samples(most, nullptr);
    std::vector<SampleInfo> infos(most);
    auto count = take_samples(samples.data(), infos);
    if (!count) return count.error();
    return Samples<T>(handle(), std::move(samples), std::move(infos));
  }

  // The same as structs of one's own.
  Result<std::vector<OwnedSample<T>>> take_owned(std::size_t most = 64) const {
    std::vector<OwnedSample<T>> taken(most);
    std::vector<void*> samples(most);
    std::vector<SampleInfo> infos(most);
    for (std::size_t i = 0; i < most; ++i) samples[i] = &*taken[i].data;
    auto count = take_samples(samples.data(), infos);
    if (!count) return count.error();
    taken.resize(count.value());
    for (std::size_t i = 0; i < taken.size(); ++i) taken[i].info = infos[i];
    return taken;
  }

 private:
  explicit Reader(Endpoint endpoint) : UntypedReader(std::move(endpoint)) {}
};

}  // namespace flexcast::wire
