#include "clients/record/item_queue.h"

#include <gtest/gtest.h>

#include <thread>

namespace flexcast::record {
namespace {

using namespace std::chrono_literals;

constexpr std::size_t capacity = 1 << 20;

Message message(wire::TopicId topic, std::size_t bytes, std::uint32_t sequence = 0) {
  return {.topic = topic, .sequence = sequence, .bytes = std::vector<std::byte>(bytes)};
}

// How many messages of this kind fit in.
std::size_t fill(ItemQueue& queue, wire::TopicId topic, std::size_t bytes) {
  std::size_t count = 0;
  while (queue.push(message(topic, bytes)) == Pushed::taken) ++count;
  return count;
}

TEST(ItemQueue, NeverHoldsMoreThanItsCapacity) {
  ItemQueue queue(capacity);
  EXPECT_GT(fill(queue, wire::TopicId::events, 1000), 800u);
  EXPECT_EQ(queue.push(message(wire::TopicId::events, 1000)), Pushed::full);
  EXPECT_LE(queue.bytes(), capacity);
}

TEST(ItemQueue, CountsEmptyMessages) {
  ItemQueue queue(capacity);
  EXPECT_LE(fill(queue, wire::TopicId::events, 0), capacity / sizeof(Item));
}

TEST(ItemQueue, KeepsRoomForSmallMessagesWhenFramesFillIt) {
  ItemQueue queue(capacity);
  EXPECT_GT(fill(queue, wire::TopicId::frames, 10'000), 80u);
  EXPECT_EQ(queue.push(message(wire::TopicId::frames, 10'000)), Pushed::full);
  EXPECT_EQ(queue.push(message(wire::TopicId::events, 1000)), Pushed::taken);
}

TEST(ItemQueue, TakesAnItemOfAnySizeWhenEmpty) {
  ItemQueue queue(capacity);
  EXPECT_EQ(queue.push(Attachment{"mesh", "", 0, std::vector<std::byte>(3 * capacity)}), Pushed::taken);
  EXPECT_EQ(queue.push(message(wire::TopicId::events, 0)), Pushed::full);
}

TEST(ItemQueue, LeavesAnItemAsItIsThatItDoesNotTake) {
  ItemQueue queue(capacity);
  fill(queue, wire::TopicId::events, 1000);
  Item item = message(wire::TopicId::events, 1000);
  ASSERT_EQ(queue.push(std::move(item)), Pushed::full);
  EXPECT_EQ(std::get<Message>(item).bytes.size(), 1000u);
}

TEST(ItemQueue, TellsWhoeverWaitsThatThereIsRoom) {
  ItemQueue queue(capacity);
  fill(queue, wire::TopicId::events, 1000);
  std::jthread reader([&] {
    std::this_thread::sleep_for(20ms);
    queue.pop(0ns);
  });
  Item item = message(wire::TopicId::events, 1000);
  Pushed pushed = Pushed::full;
  for (int i = 0; i < 100 && pushed == Pushed::full; ++i) {
    queue.wait_for_room(1s);
    pushed = queue.push(std::move(item));
  }
  EXPECT_EQ(pushed, Pushed::taken);
}

TEST(ItemQueue, HasRoomAgainForWhatWasPopped) {
  ItemQueue queue(capacity);
  fill(queue, wire::TopicId::events, 1000);
  ASSERT_TRUE(queue.pop(0ns));
  EXPECT_EQ(queue.push(message(wire::TopicId::events, 1000)), Pushed::taken);
  while (queue.pop(0ns)) {
  }
  EXPECT_EQ(queue.bytes(), 0u);
}

TEST(ItemQueue, GivesEverythingInOrderToAnotherThreadAndThenFinishes) {
  ItemQueue queue(capacity);
  std::vector<std::uint32_t> popped;
  std::thread consumer([&] {
    while (!queue.finished()) {
      if (auto item = queue.pop(10ms)) popped.push_back(std::get<Message>(*item).sequence);
    }
  });
  for (std::uint32_t i = 0; i < 1000; ++i) {
    ASSERT_EQ(queue.push(message(wire::TopicId::frames, 100, i)), Pushed::taken);
  }
  queue.close();
  consumer.join();
  EXPECT_EQ(queue.push(message(wire::TopicId::frames, 1)), Pushed::closed);
  ASSERT_EQ(popped.size(), 1000u);
  for (std::uint32_t i = 0; i < 1000; ++i) ASSERT_EQ(popped[i], i);
}

TEST(ItemQueue, EndsAWaitWhenItIsClosed) {
  ItemQueue queue(capacity);
  std::thread closer([&] {
    std::this_thread::sleep_for(20ms);
    queue.close();
  });
  EXPECT_FALSE(queue.pop(60s));
  closer.join();
}

}  // namespace
}  // namespace flexcast::record
