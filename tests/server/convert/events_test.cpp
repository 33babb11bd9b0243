// Events go to the network and come back from recordings as they were.
#include "server/convert/events.h"

#include <gtest/gtest.h>

#include <tuple>

#include "idl/wire/fill.h"

namespace flexcast::server {
namespace {

Event make_event() {
  Event event;
  event.run_id = 1;
  event.index = 2;
  event.step = 3;
  event.time = 0.25;
  event.kind = EventKind::command;
  event.state = WorldState::finished;
  event.parameter_revision = 4;
  event.key = {"tester", 5};
  event.command = CommandKind::grab;
  event.values = {
      {"gravity", Vec3(0, 0, -1)}, {"time.substeps", std::int64_t{7}}, {"solver.linear", std::string("pcg")}};
  event.keep_parameters = true;
  event.name = "start";
  event.particle = 8;
  event.target = Vec3(1, 2, 3);
  event.stiffness = 0.1;
  event.text = "text";
  return event;
}

TEST(Events, ComeBackAsTheyWere) {
  const Event sent = make_event();
  const auto read = from_wire(*to_wire(sent, "rope"));
  ASSERT_TRUE(read.ok()) << read.error().message;
  const Event& got = read.value();
  EXPECT_EQ(std::tie(got.run_id, got.index, got.step, got.time, got.kind, got.state, got.parameter_revision),
            std::tie(sent.run_id, sent.index, sent.step, sent.time, sent.kind, sent.state, sent.parameter_revision));
  EXPECT_EQ(
      std::tie(got.key.client_id, got.key.request_id, got.command, got.keep_parameters, got.name, got.particle),
      std::tie(sent.key.client_id, sent.key.request_id, sent.command, sent.keep_parameters, sent.name, sent.particle));
  EXPECT_EQ(std::tie(got.target, got.stiffness, got.text), std::tie(sent.target, sent.stiffness, sent.text));
  ASSERT_EQ(got.values.size(), sent.values.size());
  for (std::size_t i = 0; i < sent.values.size(); ++i) {
    EXPECT_EQ(got.values[i].name, sent.values[i].name);
    EXPECT_EQ(got.values[i].value, sent.values[i].value);
  }
}

TEST(Events, OfKindsThatAreNotKnownAreRefused) {
  auto message = to_wire(make_event(), "rope");
  message->kind = static_cast<flexcast_EventKind>(77);
  const auto read = from_wire(*message);
  ASSERT_FALSE(read.ok());
  EXPECT_NE(read.error().message.find("event 2"), std::string::npos);
  message = to_wire(make_event(), "rope");
  message->values._buffer[1].numbers._buffer[0] = 0.5;
  EXPECT_FALSE(from_wire(*message).ok()) << "half an integer";
}

}  // namespace
}  // namespace flexcast::server
