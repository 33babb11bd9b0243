#include "clients/export/geometry.h"

#include <gtest/gtest.h>

#include "tests/support/recording_maker.h"

namespace flexcast::exporting {
namespace {

using flexcast::test::RecordingMaker;

class GeometryTest : public testing::Test {
 protected:
  // The parts with these ordinals of a recording that begins with scene (0) and topology (1 and 2).
  wire::Result<Geometry> read(std::vector<std::uint64_t> ordinals, std::size_t points = 6) {
    auto recording = recording::Recording::open(path_).value();
    return read_geometry(recording, ordinals, points);
  }

  const flexcast::test::TemporaryFolder folder_;
  const std::string path_ = folder_.path("run.mcap");
};

TEST_F(GeometryTest, CellsAreTetrahedraAndSpringsWithTheBodyTheyBelongTo) {
  RecordingMaker maker(path_);
  maker.add_run(100, 1);
  maker.close();
  const Geometry geometry = read({0, 1, 2}).value();
  EXPECT_EQ(geometry.points, 6U);
  EXPECT_EQ(geometry.connectivity, (std::vector<std::int64_t>{0, 1, 2, 3, 4, 5}));
  EXPECT_EQ(geometry.offsets, (std::vector<std::int64_t>{4, 6}));
  EXPECT_EQ(geometry.types, (std::vector<std::uint8_t>{10, 3}));
  EXPECT_EQ(geometry.bodies, (std::vector<std::uint32_t>{0, 1}));
}

TEST_F(GeometryTest, AParticleThatTheFramesDoNotHaveIsAnError) {
  RecordingMaker maker(path_);
  maker.add_run(100, 1);
  maker.close();
  const auto geometry = read({1, 2}, 5);
  ASSERT_FALSE(geometry.ok());
  EXPECT_EQ(geometry.error().message, path_ + ": the topology names particle 5 of a world of 5");
}

TEST_F(GeometryTest, AMissingPartIsAnError) {
  RecordingMaker maker(path_);
  wire::Owned<flexcast_Topology> part;
  part->chunks = 2;
  wire::copy(part->springs, std::array<std::uint32_t, 2>{0, 1});
  maker.add(*part);
  maker.close();
  const auto geometry = read({0});
  ASSERT_FALSE(geometry.ok());
  EXPECT_EQ(geometry.error().message, path_ + ": 1 part(s) of the topology of body 0 were not recorded");
}

}  // namespace
}  // namespace flexcast::exporting
