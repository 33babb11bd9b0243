#include "clients/export/vtu.h"

#include <gtest/gtest.h>

#include <cstring>
#include <regex>

namespace flexcast::exporting {
namespace {

client::Frame make_frame() {
  client::Frame frame;
  frame.time = 0.25;
  frame.particles = 4;
  for (int i = 0; i < 12; ++i) frame.positions.push_back(0.1 * i);
  for (int i = 0; i < 12; ++i) frame.velocities.push_back(-0.1 * i);
  frame.stress = {1, 2, 3, 4};
  return frame;
}

Geometry make_geometry() {
  return {4, {0, 1, 2, 3, 0, 1}, {4, 6}, {10, 3}, {0, 1}};
}

// The numbers of an array, found as a reader finds them: by the offset in its element.
template <class T>
std::vector<T> read_array(const std::string& vtu, const std::string& name) {
  const std::regex pattern("Name=\"" + name + "\"[^>]*offset=\"([0-9]+)\"");
  std::smatch match;
  const std::string xml = vtu.substr(0, vtu.find("<AppendedData"));
  if (!std::regex_search(xml, match, pattern)) return {};
  const char* const data = vtu.data() + vtu.find("encoding=\"raw\">\n_") + 17 + std::stoul(match[1]);
  std::uint64_t bytes = 0;
  std::memcpy(&bytes, data, sizeof bytes);
  std::vector<T> values(bytes / sizeof(T));
  std::memcpy(values.data(), data + sizeof bytes, bytes);
  return values;
}

TEST(Vtu, HoldsEveryArrayBehindItsSize) {
  const std::string vtu = make_vtu(make_frame(), make_geometry(), {true, true, true, true});
  EXPECT_NE(vtu.find("NumberOfPoints=\"4\" NumberOfCells=\"2\""), std::string::npos);
  EXPECT_EQ(read_array<double>(vtu, "positions"), make_frame().positions);
  EXPECT_EQ(read_array<double>(vtu, "velocity"), make_frame().velocities);
  EXPECT_EQ(read_array<float>(vtu, "stress"), (std::vector<float>{1, 2, 3, 4}));
  EXPECT_EQ(read_array<std::int64_t>(vtu, "connectivity"), make_geometry().connectivity);
  EXPECT_EQ(read_array<std::int64_t>(vtu, "offsets"), make_geometry().offsets);
  EXPECT_EQ(read_array<std::uint8_t>(vtu, "types"), make_geometry().types);
  EXPECT_EQ(read_array<std::uint32_t>(vtu, "body"), make_geometry().bodies);
  EXPECT_EQ(vtu.find("stretch"), std::string::npos);  // the frame has none
}

TEST(Vtu, LeavesOutWhatIsNotAskedForAndUsesFloatsUnlessDoublesWereStreamed) {
  const std::string vtu = make_vtu(make_frame(), make_geometry(), {});
  EXPECT_EQ(vtu.find("velocity"), std::string::npos);
  EXPECT_EQ(vtu.find("stress"), std::string::npos);
  const auto positions = read_array<float>(vtu, "positions");
  ASSERT_EQ(positions.size(), 12U);
  EXPECT_EQ(positions[1], 0.1f);
}

TEST(Vtu, TheCollectionNamesTimesWithAllTheirDigits) {
  const std::string pvd = make_pvd({{0.0, "a.vtu"}, {0.1 + 0.2, "b.vtu"}});
  EXPECT_NE(pvd.find("timestep=\"0.30000000000000004\" group=\"\" part=\"0\" file=\"b.vtu\""), std::string::npos)
      << pvd;
}

}  // namespace
}  // namespace flexcast::exporting
