// flexcast-web between real servers and clients of all kinds: others' code, hostile ones, slow ones.
#include <gtest/gtest.h>

#include <fstream>

#include "idl/wire/frame_head.h"
#include "tests/support/identities.h"
#include "tests/support/socket_client.h"
#include "tests/system/scenes.h"
#include "tests/system/system_test.h"

namespace flexcast::test {
namespace {

namespace fs = std::filesystem;

class WebSystem : public SystemTest {
 protected:
  struct Web {
    std::unique_ptr<Process> process;
    std::uint16_t port = 0;
  };
  Web start_web(Arguments arguments = {}) const {
    arguments.insert(arguments.begin(), {"--port", "0", "--domain", std::to_string(domain())});
    Web web{start("flexcast-web", arguments), 0};
    const auto line = web.process->wait_for_line("ready: http://127.0.0.1:", patience);
    if (!line) throw std::runtime_error("flexcast-web does not start: " + web.process->err());
    web.port = static_cast<std::uint16_t>(std::stoi(line->substr(line->rfind(':') + 1)));
    return web;
  }

  static SocketClient open(const Web& web, int receive_buffer = 0) {
    SocketClient client(web.port, receive_buffer);
    if (!client.upgrade().starts_with("HTTP/1.1 101")) throw std::runtime_error("no WebSocket");
    return client;
  }

  // The number of a channel, as soon as it is advertised.
  static std::uint32_t find_channel(SocketClient& client, const std::string& topic) {
    for (;;) {
      const auto message = client.receive_op("advertise");
      if (message.is_null()) throw std::runtime_error("there is no channel " + topic);
      for (const auto& channel : message["channels"])
        if (channel["topic"] == topic) return channel["id"];
    }
  }
  static void subscribe(SocketClient& client, std::uint32_t channel) {
    client.send_json({{"op", "subscribe"}, {"subscriptions", {{{"id", 1}, {"channelId", channel}}}}});
  }
  // The head of the next chunk of a frame.
  static wire::FrameHead next_head(SocketClient& client, std::string& content) {
    for (const client::Deadline deadline(patience); !deadline.passed();) {
      auto message = client.receive();
      if (!message) break;
      if (message->opcode != 2 || message->content[0] != 1) continue;
      content = std::move(message->content);
      return wire::peek_frame_head(std::as_bytes(std::span(content)).subspan(13)).value();
    }
    throw std::runtime_error("no frames come");
  }
  static std::uint64_t next_frame(SocketClient& client) {
    std::string content;
    return next_head(client, content).frame;
  }
  // A new client is greeted and gets frames.
  static void expect_service(const Web& web) {
    SocketClient client = open(web);
    subscribe(client, find_channel(client, "flexcast/frames"));
    const auto first = next_frame(client);
    EXPECT_GT(next_frame(client), first);
  }

  Json use_web(const Web& web, const std::string& protocol) const {
    const fs::path folder = fs::path(FLEXCAST_SOURCE_DIR) / "tests/interop";
    if (!fs::exists(folder / "node_modules")) throw std::runtime_error("run `npm ci` in " + folder.string() + " first");
    Process node("/usr/bin/env", {"node", (folder / "use_web.mjs").string(),
                                  "ws://127.0.0.1:" + std::to_string(web.port) + "/", protocol});
    if (node.wait(patience) != 0) throw std::runtime_error("node found: " + node.err());
    return Json::parse(node.out());
  }
};

TEST_F(WebSystem, AnIndependentClientUsesEverythingUnderBothNamesOfTheProtocol) {
  const auto server = start_server(write_file("pair.toml", pair_scene()), {"--paused"});
  const Web web = start_web();
  for (const std::string protocol : {"foxglove.sdk.v1", "foxglove.websocket.v1"}) {
    SCOPED_TRACE(protocol);
    const Json seen = use_web(web, protocol);
    EXPECT_EQ(seen["world"], "pair");
    EXPECT_EQ(seen["channels"].size(), 7u);
    EXPECT_EQ(seen["services"].size(), 13u);
    EXPECT_EQ(seen["set"], 25);
    EXPECT_EQ(seen["update"]["value"], 25);
    EXPECT_EQ(seen["refused"], 25);
    EXPECT_EQ(seen["refusal"], "rope.stiffness = -1 is not allowed: expected a number in N, >= 0");
    EXPECT_EQ(seen["stepped"]["outcome"], "applied");
    EXPECT_EQ(seen["stepped"]["applied_step"], 10);
    EXPECT_EQ(seen["frame"]["positions"], 3 * seen["particles"].get<int>());
    EXPECT_EQ(seen["points"]["fields"], Json::array({"x", "y", "z", "speed"}));
    EXPECT_EQ(seen["points"]["bytes"], 16 * seen["particles"].get<int>());
    EXPECT_EQ(seen["grabbed"], "applied");
    EXPECT_EQ(seen["released"], "applied");
    EXPECT_EQ(seen["failure"], "step: 'count' must be a whole number from 1 on, not \"many\"");
    EXPECT_EQ(seen["unknown"]["outcome"], "rejected");
    EXPECT_EQ(seen["again"], 0);
  }
  end(*web.process, SIGTERM);
}

TEST_F(WebSystem, AServerThatIsKilledIsMissedAndItsSuccessorGoesOnInTheSameChannels) {
  const auto scene = write_file("rope.toml", rope_scene());
  auto server = start_server(scene);
  const Web web = start_web();
  SocketClient client = open(web);
  subscribe(client, find_channel(client, "flexcast/frames"));
  std::string content;
  const auto run = next_head(client, content).run_id;
  server->send(SIGKILL);
  const Json missed = client.receive_op("status");
  EXPECT_EQ(missed["id"], "world:rope");
  EXPECT_EQ(missed["level"], 2);
  server = start_server(scene);
  EXPECT_EQ(client.receive_op("removeStatus")["statusIds"], Json::array({"world:rope"}));
  for (const client::Deadline deadline(patience); !deadline.passed();)
    if (next_head(client, content).run_id != run) return;
  FAIL() << "no frames of the new server";
}

TEST_F(WebSystem, AServerThatEndsIsSaidAndItsChannelsGo) {
  auto server = start_server(write_file("rope.toml", rope_scene()));
  const Web web = start_web();
  SocketClient client = open(web);
  const auto channel = find_channel(client, "flexcast/frames");
  end(*server, SIGTERM);
  const Json gone = client.receive_op("unadvertise");
  EXPECT_NE(std::find(gone["channelIds"].begin(), gone["channelIds"].end(), channel), gone["channelIds"].end());
  EXPECT_EQ(client.receive_op("status")["id"], "world:rope");
}

TEST_F(WebSystem, OtherWorldsHaveTheirNamesInFront) {
  const auto rope = start_server(write_file("rope.toml", rope_scene()));
  const auto beam = start_server(write_file("other.toml", rope_scene("other")), {"--world", "other"});
  const Web web = start_web({"--world", "rope"});
  SocketClient client = open(web);
  EXPECT_EQ(client.receive_op("serverInfo")["metadata"]["world"], "rope");
  subscribe(client, find_channel(client, "other/flexcast/frames"));
  std::string content;
  EXPECT_EQ(next_head(client, content).world, "other");
}

TEST_F(WebSystem, HostileClientsAreTurnedAwayAndOthersAreServed) {
  const auto server = start_server(write_file("rope.toml", rope_scene()));
  const Web web = start_web({"--allow-origin", "https://app.foxglove.dev"});
  SocketClient healthy = open(web);
  subscribe(healthy, find_channel(healthy, "flexcast/frames"));

  EXPECT_EQ(SocketClient(web.port).upgrade("Origin: https://evil.com\r\n").substr(0, 12), "HTTP/1.1 403");
  EXPECT_EQ(SocketClient(web.port).upgrade("Origin: https://app.foxglove.dev\r\n").substr(0, 12), "HTTP/1.1 101");
  EXPECT_EQ(SocketClient(web.port).upgrade("", "evil.com").substr(0, 12), "HTTP/1.1 403");
  EXPECT_EQ(SocketClient(web.port).upgrade("", "localhost", "chat").substr(0, 12), "HTTP/1.1 400");
  EXPECT_EQ(SocketClient(web.port).ask("GET / HTTP/1.1\r\nX: " + std::string(100'000, 'x')).substr(0, 12),
            "HTTP/1.1 431");

  SocketClient flood = open(web);
  for (int i = 0; i < 5000; ++i)
    if (!flood.send_text(R"({"op":"getParameters","parameterNames":[]})")) break;
  EXPECT_EQ(flood.wait_for_close(), 1008);
  SocketClient large = open(web);
  large.send_text(std::string(200'000, ' '));
  EXPECT_EQ(large.wait_for_close(), 1009);
  SocketClient broken = open(web);
  broken.say(std::string(40, '\xff'));
  EXPECT_EQ(broken.wait_for_close(), 1002);
  SocketClient nonsense = open(web);
  for (const std::string bytes : {"", "nonsense", "[[[[", "{\"op\":5}", "{\"op\":\"subscribe\"}"}) {
    nonsense.send_text(bytes);
    nonsense.send_binary(bytes);
  }
  EXPECT_EQ(nonsense.receive_op("status")["level"], 2);

  std::vector<SocketClient> slow;
  for (int i = 0; i < 100; ++i) {
    slow.emplace_back(web.port);
    slow.back().say("GET / HTTP/1.1\r\nX: ");
  }
  const auto frame = next_frame(healthy);
  EXPECT_GT(next_frame(healthy), frame);
  expect_service(web);
  EXPECT_TRUE(web.process->runs());
}

TEST_F(WebSystem, ThirtyTwoClientsAreTheMost) {
  const auto server = start_server(write_file("rope.toml", rope_scene()));
  const Web web = start_web();
  std::vector<SocketClient> clients;
  for (int i = 0; i < 32; ++i) {
    clients.push_back(open(web));
    EXPECT_FALSE(clients.back().receive_op("serverInfo").is_null());
  }
  EXPECT_EQ(SocketClient(web.port).upgrade().substr(0, 12), "HTTP/1.1 503");
  clients.pop_back();
  for (const client::Deadline deadline(patience); !deadline.passed();)
    if (SocketClient(web.port).upgrade().starts_with("HTTP/1.1 101")) return;
  FAIL() << "the place of a client that has gone is not given to another";
}

// Frames of 120 KB: a socket's buffers hold a dozen.
std::string sheet_scene() {
  return R"(name = "sheet"
[time]
step = 0.01
integrator = "symplectic_euler"
[[body]]
name = "sheet"
model = "mass_spring"
mesh = { shape = "grid", cells = [99, 99], size = [1.0, 1.0] }
springs = { stiffness = 0.0001 }
mass = 0.01
)";
}

TEST_F(WebSystem, AClientThatDoesNotReadLosesFramesAndHoldsUpNobody) {
  const auto server = start_server(write_file("sheet.toml", sheet_scene()));
  const Web web = start_web();
  SocketClient lazy = open(web, 64 * 1024);
  subscribe(lazy, find_channel(lazy, "flexcast/frames"));
  SocketClient healthy = open(web);
  subscribe(healthy, find_channel(healthy, "flexcast/frames"));
  std::uint64_t last = 0;
  for (int i = 0; i < 150; ++i) last = next_frame(healthy);

  // Then it reads: what lay in the buffers, a gap, and the newest.
  std::uint64_t before = next_frame(lazy), widest = 0;
  for (int i = 0; i < 200 && before < last; ++i) {
    const auto frame = next_frame(lazy);
    widest = std::max(widest, frame - before);
    before = frame;
  }
  EXPECT_GE(before, last);
  EXPECT_GT(widest, 50u);

  std::ifstream status("/proc/" + std::to_string(web.process->pid()) + "/status");
  for (std::string line; std::getline(status, line);) {
    if (line.starts_with("VmHWM:")) {
      EXPECT_LT(std::stol(line.substr(6)), 64 * 1024) << "KiB";
    }
  }
}

TEST_F(WebSystem, AWatchersBridgeShowsEverythingAndOffersNoCommands) {
  make_identities(path("ours"), {"server:operator", "eye:watcher"});
  const auto server = start_server(write_file("rope.toml", rope_scene()), {"--security", path("ours/server").string()});
  const Web web = start_web({"--security", path("ours/eye").string()});
  SocketClient client = open(web);
  subscribe(client, find_channel(client, "flexcast/frames"));
  const auto frame = next_frame(client);
  EXPECT_GT(next_frame(client), frame);
  client.send_json({{"op", "setParameters"}, {"parameters", {{{"name", "rope.stiffness"}, {"value", 1}}}}});
  EXPECT_EQ(client.receive_op("status")["message"], "the identity of this flexcast-web may only watch");
}

TEST_F(WebSystem, BadPlacesAreSaidPlainly) {
  const Web web = start_web();
  const Ended second = run("flexcast-web", {"--port", std::to_string(web.port)});
  EXPECT_EQ(second.code, 1);
  EXPECT_NE(second.err.find("another program has the port"), std::string::npos) << second.err;
  EXPECT_EQ(run("flexcast-web", {"--bind", "203.0.113.7", "--port", "0"}).code, 1);
  EXPECT_EQ(run("flexcast-web", {"--port", "x"}).code, 2);
}

}  // namespace
}  // namespace flexcast::test
