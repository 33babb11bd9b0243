// Entity: owns one DDS entity handle (participant, reader, writer, condition, ...) and deletes it.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <utility>

#include "idl/wire/result.h"

namespace flexcast::wire {

using EntityHandle = std::int32_t;          // dds_entity_t
using Guid = std::array<std::uint8_t, 16>;  // of a participant or an endpoint, unique on the network

// Move-only; deletes the handle with everything below it.
class Entity {
 public:
  Entity() = default;
  explicit Entity(EntityHandle handle) : handle_(handle) {}
  Entity(Entity&& other) noexcept : handle_(std::exchange(other.handle_, 0)) {}
  Entity& operator=(Entity&& other) noexcept {
    std::swap(handle_, other.handle_);
    return *this;
  }
  ~Entity();

  EntityHandle handle() const { return handle_; }

 private:
  EntityHandle handle_ = 0;
};

// "WHAT: Cyclone's text for the code".
Error dds_error(std::string_view what, std::int32_t code);

// An owned entity from what a dds_create_... call returned.
Result<Entity> own_entity(std::string_view what, EntityHandle handle);

}  // namespace flexcast::wire
