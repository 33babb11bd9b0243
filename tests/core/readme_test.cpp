// The README's tables say what the program's tables say.
#include <gtest/gtest.h>

#include <fstream>
#include <iterator>
#include <string>

#include "core/integrators/integrator.h"
#include "core/materials/law.h"
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
    const bool of_body = row.scope != ParameterRow::Scope::scene;
    std::string start = "| `" + std::string(of_body ? "BODY." : "") + std::string(row.name) + "` | ";
    if (!row.unit.empty()) start += std::string(row.unit) + " ";
    start += "| ";
    if (row.choices.empty()) start += row.range.text() + " | " + std::string(row.description) + " |";
    EXPECT_NE(text.find(start), std::string::npos) << start;
    EXPECT_NE(text.find("| " + std::string(row.description) + " |"), std::string::npos) << row.name;
  }
}

TEST(Readme, ListsEveryIntegratorWithItsOrder) {
  const std::string text = readme();
  for (const IntegratorRow& row : integrators()) {
    const std::string line =
        "| `" + std::string(row.name) + "` | " + std::to_string(row.order) + " | " + std::string(row.summary) + " |";
    EXPECT_NE(text.find(line), std::string::npos) << line;
  }
}

TEST(Readme, NamesEveryLaw) {
  const std::string text = readme();
  for (const Law& law : laws()) EXPECT_NE(text.find("`" + std::string(law.name) + "`"), std::string::npos) << law.name;
}

}  // namespace
}  // namespace flexcast
