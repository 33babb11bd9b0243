// The size that the engine predicts for a frame is the size that Cyclone serialises.
#include <gtest/gtest.h>

#include "core/sim/frame_size.h"
#include "idl/wire/raw_reader.h"
#include "idl/wire/writer.h"
#include "server/convert/frames.h"
#include "tests/support/network.h"

namespace flexcast::server {
namespace {

Frame make_frame(std::int64_t particles, const StreamFormat& format) {
  Frame frame;
  frame.header.format = format;
  frame.particles = static_cast<std::uint32_t>(particles);
  const VecX positions = VecX::LinSpaced(3 * particles, 0.0, 1.0), scalars = VecX::Constant(particles, 0.5);
  fill_payload({positions, positions, scalars, scalars}, format, frame.payload);
  return frame;
}

class WireBytes : public testing::Test {
 protected:
  std::size_t measure(std::int64_t particles, const StreamFormat& format, const std::string& world) {
    const Frame frame = make_frame(particles, format);
    FrameMessage message(world);
    message.assign(frame);
    std::size_t bytes = 0;
    for (std::uint32_t chunk = 0; chunk < message.chunks(); ++chunk) {
      EXPECT_TRUE(writer_.write(message.chunk(chunk)).ok());
      EXPECT_TRUE(reader_.take_raw([&](const wire::RawSample& s) { bytes += s.bytes.size(); }).ok());
    }
    return bytes;
  }

  const wire::Participant participant_ = flexcast::test::join_test_domain();
  const wire::Writer<flexcast_ParticleFrame> writer_ =
      wire::Writer<flexcast_ParticleFrame>::create(participant_).value();
  const wire::RawReader reader_ = wire::RawReader::create(participant_, wire::topic(wire::TopicId::frames)).value();
};

TEST_F(WireBytes, ArePredictedForEveryFormatAndLengthOfName) {
  using enum StreamPrecision;
  std::vector<StreamFormat> formats;
  for (const StreamPrecision precision : {float32, float64, quantized16}) {
    formats.push_back({.precision = precision});
    formats.push_back({.velocities = true, .precision = precision});
    formats.push_back({.velocities = true, .precision = precision, .stretch = true, .stress = true});
    formats.push_back({.positions = false, .velocities = true, .precision = precision, .stress = true});
  }
  for (const std::string world : {"a", "four", "cloth-5"}) {
    for (std::size_t i = 0; i < formats.size(); ++i) {
      for (const std::int64_t particles : {1, 2, 7, 8}) {
        EXPECT_EQ(calc_wire_bytes(particles, formats[i], world.size()), measure(particles, formats[i], world))
            << world << ", format " << i << ", " << particles << " particles";
      }
    }
  }
}

TEST_F(WireBytes, ArePredictedForChunks) {
  const StreamFormat format{.velocities = true, .precision = StreamPrecision::quantized16, .stretch = true};
  EXPECT_EQ(calc_frame_size(100'003, format).chunks, 3u);
  EXPECT_EQ(calc_wire_bytes(100'003, format, 4), measure(100'003, format, "rope"));
}

}  // namespace
}  // namespace flexcast::server
