#include "idl/wire/topics.h"

#include <gtest/gtest.h>

#include <fstream>
#include <set>
#include <sstream>
#include <string>

#include "idl/wire/idl_text.h"

namespace flexcast::wire {
namespace {

TEST(TopicTable, HasOneRowForEachTopicInTheOrderOfTheirIds) {
  ASSERT_EQ(topic_table().size(), 10u);
  for (std::size_t i = 0; i < topic_table().size(); ++i)
    EXPECT_EQ(static_cast<std::size_t>(topic_table()[i].id), i) << topic_table()[i].name;
}

TEST(TopicTable, NamesAndTypesAreUnique) {
  std::set<std::string> names, types;
  for (const TopicRow& row : topic_table()) {
    EXPECT_TRUE(names.insert(row.name).second) << row.name;
    EXPECT_TRUE(types.insert(std::string(row.type_name)).second) << row.type_name;
    EXPECT_TRUE(std::string_view(row.name).starts_with("flexcast/")) << row.name;
  }
}

TEST(TopicTable, TypeNamesAreThoseOfTheIdl) {
  for (const TopicRow& row : topic_table()) {
    EXPECT_EQ(row.type_name, row.descriptor->m_typename) << row.name;
    const std::string bare(row.type_name.substr(std::string_view("flexcast::").size()));
    EXPECT_NE(idl_text().find("struct " + bare + " {"), std::string_view::npos) << row.name;
  }
}

TEST(TopicTable, EveryTopicIsKeyedByWorld) {
  for (const TopicRow& row : topic_table()) {
    std::set<std::string> keys;
    for (std::uint32_t i = 0; i < row.descriptor->m_nkeys; ++i) keys.insert(row.descriptor->m_keys[i].m_name);
    EXPECT_TRUE(keys.count("world")) << row.name;
  }
}

TEST(TopicTable, NoWriterKeepsAllSoThatNoReaderCanStallIt) {
  for (const TopicRow& row : topic_table()) EXPECT_GT(row.writer.depth, 0) << row.name;
}

TEST(TopicTable, RecordersKeepAllWithinABound) {
  for (const TopicRow& row : topic_table()) {
    EXPECT_EQ(row.recorder.depth, 0) << row.name;
    EXPECT_GT(row.recorder.max_samples, 0) << row.name;
    EXPECT_EQ(row.recorder.transient_local, row.writer.transient_local) << row.name;
  }
}

TEST(FramesQos, KeepsSixtyFourSmallFramesAndAtLeastFourLargeOnes) {
  EXPECT_EQ(frames_writer_qos(24'000).depth, 64);
  EXPECT_EQ(frames_writer_qos(24'000'000).depth, 11);
  EXPECT_EQ(frames_writer_qos(std::size_t{1} << 40).depth, 4);
}

TEST(FramesQos, RecorderIsBoundedByBytes) {
  EXPECT_EQ(frames_recorder_qos(1 << 20, 1).max_samples, 256);
  EXPECT_EQ(frames_recorder_qos(24 << 20, 24).max_samples, 10 * 24);
  EXPECT_EQ(frames_recorder_qos(std::size_t{1} << 32, 4096).max_samples, 4 * 4096);
}

TEST(IdlText, IsTheFile) {
  std::ifstream file(FLEXCAST_SOURCE_DIR "/idl/flexcast.idl", std::ios::binary);
  std::ostringstream content;
  content << file.rdbuf();
  EXPECT_EQ(idl_text(), content.str());
}

}  // namespace
}  // namespace flexcast::wire
