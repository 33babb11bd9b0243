// The README's tables say what the program's tables say.
#include <gtest/gtest.h>

#include <fstream>
#include <iterator>
#include <string>

#include "core/integrators/integrator.h"
#include "core/lab/bench/bench_report.h"
#include "core/materials/law.h"
#include "core/scene/keys.h"
#include "core/sim/parameters.h"

namespace flexcast {
namespace {

std::string readme() {
  std::ifstream file(std::string(FLEXCAST_SOURCE_DIR) + "/README.md");
  return {std::istreambuf_iterator<char>(file), {}};
}

TEST(Readme, ListsEveryParameterWithUnitRangeAndMeaning) {
  const std::string text = readme();
  for (const ParameterRow& row : parameter_rows()) {
    const bool of_body = has_rows_of(ParameterRow::Scope::fem_body, row.scope) ||
                         has_rows_of(ParameterRow::Scope::spring_body, row.scope);
    std::string start = "| `" + parameter_prefix(row.scope, of_body ? "BODY" : "NAME") + std::string(row.name) + "` | ";
    if (!row.unit.empty()) start += std::string(row.unit) + " ";
    start += "| ";
    if (row.choices.empty()) start += row.range.text() + " | " + std::string(row.description) + " |";
    EXPECT_NE(text.find(start), std::string::npos) << start;
    EXPECT_NE(text.find("| " + std::string(row.description) + " |"), std::string::npos) << row.name;
  }
}

TEST(Readme, NamesEveryKeyOfScenes) {
  const std::string text = readme();
  const std::string table =
      text.substr(text.find("| key | default |"), text.find("A selector is one of") - text.find("| key | default |"));
  std::vector<std::string_view> keys;
  for (const auto& part : {scene_keys(), body_keys(), contact_keys()})
    keys.insert(keys.end(), part.begin(), part.end());
  for (const std::string_view key : keys) {
    const bool named = table.find("`" + std::string(key) + "`") != std::string::npos ||
                       table.find("`[" + std::string(key) + "]`") != std::string::npos ||
                       table.find("`[[" + std::string(key) + "]]`") != std::string::npos;
    EXPECT_TRUE(named) << key;
  }
}

TEST(Readme, ListsEveryIntegratorWithItsOrder) {
  const std::string text = readme();
  for (const IntegratorRow& row : integrators()) {
    const std::string line = "| `" + std::string(row.name) + "` | " +
                             (row.order > 0 ? std::to_string(row.order) : "-") + " | " + std::string(row.summary) +
                             " |";
    EXPECT_NE(text.find(line), std::string::npos) << line;
  }
}

TEST(Readme, NamesEveryFigureOfABenchmark) {
  const std::string text = readme();
  Bench bench;
  bench.elements = bench.particles = 1;
  const nlohmann::ordered_json json = make_bench_json(bench);
  for (const auto& [key, value] : json.items()) EXPECT_NE(text.find("`" + key + "`"), std::string::npos) << key;
}

TEST(Readme, NamesEveryLaw) {
  const std::string text = readme();
  for (const Law& law : laws()) EXPECT_NE(text.find("`" + std::string(law.name) + "`"), std::string::npos) << law.name;
}

}  // namespace
}  // namespace flexcast
