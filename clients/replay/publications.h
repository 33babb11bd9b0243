// Publications: the writers of a replay's topics. Decodes what was recorded, restamps it and writes it; what cannot be
// written is told once.
#pragma once

#include <cstdint>
#include <functional>
#include <set>
#include <string>
#include <utility>

#include "clients/recording/recording.h"
#include "clients/replay/restamp.h"
#include "idl/wire/writer.h"

namespace flexcast::replay {

class Publications {
 public:
  using Say = std::function<void(const std::string&)>;  // a line for people

  // `frame_bytes`, of the largest frame: decides how many of them the writer keeps for readers that lag.
  static wire::Result<Publications> create(const wire::Participant& participant, std::size_t frame_bytes, Say say);

  // A message of one of the topics scene, topology, parameters, frames and events; others are passed over. Frames are
  // not even decoded when nobody reads them.
  void publish(const recording::RecordedMessage& message, const Stamp& stamp);
  void publish(const flexcast_Status& status);

  wire::Matched frame_readers() const { return writers_.frames.matched(); }

  // Says goodbye: every instance that was written is gone.
  void dispose(const std::string& world);

 private:
  struct Writers {
    wire::Writer<flexcast_SceneInfo> scene;
    wire::Writer<flexcast_Topology> topology;
    wire::Writer<flexcast_ParameterSet> parameters;
    wire::Writer<flexcast_ParticleFrame> frames;
    wire::Writer<flexcast_Status> status;
    wire::Writer<flexcast_Event> events;
  };

  Publications(Writers writers, Say say) : writers_(std::move(writers)), say_(std::move(say)) {}
  template <class T>
  void publish_as(const wire::Writer<T>& writer, const recording::RecordedMessage& message, const Stamp& stamp);
  void note(const flexcast_SceneInfo& scene);
  void note(const flexcast_Topology& topology);
  void note(const flexcast_ParticleFrame& frame);
  template <class T>
  void note(const T&) {}
  template <class Gone>
  void dispose_topology(const std::string& world, Gone gone);
  void complain(const wire::Error& error, const char* topic);

  Writers writers_;
  Say say_;
  std::set<std::uint32_t> frame_chunks_;                        // ever written
  std::set<std::pair<std::uint32_t, std::uint32_t>> topology_;  // body and chunk of what is there
  std::set<std::string> complaints_;                            // what was said
};

}  // namespace flexcast::replay
