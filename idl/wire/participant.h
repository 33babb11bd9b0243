// Participant: this process's membership of one DDS domain.
#pragma once

#include <memory>
#include <string>

#include "idl/wire/entity.h"
#include "idl/wire/result.h"

namespace flexcast::wire {

inline constexpr int maximum_domain = 230;  // ports run out above

struct ParticipantOptions {
  int domain = 0;          // 0..230
  std::string profile{};   // loopback, lan, PATH.xml; "": see profile.h
  std::string security{};  // folder with an identity, see security.h; "": none, in the open
};

class Domain;

// Everything created from a participant (readers, writers, wait sets) must be destroyed before it. Several participants
// of one process may share a domain; they must ask for the same profile and the same identity.
class Participant {
 public:
  static Result<Participant> create(const ParticipantOptions& options);

  int domain() const;
  const std::string& profile() const;   // the name of the profile in force
  const std::string& security() const;  // the folder of the identity, "": none
  Guid guid() const;
  EntityHandle handle() const { return entity_.handle(); }

 private:
  Participant(std::shared_ptr<Domain> domain, Entity entity);

  std::shared_ptr<Domain> domain_;  // shared: the last participant of the process closes the domain; after entity_
  Entity entity_;
};

}  // namespace flexcast::wire
