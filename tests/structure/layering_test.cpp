// Includes point one way. The table is the project's: a folder may include itself and what its row lists.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <map>
#include <regex>
#include <set>
#include <string>
#include <vector>

namespace {

namespace fs = std::filesystem;
using Arrows = std::map<std::string, std::vector<std::string>>;

const Arrows arrows = {
    {"core/base", {}},
    {"core/mesh", {"core/base"}},
    {"core/materials", {"core/base"}},
    {"core/state", {"core/mesh"}},
    {"core/forces", {"core/state", "core/materials"}},
    {"core/solvers", {"core/base"}},
    {"core/integrators", {"core/solvers", "core/forces"}},
    {"core/sim", {"core/integrators"}},
    {"core/scene", {"core/sim"}},
    {"core/lab", {"core/scene"}},
    {"idl/wire", {}},
    {"clients/mcap", {}},
    {"clients/client", {"idl/wire"}},
    {"clients/ctl", {"clients/client"}},
    {"clients/record", {"clients/client", "clients/recording"}},
    {"clients/recording", {"clients/mcap", "idl/wire"}},
    {"clients/replay", {"clients/client", "clients/recording"}},
    {"clients/export", {"clients/client", "clients/recording"}},
    {"clients/web", {"clients/client"}},
    {"clients/verify", {"clients/recording", "server/convert"}},
    {"server/convert", {"core/lab", "idl/wire"}},
    {"server", {"server/convert"}},
};

// Headers of a library and the one folder that may see them.
const std::map<std::string, std::string> owners = {
    {R"(^(dds/|ddsc/|flexcast\.h))", "idl/wire"},
    {R"(^boost/)", "clients/web"},
    {R"(^toml)", "core/scene"},
    {R"(^lz4)", "clients/mcap"},
    {R"(^zstd)", "clients/mcap"},
    {R"(^zlib\.h)", "clients/mcap"},
    {R"(^xxhash\.h)", "core/sim"},
    {R"(^tbb/)", "core/base"},
};

struct Include {
  fs::path file;
  std::string folder, target;
  bool quoted;
};

// The longest folder of the table that the path lies in, "" when there is none.
std::string find_folder(const std::string& path) {
  std::string best;
  for (const auto& [folder, allowed] : arrows) {
    if (path.starts_with(folder + "/") && folder.size() > best.size()) best = folder;
  }
  return best;
}

std::set<std::string> reachable(const std::string& folder) {
  std::set<std::string> all = {folder};
  for (const std::string& next : arrows.at(folder)) all.merge(reachable(next));
  return all;
}

std::vector<Include> read_includes() {
  static const std::regex line_pattern(R"(^\s*#\s*include\s*([<"])([^>"]+)[>"])");
  std::vector<Include> includes;
  const fs::path root = FLEXCAST_SOURCE_DIR;
  for (const char* top : {"core", "idl", "server", "clients"}) {
    for (const auto& entry : fs::recursive_directory_iterator(root / top)) {
      const std::string suffix = entry.path().extension();
      if (suffix != ".h" && suffix != ".cpp") continue;
      const std::string relative = fs::relative(entry.path(), root);
      std::ifstream file(entry.path());
      std::smatch match;
      for (std::string line; std::getline(file, line);) {
        if (std::regex_search(line, match, line_pattern)) {
          includes.push_back({relative, find_folder(relative), match[2], match[1] == "\""});
        }
      }
    }
  }
  return includes;
}

TEST(Layering, EverySourceFileLiesInAFolderOfTheTable) {
  for (const Include& include : read_includes()) EXPECT_NE(include.folder, "") << include.file;
}

TEST(Layering, IncludesFollowTheArrows) {
  const auto includes = read_includes();
  ASSERT_GT(includes.size(), 500U);
  for (const Include& include : includes) {
    if (!include.quoted || include.folder.empty()) continue;
    const std::string target = find_folder(include.target);
    EXPECT_NE(target, "") << include.file << " includes \"" << include.target << "\", which is not a path from the top";
    EXPECT_TRUE(reachable(include.folder).contains(target))
        << include.file << " includes " << include.target << ": " << include.folder << " must not see " << target;
  }
}

TEST(Layering, NothingSeesTests) {
  for (const Include& include : read_includes()) EXPECT_FALSE(include.target.starts_with("tests/")) << include.file;
}

TEST(Layering, ThirdPartyLibrariesAreSeenByTheirOneFolder) {
  for (const Include& include : read_includes()) {
    for (const auto& [pattern, folder] : owners) {
      if (!std::regex_search(include.target, std::regex(pattern))) continue;
      EXPECT_EQ(include.folder, folder) << include.file << " includes " << include.target;
    }
  }
}

TEST(Layering, OnlyConvertKnowsBothEngineAndWire) {
  std::map<fs::path, std::set<std::string>> seen;
  for (const Include& include : read_includes()) {
    if (include.folder == "server") seen[include.file].insert(include.target.substr(0, include.target.find('/')));
  }
  for (const auto& [file, tops] : seen) {
    EXPECT_FALSE(tops.contains("core") && tops.contains("idl")) << file << " includes both core and idl";
  }
}

TEST(Layering, TheTopLevelHoldsNothingElse) {
  const std::set<std::string> allowed = {"CMakeLists.txt", "server", "core",      "idl",
                                         "clients",        "tests",  "README.md", "LICENSE"};
  for (const auto& entry : fs::directory_iterator(FLEXCAST_SOURCE_DIR)) {
    const std::string name = entry.path().filename();
    if (name.starts_with(".") || name.starts_with("build")) continue;
    EXPECT_TRUE(allowed.contains(name)) << name;
  }
}

}  // namespace
