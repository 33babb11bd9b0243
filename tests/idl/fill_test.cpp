#include "idl/wire/fill.h"

#include <gtest/gtest.h>

#include "idl/wire/names.h"
#include "idl/wire/owned.h"
#include "tests/idl/samples.h"

namespace flexcast::wire {
namespace {

TEST(Fill, StringsMayBeSetAgain) {
  Owned<flexcast_Command> command;
  set_string(command->name, "first");
  set_string(command->name, "second");
  EXPECT_EQ(text(command->name), "second");
  set_string(command->name, text(command->name).substr(3));  // from itself
  EXPECT_EQ(text(command->name), "ond");
  EXPECT_EQ(text(command->client_id), "");
}

TEST(Fill, ViewsAreNeitherCopiedNorFreed) {
  const std::vector<float> memory{1, 2, 3};
  {
    Owned<flexcast_ParticleFrame> frame;
    copy(frame->positions, std::array{9.0f});
    view(frame->positions, memory);
    EXPECT_EQ(frame->positions._buffer, memory.data());
    EXPECT_EQ(elements(frame->positions).size(), 3u);
  }
  EXPECT_EQ(memory, (std::vector<float>{1, 2, 3}));
}

TEST(Fill, CopiesOfNumbersReplaceEachOther) {
  Owned<flexcast_ParameterValue> value;
  copy(value->numbers, std::array{1.0, 2.0});
  copy(value->numbers, std::array{3.0});
  ASSERT_EQ(elements(value->numbers).size(), 1u);
  EXPECT_EQ(elements(value->numbers)[0], 3.0);
  copy(value->numbers, {});
  EXPECT_TRUE(elements(value->numbers).empty());
}

TEST(Fill, DescriptorsAreCopiedDeeply) {
  Owned<flexcast_ParameterDescriptor> copied;
  {
    Owned<flexcast_ParameterDescriptor> original;
    test::fill(*original);
    copy(*copied, *original);
  }
  EXPECT_EQ(text(copied->unit), "m/s^2");
  EXPECT_EQ(strings(copied->choices), (std::vector<std::string>{"pcg", "ldlt"}));
  EXPECT_EQ(text(copied->initial.name), "beam.young");
  EXPECT_EQ(elements(copied->initial.numbers)[2], 1e300);
  EXPECT_TRUE(copied->live);
}

TEST(Owned, MovesWithoutLosingOrSharing) {
  Owned<flexcast_Reply> a;
  test::fill(*a);
  Owned<flexcast_Reply> b(std::move(a));
  EXPECT_EQ(text(b->reason), "no");
  Owned<flexcast_Reply> c;
  test::fill(*c);
  c = std::move(b);
  EXPECT_EQ(text(c->world), "beam");
}

TEST(Names, AreThoseOfTheContractInLowerCase) {
  EXPECT_EQ(name_of(flexcast_WORLD_FAILED), "failed");
  EXPECT_EQ(name_of(flexcast_COMMAND_RUN_UNTIL), "run_until");
  EXPECT_EQ(name_of(flexcast_COMMAND_STATUS), "status");
  EXPECT_EQ(name_of(flexcast_OUTCOME_WRONG_STATE), "wrong_state");
  EXPECT_EQ(name_of(static_cast<flexcast_ReplyOutcome>(7)), "unknown");  // the last of its three bits
}

}  // namespace
}  // namespace flexcast::wire
