// flexcast-lab plot: lines from CSV files.
#include "core/lab/plot/plot_verb.h"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <sstream>

#include "core/lab/options.h"

namespace flexcast::test {
namespace {

class PlotVerb : public testing::Test {
 protected:
  void SetUp() override {
    const auto* info = testing::UnitTest::GetInstance()->current_test_info();
    folder_ = std::filesystem::path(testing::TempDir()) / (std::string("flexcast_plot_") + info->name());
    std::filesystem::create_directories(folder_);
    options_.y = {"tip.z"};
    options_.picture = folder_ / "picture.svg";
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  std::filesystem::path write(const std::string& name, const std::string& text) const {
    std::ofstream(folder_ / name) << text;
    return folder_ / name;
  }
  std::string refusal() const {
    const auto plot = make_csv_plot(options_);
    return plot ? "" : plot.error().message;
  }

  std::filesystem::path folder_;
  PlotOptions options_;
};

TEST_F(PlotVerb, DrawsALineForEveryFileAndColumn) {
  const std::string text = "time,tip.x,name,tip.z\n# a comment\n0,1,\"a,b\",2\n0.5,,c,3e-3\r\n";
  options_.files = {write("one.csv", text), write("two.csv", text)};
  options_.y = {"tip.z", "tip.x"};
  const auto plot = make_csv_plot(options_);
  ASSERT_TRUE(plot) << plot.error().message;
  const PlotPanel& panel = plot.value().panels[0];
  ASSERT_EQ(panel.series.size(), 4U);
  EXPECT_EQ(panel.series[0].points, (std::vector<std::array<double, 2>>{{0.0, 2.0}, {0.5, 3e-3}}));
  EXPECT_TRUE(std::isnan(panel.series[1].points[1][1]));
  EXPECT_EQ(panel.series[2].label, "two tip.z");
  EXPECT_EQ(panel.x.title, "time (s)");
  EXPECT_EQ(panel.y.title, "tip.z, tip.x (m)");
}

TEST_F(PlotVerb, WritesThePicture) {
  options_.files = {write("beam.csv", "time,tip.z\n0,1\n1,2\n")};
  std::ostringstream log;
  ASSERT_EQ(plot_verb(options_, log), 0) << log.str();
  std::ifstream file(options_.picture);
  const std::string svg{std::istreambuf_iterator<char>(file), {}};
  EXPECT_TRUE(svg.starts_with("<svg "));
  EXPECT_NE(svg.find(">beam</text>"), std::string::npos);
  options_.picture = folder_ / "none" / "picture.svg";
  EXPECT_EQ(plot_verb(options_, log), 1);
  EXPECT_NE(log.str().find("cannot be written"), std::string::npos);
}

TEST_F(PlotVerb, LabelsAreOneALineOrOneAFile) {
  options_.files = {write("a.csv", "time,tip.z\n0,1\n"), write("b.csv", "time,tip.z\n0,1\n")};
  options_.labels = {"first", "second"};
  EXPECT_EQ(make_csv_plot(options_).value().panels[0].series[1].label, "second");
  options_.labels = {"first"};
  EXPECT_NE(refusal().find("--labels: 1 labels (allowed: 2"), std::string::npos) << refusal();
}

TEST_F(PlotVerb, ADifferenceIsTakenFromTheReferenceBetweenItsRows) {
  const auto reference = write("reference.csv", "time,tip.z\n1,10\n3,30\n");
  options_.files = {write("a.csv", "time,tip.z\n0,1\n1,11\n2,17\n3,30.5\n4,1\n")};
  options_.difference = reference;
  const auto signed_points = make_csv_plot(options_).value().panels[0].series[0].points;
  EXPECT_TRUE(std::isnan(signed_points[0][1]));
  EXPECT_DOUBLE_EQ(signed_points[1][1], 1.0);
  EXPECT_DOUBLE_EQ(signed_points[2][1], -3.0);
  EXPECT_DOUBLE_EQ(signed_points[3][1], 0.5);
  EXPECT_TRUE(std::isnan(signed_points[4][1]));
  options_.logarithmic = "y";
  EXPECT_DOUBLE_EQ(make_csv_plot(options_).value().panels[0].series[0].points[2][1], 3.0);
}

TEST_F(PlotVerb, ErrorsNameFileColumnAndWhatThereIs) {
  options_.files = {write("a.csv", "time,tip.x\n0,1\n")};
  EXPECT_NE(refusal().find("a.csv: no column tip.z (there are: time, tip.x)"), std::string::npos) << refusal();
  options_.files = {write("b.csv", "time,tip.z\n0,1\n1,high\n")};
  EXPECT_NE(refusal().find("b.csv:3: tip.z = high (allowed: a number, or an empty cell)"), std::string::npos);
  options_.files = {write("c.csv", "time,tip.z\n0\n")};
  EXPECT_NE(refusal().find("c.csv:2: 1 cells (allowed: 2"), std::string::npos) << refusal();
  options_.files = {write("d.csv", "# nothing\n")};
  EXPECT_NE(refusal().find("d.csv: no row that names the columns"), std::string::npos);
  options_.files = {folder_ / "none.csv"};
  EXPECT_NE(refusal().find("none.csv: cannot be read"), std::string::npos);
}

TEST_F(PlotVerb, ALineWithManyPointsHasNoMarks) {
  std::string text = "time,tip.z\n";
  for (int i = 0; i < 100; ++i) text += std::to_string(i) + ",1\n";
  options_.files = {write("a.csv", text)};
  EXPECT_EQ(make_csv_plot(options_).value().panels[0].series[0].marks, PlotSeries::Marks::none);
}

TEST(PlotVerbOptions, AreRead) {
  const auto command = parse_lab_command({"plot", "a.csv", "b.csv", "-o", "p.svg", "--x", "h", "--y", "u,v", "--log",
                                          "xy", "--labels", "one,two", "--title", "T", "--difference", "r.csv"});
  const auto* options = std::get_if<PlotOptions>(&command);
  ASSERT_TRUE(options);
  EXPECT_EQ(options->files, (std::vector<std::filesystem::path>{"a.csv", "b.csv"}));
  EXPECT_EQ(options->picture, "p.svg");
  EXPECT_EQ(options->x, "h");
  EXPECT_EQ(options->y, (std::vector<std::string>{"u", "v"}));
  EXPECT_EQ(options->logarithmic, "xy");
  EXPECT_EQ(options->labels, (std::vector<std::string>{"one", "two"}));
  EXPECT_EQ(options->title, "T");
  EXPECT_EQ(options->difference, "r.csv");
}

TEST(PlotVerbOptions, WithoutFileColumnOrPictureAreBadUsage) {
  for (const std::vector<std::string>& arguments :
       std::vector<std::vector<std::string>>{{"plot", "-o", "p.svg", "--y", "u"},
                                             {"plot", "a.csv", "--y", "u"},
                                             {"plot", "a.csv", "-o", "p.svg"},
                                             {"plot", "a.csv", "-o", "p.svg", "--y", "u", "--log", "z"}}) {
    const auto command = parse_lab_command(arguments);
    const auto* end = std::get_if<CommandLineEnd>(&command);
    ASSERT_TRUE(end);
    EXPECT_EQ(end->exit_code, 2);
  }
}

}  // namespace
}  // namespace flexcast::test
