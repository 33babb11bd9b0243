#include "clients/web/feed.h"

#include <gtest/gtest.h>

#include "clients/web/dds_commands.h"
#include "tests/clients/web/web.h"
#include "tests/support/fake_server.h"

namespace flexcast::web {
namespace {

using namespace std::chrono_literals;

class FeedTest : public testing::Test {
 protected:
  FeedTest() { feed_->start(); }

  // Takes what comes until `enough` says so; false if that is never.
  bool take_until(const std::function<bool()>& enough) {
    for (const auto latest = std::chrono::steady_clock::now() + 20s; std::chrono::steady_clock::now() < latest;) {
      Delivery delivery = feed_->take();
      for (News& news : delivery.news) news_.push_back(std::move(news));
      for (auto& [world, frame] : delivery.frames) frames_[world] = frame;
      if (enough()) return true;
      std::this_thread::sleep_for(2ms);
    }
    return false;
  }
  template <class T>
  const T* find() const {
    for (const News& news : news_)
      if (const T* found = std::get_if<T>(&news)) return found;
    return nullptr;
  }

  wire::Participant participant_ = test::join_test_domain();
  std::unique_ptr<Feed> feed_ = Feed::create(participant_, "web-test", [] {}).value();
  std::vector<News> news_;
  std::map<std::string, FramePointer> frames_;
};

TEST_F(FeedTest, WorldsAreHeardAndTheirGoodbyes) {
  test::FakeServer server("beam", 42);
  ASSERT_TRUE(take_until([&] { return find<StatusNews>() != nullptr; }));
  EXPECT_EQ(find<StatusNews>()->world, "beam");
  EXPECT_EQ(find<StatusNews>()->server_id, 42u);
  EXPECT_EQ(find<StatusNews>()->server, server.participant().guid());
  ASSERT_TRUE(take_until([&] { return find<StateNews>() != nullptr; }));
  server.say_goodbye();
  ASSERT_TRUE(take_until([&] { return find<EndNews>() != nullptr; }));
  EXPECT_TRUE(find<EndNews>()->on_purpose);
}

TEST_F(FeedTest, FramesAreReadOnlyWhileTheyAreWanted) {
  test::FakeServer server("beam");
  ASSERT_TRUE(take_until([&] { return find<StatusNews>() != nullptr; }));
  EXPECT_FALSE(server.is_read());
  feed_->want({.frames = true});
  ASSERT_TRUE(take_until([&] { return server.is_read(); }));
  feed_->want({});
  EXPECT_TRUE(take_until([&] { return !server.is_read(); }));
}

TEST_F(FeedTest, FramesComeWholeAndAsTheyAreOnTheWire) {
  test::FakeServer server("beam");
  feed_->want({.frames = true});
  ASSERT_TRUE(take_until([&] { return server.is_read(); }));
  server.publish(1, 6, 3, 2);  // its last chunk is lost
  server.publish(1, 7, 3);
  ASSERT_TRUE(take_until([&] { return frames_.contains("beam"); }));
  const WholeFrame& frame = *frames_["beam"];
  EXPECT_EQ(frame.frame, 7u);
  ASSERT_EQ(frame.chunks.size(), 3u);
  EXPECT_FALSE(frame.points);
  for (std::uint32_t i = 0; i < 3; ++i) {
    const auto head = wire::peek_frame_head(frame.chunks[i].bytes);
    ASSERT_TRUE(head.ok());
    EXPECT_EQ(head.value().chunk, i);
    EXPECT_EQ(head.value().frame, 7u);
    EXPECT_GT(frame.chunks[i].time, 0);
  }
}

TEST_F(FeedTest, PointsAreMadeWhenTheyAreWanted) {
  test::FakeServer server("beam");
  feed_->want({.frames = true, .points = {"beam"}});
  ASSERT_TRUE(take_until([&] { return server.is_read(); }));
  server.publish(1, 1, 2);
  ASSERT_TRUE(take_until([&] { return frames_.contains("beam"); }));
  EXPECT_TRUE(frames_["beam"]->points);
}

TEST_F(FeedTest, CommandsReachTheServerAndRepliesComeBack) {
  test::FakeServer server("beam");
  DdsCommands commands(participant_, "web-test", feed_->replies());
  ASSERT_TRUE(commands.may_command());
  Router router(commands, [&](const std::string&) { return server.participant().guid(); });
  std::string outcome;
  const auto begin = Router::Clock::now();
  router.send("beam", {.kind = flexcast_COMMAND_PAUSE}, nullptr, begin,
              [&](const auto& reply) { outcome = reply ? "answered" : reply.error().message; });
  ASSERT_TRUE(take_until([&] {
    router.tick(Router::Clock::now());
    for (const News& news : news_)
      if (const auto* reply = std::get_if<ReplyNews>(&news))
        router.receive(reply->world, reply->request_id, reply->reply);
    return !outcome.empty();
  }));
  EXPECT_EQ(outcome, "answered");
  EXPECT_EQ(server.executed, 1);
}

TEST(NewsBox, OfFramesTheNewestIsKept) {
  NewsBox box;
  for (std::uint64_t i = 0; i < 5; ++i) box.put_frame("beam", make_frame(i));
  box.put_frame("rope", make_frame(9));
  const Delivery delivery = box.take();
  ASSERT_EQ(delivery.frames.size(), 2u);
  EXPECT_EQ(delivery.frames.at("beam")->frame, 4u);
  EXPECT_TRUE(box.take().frames.empty());
}

}  // namespace
}  // namespace flexcast::web
