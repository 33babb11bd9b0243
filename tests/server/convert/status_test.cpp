#include "server/convert/status.h"

#include <gtest/gtest.h>

#include "idl/wire/fill.h"

namespace flexcast::server {
namespace {

TEST(StatusMessage, HasTheUnpublishedFramesAsPairs) {
  DeliveryStatus delivery;
  delivery.frames_published = 12;
  delivery.unpublished = {{0, 3}, {7, 7}};
  const auto message = to_wire(WorldStatus{}, delivery, {"rope", 1});
  EXPECT_EQ(message->frames_published, 12u);
  const auto numbers = wire::elements(message->unpublished);
  EXPECT_EQ(std::vector<std::uint64_t>(numbers.begin(), numbers.end()), (std::vector<std::uint64_t>{0, 3, 7, 7}));
}

TEST(StatusMessage, TellsAHangAndNoPaceOfIt) {
  WorldStatus status;
  status.real_time_factor = 1.0;
  status.warnings = {"the step is large"};
  DeliveryStatus delivery;
  const auto alive = to_wire(status, delivery, {"rope", 1});
  EXPECT_EQ(wire::strings(alive->warnings), status.warnings);
  EXPECT_EQ(alive->real_time_factor, 1.0);
  delivery.silent = true;
  const auto hung = to_wire(status, delivery, {"rope", 1});
  const auto warnings = wire::strings(hung->warnings);
  ASSERT_EQ(warnings.size(), 2u);
  EXPECT_NE(warnings[1].find("step loop"), std::string::npos);
  EXPECT_EQ(hung->real_time_factor, 0.0);
}

}  // namespace
}  // namespace flexcast::server
