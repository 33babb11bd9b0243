#include "clients/web/point_cloud.h"

#include <gtest/gtest.h>

#include <cstring>

namespace flexcast::web {
namespace {

// Reads little-endian XCDR1.
class Cdr {
 public:
  explicit Cdr(std::vector<std::byte> bytes) : bytes_(std::move(bytes)) {}
  template <class T>
  T get() {
    at_ += (sizeof(T) - (at_ - 4) % sizeof(T)) % sizeof(T);
    T value{};
    std::memcpy(&value, bytes_.data() + at_, sizeof value);
    at_ += sizeof value;
    return value;
  }
  std::string text() {
    const auto length = get<std::uint32_t>();
    std::string value(reinterpret_cast<const char*>(bytes_.data()) + at_, length - 1);
    at_ += length;
    return value;
  }
  bool at_end() const { return at_ == bytes_.size(); }

 private:
  std::vector<std::byte> bytes_;
  std::size_t at_ = 4;
};

TEST(PointCloud, EveryParticleIsAPointWithSpeedAndStress) {
  const client::Frame frame{
      .particles = 2, .positions = {1, 2, 3, 4, 5, 6}, .velocities = {3, 4, 0, 0, 0, 0}, .stress = {7, 8}};
  Cdr cdr(make_point_cloud(frame, 5'000'000'006));
  EXPECT_EQ(cdr.get<std::uint32_t>(), 5u);
  EXPECT_EQ(cdr.get<std::uint32_t>(), 6u);
  EXPECT_EQ(cdr.text(), "world");
  for (const double expected : {0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0}) EXPECT_EQ(cdr.get<double>(), expected);
  EXPECT_EQ(cdr.get<std::uint32_t>(), 20u);
  ASSERT_EQ(cdr.get<std::uint32_t>(), 5u);
  std::uint32_t offset = 0;
  for (const char* name : {"x", "y", "z", "speed", "stress"}) {
    EXPECT_EQ(cdr.text(), name);
    EXPECT_EQ(cdr.get<std::uint32_t>(), offset);
    EXPECT_EQ(cdr.get<std::uint32_t>(), 7u);
    offset += 4;
  }
  EXPECT_EQ(cdr.get<std::uint32_t>(), 40u);
  for (const float expected : {1.f, 2.f, 3.f, 5.f, 7.f, 4.f, 5.f, 6.f, 0.f, 8.f}) EXPECT_EQ(cdr.get<float>(), expected);
  EXPECT_TRUE(cdr.at_end());
}

}  // namespace
}  // namespace flexcast::web
