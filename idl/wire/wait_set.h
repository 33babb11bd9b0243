// WaitSet: one thread waits for several readers, writers and its own wake-up call. Nothing of flexcast runs on the
// threads of Cyclone.
#pragma once

#include <chrono>
#include <vector>

#include "idl/wire/reader.h"
#include "idl/wire/writer.h"

namespace flexcast::wire {

// Wakes a waiting thread up. Stays triggered until reset.
class GuardCondition {
 public:
  static Result<GuardCondition> create(const Participant& participant);

  void trigger() const;
  void reset() const;
  EntityHandle handle() const { return entity_.handle(); }

 private:
  explicit GuardCondition(Entity entity) : entity_(std::move(entity)) {}
  Entity entity_;
};

// Everything attached must outlive the wait set. A set with nothing attached does not wait.
class WaitSet {
 public:
  static Result<WaitSet> create(const Participant& participant);

  Result<void> attach(const GuardCondition& guard);       // wakes while triggered
  Result<void> attach_data(const UntypedReader& reader);  // wakes while there is something to take
  // Wake once for every change of the number of peers: reading matched() rearms.
  Result<void> attach_matched(const UntypedReader& reader);
  Result<void> attach_matched(const UntypedWriter& writer);

  // True when something woke it, false on timeout. Zero polls; at most a year.
  bool wait(std::chrono::nanoseconds timeout) const;

 private:
  explicit WaitSet(Entity entity) : entity_(std::move(entity)) {}
  Result<void> attach_handle(EntityHandle handle);
  std::vector<Entity> conditions_;
  Entity entity_;  // after conditions_: goes first
};

}  // namespace flexcast::wire
