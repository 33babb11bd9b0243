#include "clients/replay/clips.h"

namespace flexcast::replay {
namespace {

// The first frame in [begin, end) at or after the time; `end` if there is none.
std::size_t find_from(const recording::Index& index, std::size_t begin, std::size_t end, double time) {
  while (begin < end && !has_reached(index.frames()[begin].time, time)) ++begin;
  return begin;
}

// The first frame in [begin, end) that lies after the time; `end` if there is none.
std::size_t find_behind(const recording::Index& index, std::size_t begin, std::size_t end, double time) {
  while (begin < end && has_reached(time, index.frames()[begin].time)) ++begin;
  return begin;
}

}  // namespace

std::vector<Clip> make_clips(const recording::Index& index, std::optional<double> from, std::optional<double> to) {
  std::vector<Clip> clips;
  for (const recording::RunEntry& run : index.runs()) {
    const std::size_t begin = from ? find_from(index, run.begin, run.end, *from) : run.begin;
    const std::size_t end = to ? find_behind(index, begin, run.end, *to) : run.end;
    if (begin < end) clips.push_back({run.run_id, begin, end, begin == run.begin, end == run.end});
  }
  return clips;
}

}  // namespace flexcast::replay
