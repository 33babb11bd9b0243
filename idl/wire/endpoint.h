// What readers and writers have in common: a topic, a handle, and the peers they are matched with.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "idl/wire/entity.h"
#include "idl/wire/participant.h"
#include "idl/wire/topics.h"

namespace flexcast::wire {

struct Matched {
  std::uint32_t current = 0;  // peers now
  std::uint32_t total = 0;    // peers ever: grows with every new one
};

// Creates topic and endpoint in one go; the topic goes with the endpoint.
class Endpoint {
 public:
  EntityHandle handle() const { return entity_.handle(); }

 protected:
  enum class Kind { reader, writer };
  Endpoint(Entity topic, Entity entity) : topic_(std::move(topic)), entity_(std::move(entity)) {}
  static Result<Endpoint> create(Kind kind, const Participant& participant, const TopicRow& row, const Qos& qos);

 private:
  Entity topic_;  // before entity_: a topic in use cannot be deleted
  Entity entity_;
};

}  // namespace flexcast::wire
