// Whole exports of small recordings, read back as text; VTK's own reader comes in the system tests.
#include <gtest/gtest.h>

#include <array>
#include <fstream>
#include <sstream>

#include "clients/export/program.h"
#include "clients/export/report.h"
#include "tests/support/recording_maker.h"

namespace flexcast::exporting {
namespace {

namespace fs = std::filesystem;
using flexcast::test::RecordingMaker;

class ExportTest : public testing::Test {
 protected:
  struct Ended {
    int code = 0;
    std::string out, err;
  };

  Ended run(Options options) {
    options.file = path_;
    testing::internal::CaptureStdout();
    testing::internal::CaptureStderr();
    const int code = run_program(options);
    return {code, testing::internal::GetCapturedStdout(), testing::internal::GetCapturedStderr()};
  }

  static std::string content(const std::string& path) {
    return std::move(std::ostringstream() << std::ifstream(path, std::ios::binary).rdbuf()).str();
  }

  const flexcast::test::TemporaryFolder folder_;
  const std::string path_ = folder_.path("run.mcap");
  const std::string output_ = folder_.path("deep/down/out");
};

TEST_F(ExportTest, AVtkSeriesHasAFileForEachFrameAndOneWithTheTimes) {
  RecordingMaker maker(path_);
  maker.add_run(100, 3, 2);
  maker.close();
  const Ended ended = run({.vtk = output_});
  EXPECT_EQ(ended.code, 0) << ended.err;
  EXPECT_EQ(ended.err, "");
  EXPECT_EQ(ended.out.substr(0, output_.size() + 28), output_ + "/run.pvd: 3 frames, 4 files,");
  for (const char* name : {"/frame_00000000.vtu", "/frame_00000001.vtu", "/frame_00000002.vtu"}) {
    const std::string vtu = content(output_ + name);
    EXPECT_NE(vtu.find("NumberOfPoints=\"6\" NumberOfCells=\"2\""), std::string::npos) << name;
    EXPECT_NE(vtu.find("type=\"Float64\" Name=\"velocity\""), std::string::npos) << name;
    EXPECT_NE(content(output_ + "/run.pvd").find(name + 1), std::string::npos);
  }
}

TEST_F(ExportTest, ATableHasARowForEachFrame) {
  RecordingMaker maker(path_);
  maker.add_run(100, 2);
  maker.close();
  const std::string csv = folder_.path("tip.csv");
  EXPECT_EQ(run({.csv = csv}).code, 0);
  EXPECT_EQ(content(csv),
            "run,frame,step,time,tip.x,tip.y,tip.z,tip.vx,tip.vy,tip.vz\n"
            "100,0,0,0,0.14999999999999999,0.16,0.17000000000000001,-0.14999999999999999,-0.16,-0.17000000000000001\n"
            "100,1,10,0.10000000000000001,1.1499999999999999,1.1599999999999999,1.1699999999999999,"
            "-1.1499999999999999,-1.1599999999999999,-1.1699999999999999\n");
}

TEST_F(ExportTest, WhatIsThereIsNotReplacedUnlessAskedFor) {
  RecordingMaker maker(path_);
  maker.add_run(100, 3);
  maker.close();
  fs::create_directories(output_);
  std::ofstream(output_ + "/frame_00000002.vtu") << "mine";
  const Ended refused = run({.vtk = output_});
  EXPECT_EQ(refused.code, 1);
  EXPECT_NE(refused.err.find("frame_00000002.vtu exists already; --force"), std::string::npos) << refused.err;
  EXPECT_FALSE(fs::exists(output_ + "/frame_00000000.vtu"));
  EXPECT_EQ(run({.vtk = output_, .force = true}).code, 0);
  EXPECT_NE(content(output_ + "/frame_00000002.vtu"), "mine");
  EXPECT_EQ(run({.csv = path_}).code, 1);  // the recording itself
}

TEST_F(ExportTest, MissingFramesAndThoseWithoutAChunkAreNamed) {
  RecordingMaker maker(path_);
  maker.add_run(100, 2, 2);
  maker.add_chunk(100, 2, 1, 0, 2);  // the other half is lost
  maker.add_frame(100, 5, 1, 2);
  maker.close();
  const Ended ended = run({.vtk = output_, .json = true});
  EXPECT_EQ(ended.code, 0);
  EXPECT_NE(ended.err.find("3 frames are missing in the recording: 2, 3-4"), std::string::npos) << ended.err;
  EXPECT_NE(ended.out.find(R"("frames":3,"files":4,)"), std::string::npos) << ended.out;
  EXPECT_NE(ended.out.find(R"("fields":["positions","velocities"],"missing":[{"first":3,"last":4}],"incomplete":[2])"),
            std::string::npos)
      << ended.out;
}

TEST_F(ExportTest, AFrameThatClaimsMoreThanItHoldsIsLeftOut) {
  RecordingMaker maker(path_);
  maker.add_run(100, 1);
  wire::Owned<flexcast_ParticleFrame> frame;
  wire::set_string(frame->world, "beam");
  frame->run_id = 100;
  frame->frame = 1;
  frame->topology_revision = 1;
  frame->chunks = 1;
  frame->total = 0xffffffff;
  wire::copy(frame->positions64, std::array{1.0, 2.0, 3.0});
  maker.add(*frame);
  maker.close();
  const Ended ended = run({.vtk = output_});
  EXPECT_EQ(ended.code, 0);
  EXPECT_NE(ended.err.find("1 frame is missing in the recording: 1"), std::string::npos) << ended.err;
}

TEST_F(ExportTest, WithSeveralRunsItSaysWhichOneItTakes) {
  RecordingMaker maker(path_);
  maker.add_run(100, 2);
  maker.add_run(200, 4);
  maker.close();
  const Ended ended = run({.vtk = output_});
  EXPECT_NE(ended.err.find("exporting run 2 (id 200: 4 frames"), std::string::npos) << ended.err;
  EXPECT_NE(ended.err.find("the others: run 1 (id 100: 2 frames"), std::string::npos) << ended.err;
}

TEST_F(ExportTest, FieldsThatWereNotStreamedAreRefusedBeforeAnythingIsWritten) {
  RecordingMaker maker(path_);
  maker.add_run(100, 2);
  maker.close();
  const Ended ended = run({.vtk = output_, .fields = {"stress"}});
  EXPECT_EQ(ended.code, 1);
  EXPECT_NE(ended.err.find("stress was not streamed; there is: positions, velocities"), std::string::npos) << ended.err;
  EXPECT_FALSE(fs::exists(output_));
}

TEST_F(ExportTest, AFullDiskIsAnErrorThatNamesTheFile) {
  RecordingMaker maker(path_);
  maker.add_run(100, 2);
  maker.close();
  const Ended ended = run({.csv = "/dev/full", .force = true});
  EXPECT_EQ(ended.code, 1);
  EXPECT_NE(ended.err.find("cannot write /dev/full: No space left"), std::string::npos) << ended.err;
}

TEST_F(ExportTest, FramesWithoutTheirTopologyAreAnError) {
  RecordingMaker maker(path_);
  maker.add_scene(100);
  maker.add_frame(100, 0);
  maker.close();
  const Ended ended = run({.vtk = output_});
  EXPECT_EQ(ended.code, 1);
  EXPECT_NE(ended.err.find("the topology of these frames was not recorded"), std::string::npos) << ended.err;
}

TEST_F(ExportTest, ATruncatedRecordingIsExportedAsFarAsItGoes) {
  RecordingMaker maker(path_);
  maker.add_run(100, 2);
  maker.cut();
  const Ended ended = run({.vtk = output_});
  EXPECT_EQ(ended.code, 0);
  EXPECT_NE(ended.err.find("truncated"), std::string::npos) << ended.err;
  EXPECT_TRUE(fs::exists(output_ + "/frame_00000001.vtu"));
}

}  // namespace
}  // namespace flexcast::exporting
