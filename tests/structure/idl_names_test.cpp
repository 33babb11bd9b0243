// IDL names are case-insensitive: what one compiler accepts another refuses.
#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <fstream>
#include <regex>
#include <set>
#include <string>

namespace {

std::string lower(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(), [](unsigned char c) { return std::tolower(c); });
  return text;
}

TEST(Idl, NoMemberIsCalledLikeAType) {
  std::ifstream file(std::string(FLEXCAST_SOURCE_DIR) + "/idl/flexcast.idl");
  static const std::regex type_pattern(R"(^\s*(?:@final struct|enum|module) (\w+) \{)");
  static const std::regex member_pattern(R"(^\s*(?:@key )?[\w<> ]+ (\w+)(?:\[\d+\])?;)");
  std::set<std::string> types, members;
  std::smatch match;
  for (std::string line; std::getline(file, line);) {
    if (std::regex_search(line, match, type_pattern)) types.insert(lower(match[1]));
    if (std::regex_search(line, match, member_pattern)) members.insert(lower(match[1]));
  }
  EXPECT_GT(types.size(), 20U);
  EXPECT_GT(members.size(), 100U);
  for (const std::string& member : members) EXPECT_FALSE(types.contains(member)) << member;
}

}  // namespace
