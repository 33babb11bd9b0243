// Publications: the writers of a world's topics. Converts what it is given and writes it; what cannot be written is
// logged, once a topic.
#pragma once

#include <cstdint>
#include <set>
#include <string>
#include <vector>

#include "idl/wire/writer.h"
#include "server/convert/frames.h"
#include "server/convert/notice_types.h"
#include "server/convert/status_types.h"
#include "server/frame_ring.h"

namespace flexcast::server {

class Publications {
 public:
  // From now on this process keeps the memory that it frees: see wire/memory.h. `frames`: decides how many of them the
  // writer keeps for readers that lag.
  static wire::Result<Publications> create(const wire::Participant& participant, std::string world,
                                           std::uint64_t server_id, const wire::Qos& frames);

  const std::string& world() const { return world_; }
  std::uint64_t server_id() const { return server_id_; }

  void publish(const Notice& notice);
  void publish(const WorldStatus& status, const DeliveryStatus& delivery);
  // Nothing is done when nobody reads. Returns whether it was written to somebody, as a whole.
  bool publish(const Frame& frame);

  wire::Matched frame_readers() const { return writers_.frames.matched(); }

  // Says goodbye: every instance of this world is gone.
  void dispose();

 private:
  struct Writers {
    wire::Writer<flexcast_SceneInfo> scene;
    wire::Writer<flexcast_Topology> topology;
    wire::Writer<flexcast_ParameterSet> parameters;
    wire::Writer<flexcast_ParticleFrame> frames;
    wire::Writer<flexcast_Status> status;
    wire::Writer<flexcast_Event> events;
  };

  Publications(Writers writers, std::string world, std::uint64_t server_id);
  void publish_one(const RunStarted& run);
  void publish_one(const ParametersChanged& parameters);
  void publish_one(const Event& event);
  template <class T>
  bool write(const wire::Writer<T>& writer, const T& message);
  template <class T>
  void dispose(const wire::Writer<T>& writer, T& message);
  void dispose_topology(const std::vector<std::uint32_t>& still_there);

  Writers writers_;
  std::string world_;
  std::uint64_t server_id_;
  FrameMessage frame_message_;
  std::uint32_t most_frame_chunks_ = 0;         // ever written
  std::vector<std::uint32_t> topology_chunks_;  // written, of each body
  std::set<std::string> complaints_;            // what was logged
};

}  // namespace flexcast::server
