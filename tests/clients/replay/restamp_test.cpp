#include "clients/replay/restamp.h"

#include <gtest/gtest.h>

#include <array>

#include "tests/idl/samples.h"
#include "tests/support/encode.h"

namespace flexcast::replay {
namespace {

const std::string beam = "beam", again = "again";

TEST(Restamp, AsRecordedNothingChanges) {
  wire::Owned<flexcast_ParticleFrame> frame;
  flexcast::test::fill(*frame);
  const auto before = flexcast::test::encode(*frame);
  EXPECT_TRUE(restamp(*frame, {beam, RunMap()}));
  EXPECT_EQ(flexcast::test::encode(*frame), before);
}

TEST(Restamp, TheWorldIsRenamedInEveryMessage) {
  const auto renamed = [](auto message) {
    flexcast::test::fill(*message);
    return restamp(*message, {again, RunMap()}) ? std::string(wire::text(message->world)) : "left out";
  };
  EXPECT_EQ(renamed(wire::Owned<flexcast_SceneInfo>()), again);
  EXPECT_EQ(renamed(wire::Owned<flexcast_Topology>()), again);
  EXPECT_EQ(renamed(wire::Owned<flexcast_ParameterSet>()), again);
  EXPECT_EQ(renamed(wire::Owned<flexcast_ParticleFrame>()), again);
  EXPECT_EQ(renamed(wire::Owned<flexcast_Status>()), again);
  EXPECT_EQ(renamed(wire::Owned<flexcast_Event>()), again);
}

TEST(Restamp, FramesOfANewRunCountFromItsFirstAndGapsStay) {
  RunMap runs;
  runs.add(5, {1000, 20});
  for (const auto& [recorded, published] : {std::pair(20, 0), std::pair(21, 1), std::pair(25, 5)}) {
    wire::Owned<flexcast_ParticleFrame> frame;
    frame->run_id = 5;
    frame->frame = static_cast<std::uint64_t>(recorded);
    EXPECT_TRUE(restamp(*frame, {beam, runs}));
    EXPECT_EQ(frame->run_id, 1000U);
    EXPECT_EQ(frame->frame, static_cast<std::uint64_t>(published));
  }
}

TEST(Restamp, WhatIsNotPublishedIsLeftOut) {
  RunMap runs;
  runs.add(5, {1000, 20});
  wire::Owned<flexcast_ParticleFrame> frame;
  frame->run_id = 5;
  frame->frame = 19;
  EXPECT_FALSE(restamp(*frame, {beam, runs}));
  wire::Owned<flexcast_Event> event;
  event->run_id = 4;
  EXPECT_FALSE(restamp(*event, {beam, runs}));
}

TEST(Restamp, RangesOfUnpublishedFramesMoveWithTheNumbers) {
  RunMap runs;
  runs.add(5, {1000, 20});
  wire::Owned<flexcast_Status> status;
  status->run_id = 5;
  wire::copy(status->unpublished, std::array<std::uint64_t, 6>{3, 7, 18, 22, 30, 30});
  EXPECT_TRUE(restamp(*status, {beam, runs}));
  const auto ranges = wire::elements(status->unpublished);
  EXPECT_EQ(std::vector<std::uint64_t>(ranges.begin(), ranges.end()), (std::vector<std::uint64_t>{0, 2, 10, 10}));
}

}  // namespace
}  // namespace flexcast::replay
