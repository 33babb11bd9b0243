// DomainCensus: who is on a domain, whatever they speak: participants and the topics they write.
#pragma once

#include <string>
#include <vector>

#include "idl/wire/participant.h"

namespace flexcast::wire {

struct RemoteWriter {
  Guid participant{};
  std::string topic;  // "flexcast/status"
  std::string type;   // "flexcast::Status"
};

class DomainCensus {
 public:
  static Result<DomainCensus> create(const Participant& participant);

  // Those known now, this process' own left out. Discovery takes up to a second or two.
  std::vector<Guid> participants() const;
  std::vector<RemoteWriter> writers() const;

 private:
  DomainCensus(Guid own, Entity participants, Entity writers)
      : own_(own), participants_(std::move(participants)), writers_(std::move(writers)) {}

  Guid own_;
  Entity participants_;  // readers of Cyclone's own topics
  Entity writers_;
};

}  // namespace flexcast::wire
