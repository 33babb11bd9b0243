#include "idl/wire/frame_size.h"

#include "idl/wire/fill.h"

namespace flexcast::wire {

FrameSize frame_size(const flexcast_SceneInfo& scene) {
  const std::string_view precision = text(scene.precision);
  std::size_t bytes_per_particle = 0;
  for (const std::string& field : strings(scene.fields)) {
    if (field == "positions") bytes_per_particle += precision == "float64" ? 24 : precision == "quantized16" ? 6 : 12;
    if (field == "velocities") bytes_per_particle += precision == "float64" ? 24 : 12;
    if (field == "stretch" || field == "stress") bytes_per_particle += 4;
  }
  const std::size_t bytes = scene.particles * bytes_per_particle;
  const std::size_t chunks = (bytes + largest_sample - 1) / largest_sample;
  return {bytes, chunks > 0 ? static_cast<std::uint32_t>(chunks) : 1};
}

}  // namespace flexcast::wire
