// StreamWorld: a sheet of springs in real time, with the server's own step loop and publisher, whose steps are timed.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "server/publisher.h"
#include "server/simulation_thread.h"

namespace flexcast::bench {

struct StreamCase {
  std::string name;
  int cells_x = 0, cells_y = 0;  // of the sheet; a particle more each
  double step = 0.0;             // s

  std::size_t particles() const { return static_cast<std::size_t>((cells_x + 1) * (cells_y + 1)); }
  std::size_t frame_bytes() const { return 12 * particles(); }
};

class StreamWorld {
 public:
  // Joins the domain and begins to publish. Ends the bench when it cannot.
  StreamWorld(const StreamCase& stream, int domain);
  ~StreamWorld();

  // Goes on for so long. Returns what each step took, s: the step itself and handing its frame over.
  std::vector<double> run(double seconds);

  std::uint64_t frames_skipped() const { return publisher_.latest().status.frames_skipped; }

 private:
  wire::Participant participant_;
  server::RunIds run_ids_;
  server::World world_;
  server::Queue<server::Command> commands_;
  server::Queue<server::Reply> replies_;
  server::FrameMailbox mailbox_;
  server::SimulationThread simulation_;
  server::Publications publications_;
  server::Publisher publisher_;
};

}  // namespace flexcast::bench
