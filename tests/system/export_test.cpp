// flexcast-export on recordings of the real server; VTK's own reader (tests/interop/read_vtk.py) reads the files back.
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <sstream>

#include "tests/system/recording.h"
#include "tests/system/scenes.h"
#include "tests/system/system_test.h"

namespace flexcast::test {
namespace {

namespace fs = std::filesystem;

class ExportSystem : public SystemTest {
 protected:
  // 20 steps of the scene, a frame each.
  void record(const std::string& scene) {
    const auto server = start_server(write_file("scene.toml", scene), {"--paused", "--rate", "1"});
    auto connection = connect();
    const auto recorder = start_recorder("run.mcap");
    wait_for_frames(1);
    applied(connection.step(20, patience));
    wait_for_frames(21);
    EXPECT_EQ(end_recorder(*recorder)["gaps"], 0);
    end(*server, SIGTERM);
  }

  // What VTK finds, one object a frame. Debian's Python has Debian's VTK.
  Json read_vtk() const {
    const fs::path script = fs::path(FLEXCAST_SOURCE_DIR) / "tests/interop/read_vtk.py";
    Process python("/usr/bin/python3", {script.string(), path("out/run.pvd").string()});
    if (python.wait(patience) != 0) throw std::runtime_error("read_vtk.py: " + python.err());
    return Json::parse(python.out());
  }

  Json export_json(Arguments arguments) const {
    arguments.insert(arguments.begin(), {path("run.mcap").string(), "--json"});
    const Ended ended = run("flexcast-export", arguments);
    if (ended.code != 0) throw std::runtime_error("flexcast-export failed: " + ended.err);
    return Json::parse(ended.out);
  }
};

TEST_F(ExportSystem, VtkReadsEveryFrameBackBitForBitInDoublePrecision) {
  record(pair_scene());
  const Json summary = export_json({"--vtk", path("out").string(), "--every", "4"});
  EXPECT_EQ(summary["frames"], 6);
  EXPECT_EQ(summary["missing"], Json::array());
  const Recording recording = read_recording(path("run.mcap"));
  const SceneMessage& scene = recording.scenes.front();
  const Json frames = read_vtk();
  ASSERT_EQ(frames.size(), 6U);
  for (std::size_t i = 0; i < frames.size(); ++i) {
    const FrameMessage& recorded = recording.frames[4 * i];
    EXPECT_EQ(frames[i]["time"], recorded.time);
    EXPECT_EQ(frames[i]["time_value"], recorded.time);
    EXPECT_EQ(frames[i]["points"], scene.particles);
    EXPECT_EQ(frames[i]["types"]["10"], scene.bodies[0].tetrahedra);
    EXPECT_EQ(frames[i]["types"]["3"], scene.bodies[1].springs);
    EXPECT_EQ(frames[i]["cells"], scene.bodies[0].tetrahedra + scene.bodies[1].springs);
    EXPECT_EQ(frames[i]["positions"].get<std::vector<double>>(), recorded.positions64);
    EXPECT_EQ(frames[i]["velocity"].get<std::vector<double>>(), recorded.velocities64);
  }
  EXPECT_NEAR(frames[0]["volume"].get<double>(), 0.5 * 0.1 * 0.1,
              1e-12);  // of the beam: its cells are the right way round
  EXPECT_EQ(frames[0]["body"].front(), 0);
  EXPECT_EQ(frames[0]["body"].back(), 1);
}

TEST_F(ExportSystem, SixteenBitPositionsStretchAndStressAreThereAsFloats) {
  std::string scene = pair_scene();
  scene.replace(scene.find("[stream]"), std::string::npos,
                "[stream]\nfields = [\"positions\", \"stretch\", \"stress\"]\nprecision = \"quantized16\"\n");
  record(scene);
  export_json({"--vtk", path("out").string(), "--from", "0.02"});
  const Recording recording = read_recording(path("run.mcap"));
  const FrameMessage& last = recording.frames.back();
  const Json frames = read_vtk();
  ASSERT_EQ(frames.size(), 1U);
  EXPECT_EQ(frames[0]["arrays"], Json::parse(R"({"stretch": "float", "stress": "float"})"));
  const auto positions = frames[0]["positions"].get<std::vector<double>>();
  ASSERT_EQ(positions.size(), last.positions16.size());
  for (std::size_t i = 0; i < positions.size(); ++i) {
    const double low = last.bounds[i % 3], high = last.bounds[i % 3 + 3];
    EXPECT_NEAR(positions[i], low + (high - low) * last.positions16[i] / 65535.0, 1e-6) << i;
  }
}

TEST_F(ExportSystem, TheTableHasTheProbesToTheLastBit) {
  record(pair_scene());
  export_json({"--csv", path("end.csv").string()});
  const Recording recording = read_recording(path("run.mcap"));
  std::ifstream table(path("end.csv"));
  std::string line;
  std::getline(table, line);
  EXPECT_EQ(line, "run,frame,step,time,end.x,end.y,end.z,end.vx,end.vy,end.vz");
  for (const FrameMessage& frame : recording.frames) {
    ASSERT_TRUE(std::getline(table, line));
    std::vector<double> numbers;
    std::istringstream cells(line);
    for (std::string cell; std::getline(cells, cell, ',');) numbers.push_back(std::strtod(cell.c_str(), nullptr));
    ASSERT_EQ(numbers.size(), 10U);
    EXPECT_EQ(numbers[2], static_cast<double>(frame.step));
    EXPECT_EQ(numbers[3], frame.time);
    const std::size_t end = frame.positions64.size() - 3;  // the rope's last particle
    for (std::size_t c = 0; c < 3; ++c) {
      EXPECT_EQ(numbers[4 + c], frame.positions64[end + c]);
      EXPECT_EQ(numbers[7 + c], frame.velocities64[end + c]);
    }
  }
  EXPECT_FALSE(std::getline(table, line));
}

TEST_F(ExportSystem, ExitCodesAreZeroOneAndTwo) {
  record(rope_scene());
  const std::string file = path("run.mcap").string(), csv = path("end.csv").string();
  EXPECT_EQ(run("flexcast-export", {file, "--csv", csv}).code, 0);
  const Ended refused = run("flexcast-export", {file, "--csv", csv});
  EXPECT_EQ(refused.code, 1);
  EXPECT_NE(refused.err.find(csv + " exists already"), std::string::npos) << refused.err;
  EXPECT_EQ(run("flexcast-export", {file, "--csv", csv, "--force"}).code, 0);
  EXPECT_EQ(run("flexcast-export", {file, "--csv", csv, "--force", "--run", "2"}).code, 1);
  EXPECT_EQ(run("flexcast-export", {path("none.mcap").string(), "--csv", csv, "--force"}).code, 1);
  EXPECT_EQ(run("flexcast-export", {file}).code, 2);
  EXPECT_EQ(run("flexcast-export", {"--help"}).code, 0);
}

}  // namespace
}  // namespace flexcast::test
