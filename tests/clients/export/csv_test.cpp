#include "clients/export/csv.h"

#include <gtest/gtest.h>

namespace flexcast::exporting {
namespace {

TEST(ExportCsv, ColumnsAreNamedAsTheLabNamesThem) {
  const std::vector<Probe> probes = {{"tip", 1}, {"end", 0}};
  EXPECT_EQ(make_csv_header(probes, false), "run,frame,step,time,tip.x,tip.y,tip.z,end.x,end.y,end.z\n");
  EXPECT_EQ(make_csv_header({probes[0]}, true), "run,frame,step,time,tip.x,tip.y,tip.z,tip.vx,tip.vy,tip.vz\n");
}

TEST(ExportCsv, NumbersComeBackBitForBit) {
  client::Frame frame;
  frame.run_id = 18446744073709551615u;
  frame.frame = 3;
  frame.step = 30;
  frame.time = 0.1 + 0.2;
  frame.particles = 2;
  frame.positions = {0, 0, 0, 1.0 / 3, -2, 1e-300};
  frame.velocities = {0, 0, 0, 4, 5, 6};
  EXPECT_EQ(make_csv_row(frame, {{"tip", 1}}, true),
            "18446744073709551615,3,30,0.30000000000000004,0.33333333333333331,-2,1e-300,4,5,6\n");
}

}  // namespace
}  // namespace flexcast::exporting
