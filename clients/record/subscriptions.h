// Subscriptions: the readers of a recording, one raw reader for each recorded topic and one that decodes the scene.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "idl/wire/raw_reader.h"
#include "idl/wire/reader.h"

namespace flexcast::record {

class Subscriptions {
 public:
  // Waits a moment for the scene of `world`, whose size decides how many frames the reader may hold.
  static wire::Result<Subscriptions> create(const wire::Participant& participant, const std::string& world);

  // In the order of the topic table: what describes the world comes before its frames.
  std::span<const wire::RawReader> raw() const { return raw_; }
  const wire::Reader<flexcast_SceneInfo>& scenes() const { return scenes_; }

  // Whether every topic that a server writes is connected with this one.
  bool is_matched(const wire::Guid& server) const;

 private:
  Subscriptions(std::vector<wire::RawReader> raw, wire::Reader<flexcast_SceneInfo> scenes)
      : raw_(std::move(raw)), scenes_(std::move(scenes)) {}

  std::vector<wire::RawReader> raw_;
  wire::Reader<flexcast_SceneInfo> scenes_;
};

}  // namespace flexcast::record
