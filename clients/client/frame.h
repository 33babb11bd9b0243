// Frames as a client sees them: whole (chunks put together) and in double precision whatever was streamed.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <utility>
#include <vector>

#include "idl/wire/types.h"

namespace flexcast::client {

struct Frame {
  std::uint64_t run_id = 0;
  std::uint64_t frame = 0;  // 0, 1, 2, ... within a run
  std::uint64_t step = 0;
  double time = 0;  // s
  std::uint64_t parameter_revision = 0;
  std::uint64_t topology_revision = 0;
  std::uint64_t state_hash = 0;      // over the state in double precision, whatever was streamed
  std::uint32_t particles = 0;       // of the world
  std::array<double, 6> bounds{};    // min x, y, z, max x, y, z, m
  std::vector<double> positions{};   // m, flat: x0, y0, z0, x1, ...; empty if not streamed
  std::vector<double> velocities{};  // m/s, flat
  std::vector<double> stretch{};     // one number a particle
  std::vector<double> stress{};      // Pa, one number a particle

  std::array<double, 3> position(std::size_t particle) const { return triple(positions, particle); }
  std::array<double, 3> velocity(std::size_t particle) const { return triple(velocities, particle); }

 private:
  static std::array<double, 3> triple(const std::vector<double>& flat, std::size_t i) {
    return {flat.at(3 * i), flat.at(3 * i + 1), flat.at(3 * i + 2)};
  }
};

// Puts the chunks of ONE world's frames together.
class FrameAssembler {
 public:
  // Takes one sample; returns the frame it completed. Frames that are not newer than the last one of their run, and
  // samples that contradict themselves, are ignored.
  std::optional<Frame> add(const flexcast_ParticleFrame& sample);

  // Frames of the present run that were left out between those returned.
  std::uint64_t missed() const { return missed_; }

 private:
  using Key = std::pair<std::uint64_t, std::uint64_t>;  // run, frame
  struct Partial {
    Frame frame;
    std::vector<bool> have;  // by chunk
    std::uint32_t missing = 0;
  };
  std::optional<Frame> finish(std::map<Key, Partial>::iterator partial);

  std::map<Key, Partial> partials_;
  std::optional<Key> last_;
  std::uint64_t missed_ = 0;
};

}  // namespace flexcast::client
