#include "clients/web/net.h"

#include <gtest/gtest.h>

#include <atomic>
#include <deque>
#include <functional>
#include <mutex>
#include <thread>

#include "clients/web/assets.h"
#include "clients/web/site.h"
#include "tests/clients/web/web.h"
#include "tests/support/socket_client.h"

namespace flexcast::web {
namespace {

using namespace std::chrono_literals;
using test::SocketClient;

// Sends back what it gets.
class Echo final : public Peer {
 public:
  Echo(Line& line, std::atomic<int>& alive) : line_(line), alive_(alive) { ++alive_; }
  ~Echo() override { --alive_; }
  void receive(bool is_text, std::string_view message) override {
    if (message == "close") return line_.close(CloseCode::policy, "as you wish");
    answers_.push_back({is_text, "head ", make_sample(std::string(message)).bytes});
    line_.wake();
  }
  void receive_control() override {}
  std::optional<Outgoing> next() override {
    if (answers_.empty()) return {};
    Outgoing message = std::move(answers_.front());
    answers_.pop_front();
    return message;
  }

 private:
  Line& line_;
  std::atomic<int>& alive_;
  std::deque<Outgoing> answers_;
};

class NetTest : public testing::Test {
 protected:
  NetTest() {
    net_ = Net::listen({.port = 0}, {.respond = [this](const HttpRequest& request) { return site_.answer(request); },
                                     .connect = [this](Line& line) { return std::make_unique<Echo>(line, alive_); },
                                     .woken =
                                         [this] {
                                           ++woken_;
                                           if (on_woken_) on_woken_();
                                         },
                                     .tick = [] {}})
               .value();
    thread_ = std::thread([this] { net_->run(); });
  }
  ~NetTest() override {
    net_->stop();
    if (thread_.joinable()) thread_.join();
  }
  SocketClient connect() const { return SocketClient(net_->port()); }
  SocketClient open() const {
    SocketClient client = connect();
    EXPECT_EQ(client.upgrade().substr(0, 12), "HTTP/1.1 101");
    return client;
  }
  // A client that is served as if nothing had happened.
  void expect_service() const {
    SocketClient client = open();
    client.send_text("still there");
    const auto answer = client.receive();
    ASSERT_TRUE(answer);
    EXPECT_EQ(answer->content, "head still there");
  }
  static std::string get(const std::string& target) { return "GET " + target + " HTTP/1.1\r\nHost: localhost\r\n\r\n"; }

  Site site_{Gate("127.0.0.1", {}), assets(), [] { return false; }};
  std::atomic<int> alive_ = 0, woken_ = 0;
  std::function<void()> on_woken_;
  std::unique_ptr<Net> net_;
  std::thread thread_;
};

TEST_F(NetTest, SeveralRequestsGoOverOneConnection) {
  SocketClient client = connect();
  EXPECT_EQ(client.ask(get("/")).substr(0, 15), "HTTP/1.1 200 OK");
  EXPECT_EQ(client.ask(get("/nothing")).substr(0, 12), "HTTP/1.1 404");
  EXPECT_EQ(client.ask(get("/")).substr(0, 15), "HTTP/1.1 200 OK");
}

TEST_F(NetTest, AMessageOfHeadAndBodyArrivesAsOne) {
  SocketClient client = open();
  const std::string big(60'000, 'x');
  client.send_binary(big);
  const auto answer = client.receive();
  ASSERT_TRUE(answer);
  EXPECT_EQ(answer->opcode, 2);
  EXPECT_EQ(answer->content, "head " + big);
}

TEST_F(NetTest, AnotherPageIsTurnedAwayBeforeTheUpgrade) {
  EXPECT_EQ(connect().upgrade("Origin: https://evil.com\r\n").substr(0, 12), "HTTP/1.1 403");
  EXPECT_EQ(connect().upgrade("", "evil.com").substr(0, 12), "HTTP/1.1 403");
  EXPECT_EQ(connect().upgrade("Host: evil.com\r\n").substr(0, 12), "HTTP/1.1 403");  // two of them
  EXPECT_EQ(connect().upgrade("Origin: http://localhost\r\n").substr(0, 12), "HTTP/1.1 101");
}

TEST_F(NetTest, HugeHeadersAndNonsenseAreRefused) {
  EXPECT_EQ(connect().ask("GET / HTTP/1.1\r\nX: " + std::string(20'000, 'x') + "\r\n\r\n").substr(0, 12),
            "HTTP/1.1 431");
  EXPECT_EQ(connect().ask("\x01\x02 nonsense\r\n\r\n").substr(0, 12), "HTTP/1.1 400");
  EXPECT_EQ(connect().ask("GET / HTTP/1.1\r\nHost: localhost\r\nContent-Length: 5\r\n\r\nhello").substr(0, 12),
            "HTTP/1.1 400");
  expect_service();
}

TEST_F(NetTest, FramesThatBreakTheProtocolEndTheirConnection) {
  const std::string unmasked("\x81\x02hi", 4), reserved("\xf1\x80\0\0\0\0", 6), unknown("\x83\x80\0\0\0\0", 6);
  for (const std::string& bytes : {unmasked, reserved, unknown}) {
    SocketClient client = open();
    client.say(bytes);
    EXPECT_EQ(client.wait_for_close(), 1002);
  }
  SocketClient client = open();
  client.send_text("\xff\xfe");
  EXPECT_EQ(client.wait_for_close(), 1007);
  expect_service();
}

TEST_F(NetTest, AMessageBeyondTheLimitEndsItsConnection) {
  SocketClient client = open();
  client.send_text(std::string(limits::message_bytes, 'x'));
  EXPECT_TRUE(client.receive());
  client.send_text(std::string(limits::message_bytes + 1, 'x'));
  EXPECT_EQ(client.wait_for_close(), 1009);
  // In pieces, too.
  SocketClient pieces = open();
  pieces.say(SocketClient::frame(1, std::string(40'000, 'x'), false));
  pieces.say(SocketClient::frame(0, std::string(40'000, 'x'), false));
  EXPECT_EQ(pieces.wait_for_close(), 1009);
  expect_service();
}

TEST_F(NetTest, RequestsThatNeverEndMakeRoomForOthers) {
  std::vector<SocketClient> slow;
  for (std::size_t i = 0; i < limits::requests + 20; ++i) {
    slow.push_back(connect());
    slow.back().say("GET / HTTP/1.1\r\nX: ");
  }
  expect_service();
  EXPECT_EQ(connect().ask(get("/")).substr(0, 12), "HTTP/1.1 200");
}

TEST_F(NetTest, WhoIsClosedHearsWhy) {
  SocketClient client = open();
  client.send_text("close");
  const auto message = client.receive();
  ASSERT_TRUE(message);
  EXPECT_EQ(message->opcode, 8);
  EXPECT_EQ(message->content,
            "\x03\xf0"
            "as you wish");
}

TEST_F(NetTest, WhoIsClosedAndDoesNotListenIsCutOff) {
  SocketClient client = open();
  while (alive_ < 1) std::this_thread::yield();
  client.send_text("close");
  // It neither reads nor answers.
  for (const auto latest = std::chrono::steady_clock::now() + 20s;
       alive_ > 0 && std::chrono::steady_clock::now() < latest;)
    std::this_thread::sleep_for(10ms);
  EXPECT_EQ(alive_, 0);
}

TEST_F(NetTest, ThePeerGoesWithItsConnection) {
  {
    SocketClient client = open();
    client.send_text("hello");
    EXPECT_TRUE(client.receive());
    EXPECT_EQ(alive_, 1);
  }
  for (const auto latest = std::chrono::steady_clock::now() + 20s;
       alive_ > 0 && std::chrono::steady_clock::now() < latest;)
    std::this_thread::sleep_for(1ms);
  EXPECT_EQ(alive_, 0);
}

TEST_F(NetTest, AtItsEndItSaysGoodbye) {
  SocketClient client = open();
  client.send_text("hello");
  EXPECT_TRUE(client.receive());
  net_->stop();
  EXPECT_EQ(client.wait_for_close(), 1001);
}

TEST_F(NetTest, EndsAlsoWhenATickIsDueAtThatMoment) {
  on_woken_ = [this] {
    net_->stop();
    std::this_thread::sleep_for(250ms);  // more than the time between two ticks
  };
  net_->wake();
  thread_.join();  // for ever, if it goes on ticking
  EXPECT_GT(woken_, 0);
}

TEST_F(NetTest, APortThatIsTakenIsSaid) {
  const auto second = Net::listen({.port = net_->port()}, {});
  ASSERT_FALSE(second.ok());
  EXPECT_NE(second.error().message.find("--port 0"), std::string::npos);
  const auto nowhere = Net::listen({.bind = "203.0.113.7", .port = 0}, {});
  EXPECT_FALSE(nowhere.ok());
}

TEST_F(NetTest, ManyWakeUpsBecomeFew) {
  for (int i = 0; i < 100'000; ++i) net_->wake();
  for (const auto latest = std::chrono::steady_clock::now() + 20s;
       woken_ == 0 && std::chrono::steady_clock::now() < latest;)
    std::this_thread::sleep_for(1ms);
  EXPECT_GT(woken_, 0);
  EXPECT_LT(woken_, 100'000);
}

}  // namespace
}  // namespace flexcast::web
