#include "server/convert/commands.h"

#include <gtest/gtest.h>

#include <limits>

#include "idl/wire/fill.h"
#include "server/convert/events.h"
#include "server/convert/parameters.h"
#include "server/convert/status.h"

namespace flexcast::server {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr double infinity = std::numeric_limits<double>::infinity();

struct GivenValue {
  std::string name;
  flexcast_ValueKind kind;
  std::vector<double> numbers;
  std::string text;
};

wire::Owned<flexcast_Command> make_message(flexcast_CommandKind kind, const std::vector<GivenValue>& values = {}) {
  wire::Owned<flexcast_Command> message;
  wire::set_string(message->world, "rope");
  wire::set_string(message->client_id, "tester");
  message->request_id = 5;
  message->kind = kind;
  const auto slots = wire::resize(message->values, values.size());
  for (std::size_t i = 0; i < values.size(); ++i) {
    wire::set_string(slots[i].name, values[i].name);
    slots[i].kind = values[i].kind;
    wire::copy(slots[i].numbers, std::span<const double>(values[i].numbers));
    wire::set_string(slots[i].text, values[i].text);
  }
  return message;
}

bool is_malformed(const wire::Owned<flexcast_Command>& message) {
  const Command command = from_wire(*message, {});
  return std::holds_alternative<MalformedCommand>(command.body);
}

TEST(Commands, EveryValueKindArrivesAsItsType) {
  const Command command = from_wire(*make_message(flexcast_COMMAND_SET, {{"a", flexcast_VALUE_NUMBER, {1.5}, ""},
                                                                         {"b", flexcast_VALUE_INTEGER, {3}, ""},
                                                                         {"c", flexcast_VALUE_VECTOR, {1, 2, 3}, ""},
                                                                         {"d", flexcast_VALUE_CHOICE, {}, "pcg"},
                                                                         {"e", flexcast_VALUE_BOOLEAN, {1}, ""}}),
                                    {});
  EXPECT_EQ(command.key.client_id, "tester");
  EXPECT_EQ(command.key.request_id, 5u);
  const auto& values = std::get<SetCommand>(command.body).values;
  ASSERT_EQ(values.size(), 5u);
  EXPECT_EQ(values[0].value, ParameterValue(1.5));
  EXPECT_EQ(values[1].value, ParameterValue(std::int64_t{3}));
  EXPECT_EQ(values[2].value, ParameterValue(Vec3(1, 2, 3)));
  EXPECT_EQ(values[3].value, ParameterValue(std::string("pcg")));
  EXPECT_EQ(values[4].value, ParameterValue(std::int64_t{1}));
}

TEST(Commands, ValuesThatDoNotFitTheirKindAreMalformed) {
  EXPECT_TRUE(is_malformed(make_message(flexcast_COMMAND_SET, {{"a", flexcast_VALUE_NUMBER, {}, ""}})));
  EXPECT_TRUE(is_malformed(make_message(flexcast_COMMAND_SET, {{"a", flexcast_VALUE_VECTOR, {1, 2}, ""}})));
  for (double number : {0.5, nan, infinity, 1e300}) {
    EXPECT_TRUE(is_malformed(make_message(flexcast_COMMAND_SET, {{"a", flexcast_VALUE_INTEGER, {number}, ""}})));
  }
}

TEST(Commands, ExpiryCountsFromReceiptAndMustBeANumber) {
  const Clock::time_point received{std::chrono::hours(1)};
  auto message = make_message(flexcast_COMMAND_PAUSE);
  EXPECT_FALSE(from_wire(*message, received).deadline.has_value());
  message->expires_in = 2.0;
  EXPECT_EQ(from_wire(*message, received).deadline, received + std::chrono::seconds(2));
  message->expires_in = 1e300;
  EXPECT_GT(from_wire(*message, received).deadline, received);
  for (double bad : {-1.0, nan, infinity}) {
    message->expires_in = bad;
    EXPECT_TRUE(is_malformed(message));
  }
}

TEST(Commands, FieldsOfEachKindArrive) {
  auto message = make_message(flexcast_COMMAND_STEP);
  message->count = 17;
  message->check_revision = true;
  message->expected_revision = 9;
  const Command step = from_wire(*message, {});
  EXPECT_EQ(std::get<StepCommand>(step.body).count, 17u);
  EXPECT_EQ(step.expected_revision, 9u);
  message = make_message(flexcast_COMMAND_RUN_UNTIL);
  message->time = 2.5;
  EXPECT_EQ(std::get<RunUntilCommand>(from_wire(*message, {}).body).time, 2.5);
  message = make_message(flexcast_COMMAND_RESET);
  message->keep_parameters = true;
  EXPECT_TRUE(std::get<ResetCommand>(from_wire(*message, {}).body).keep_parameters);
  message = make_message(flexcast_COMMAND_GET, {{"gravity", flexcast_VALUE_NUMBER, {}, ""}});
  EXPECT_EQ(std::get<GetCommand>(from_wire(*message, {}).body).names, std::vector<std::string>{"gravity"});
}

TEST(Commands, NamesAndParticlesArrive) {
  auto message = make_message(flexcast_COMMAND_SAVE);
  wire::set_string(message->name, "start");
  EXPECT_EQ(std::get<SaveCommand>(from_wire(*message, {}).body).name, "start");
  message->kind = flexcast_COMMAND_RESTORE;
  EXPECT_EQ(std::get<RestoreCommand>(from_wire(*message, {}).body).name, "start");
  message->kind = flexcast_COMMAND_LOAD;
  EXPECT_EQ(std::get<LoadCommand>(from_wire(*message, {}).body).name, "start");
  message = make_message(flexcast_COMMAND_GRAB);
  message->particle = 4'000'000'000;
  message->stiffness = 40.0;
  for (int i = 0; i < 3; ++i) message->target[i] = i + 1.0;
  const Command grab = from_wire(*message, {});
  EXPECT_EQ(std::get<GrabCommand>(grab.body).particle, 4'000'000'000);
  EXPECT_EQ(std::get<GrabCommand>(grab.body).target, Vec3(1, 2, 3));
  EXPECT_EQ(std::get<GrabCommand>(grab.body).stiffness, 40.0);
  message->kind = flexcast_COMMAND_RELEASE;
  EXPECT_EQ(std::get<ReleaseCommand>(from_wire(*message, {}).body).particle, 4'000'000'000);
}

TEST(Replies, CarryEverythingToTheClient) {
  Reply reply;
  reply.key = {"tester", 5};
  reply.kind = CommandKind::set;
  reply.outcome = Outcome::rejected;
  reply.reason = "why";
  reply.run_id = 1;
  reply.applied_step = 120;
  reply.time = 0.12;
  reply.state = WorldState::failed;
  reply.parameter_revision = 4;
  reply.values = {{"a", Vec3(1, 2, 3)}, {"b", std::string("pcg")}, {"c", std::int64_t{7}}};
  const auto message = to_wire(reply, "rope");
  EXPECT_EQ(wire::text(message->world), "rope");
  EXPECT_EQ(wire::text(message->client_id), "tester");
  EXPECT_EQ(message->request_id, 5u);
  EXPECT_EQ(message->kind, flexcast_COMMAND_SET);
  EXPECT_EQ(message->outcome, flexcast_OUTCOME_REJECTED);
  EXPECT_EQ(wire::text(message->reason), "why");
  EXPECT_EQ(message->applied_step, 120u);
  EXPECT_EQ(message->state, flexcast_WORLD_FAILED);
  for (std::size_t i = 0; i < reply.values.size(); ++i) {
    const auto back = from_wire(message->values._buffer[i]);
    ASSERT_TRUE(back);
    EXPECT_EQ(back.value().name, reply.values[i].name);
    EXPECT_EQ(back.value().value, reply.values[i].value);
  }
}

TEST(Events, CarryTheCommandThatMadeThem) {
  Event event;
  event.run_id = 3;
  event.index = 4;
  event.step = 5;
  event.kind = EventKind::command;
  event.state = WorldState::running;
  event.key = {"tester", 6};
  event.command = CommandKind::reset;
  event.keep_parameters = true;
  event.values = {{"a", 1.5}};
  event.name = "start";
  event.particle = 7;
  event.target = Vec3(1, 2, 3);
  event.stiffness = 40.0;
  event.text = "text";
  const auto message = to_wire(event, "rope");
  EXPECT_EQ(wire::text(message->world), "rope");
  EXPECT_EQ(message->index, 4u);
  EXPECT_EQ(message->step, 5u);
  EXPECT_EQ(message->kind, flexcast_EVENT_COMMAND);
  EXPECT_EQ(message->command_kind, flexcast_COMMAND_RESET);
  EXPECT_TRUE(message->keep_parameters);
  EXPECT_EQ(wire::text(message->client_id), "tester");
  EXPECT_EQ(message->values._length, 1u);
  EXPECT_EQ(wire::text(message->name), "start");
  EXPECT_EQ(message->particle, 7u);
  EXPECT_EQ(Vec3(message->target[0], message->target[1], message->target[2]), Vec3(1, 2, 3));
  EXPECT_EQ(message->stiffness, 40.0);
}

TEST(StepReports, WhatIsNotComputedOrNotFiniteIsNaN) {
  MeasuredReport measured;
  measured.report.kinetic = infinity;
  measured.report.elastic = 2.0;
  measured.report.momentum = Vec3(1, nan, infinity);
  const flexcast_StepReport message = to_wire(measured);
  EXPECT_TRUE(std::isnan(message.kinetic));
  EXPECT_EQ(message.elastic, 2.0);
  EXPECT_EQ(message.numerical, 0.0);
  EXPECT_TRUE(std::isnan(message.stability_margin));
  EXPECT_TRUE(std::isnan(message.min_j));
  EXPECT_EQ(message.momentum[0], 1.0);
  EXPECT_TRUE(std::isnan(message.momentum[2]));
}

TEST(Statuses, JoinWhatWorldAndPublisherKnow) {
  WorldStatus status;
  status.run_id = 1;
  status.state = WorldState::failed;
  status.failure.emplace();
  status.failure->cause = "a position";
  status.failure->particle = 4;
  status.probes = {{"tip", Vec3(1, 2, 3), Vec3(4, 5, 6)}};
  status.handles = {{"grip", Vec3(7, 8, 9), Vec3(1, nan, 3)}};
  status.warnings = {"careful"};
  status.frames_skipped = 8;
  const auto message =
      to_wire(status, {.heartbeat = 5, .frames_published = 6, .frame_queue = 2, .readers = 1}, {"rope", 77});
  EXPECT_EQ(message->state, flexcast_WORLD_FAILED);
  EXPECT_EQ(wire::text(message->trouble.cause), "a position");
  EXPECT_EQ(message->trouble.particle, 4);
  EXPECT_EQ(message->probes._buffer[0].velocity[2], 6.0);
  ASSERT_EQ(message->handles._length, 1u);
  EXPECT_EQ(wire::text(message->handles._buffer[0].name), "grip");
  EXPECT_EQ(message->handles._buffer[0].force[2], 9.0);
  EXPECT_EQ(message->handles._buffer[0].torque[2], 3.0);
  EXPECT_TRUE(std::isnan(message->handles._buffer[0].torque[1]));
  EXPECT_EQ(wire::text(message->warnings._buffer[0]), "careful");
  EXPECT_EQ(message->heartbeat, 5u);
  EXPECT_EQ(message->frames_published, 6u);
  EXPECT_EQ(message->frames_skipped, 8u);
  EXPECT_EQ(message->server_id, 77u);
  EXPECT_EQ(wire::text(message->version), FLEXCAST_VERSION);
}

}  // namespace
}  // namespace flexcast::server
