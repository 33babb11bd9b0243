#include "tests/bench/stream/ddsperf.h"

#include <cmath>
#include <regex>
#include <string>

#include "tests/bench/stream/child.h"

namespace flexcast::bench {
namespace {

// "[31906] 2.000  size 24000 total 72270 lost ..." once a second: the rate between the first line and the last.
std::optional<double> parse_rate(const std::string& said) {
  static const std::regex line(R"(\] (\d+\.\d+) +size \d+ total (\d+) )");
  double first_time = 0, last_time = 0, first_total = 0, last_total = 0;
  int lines = 0;
  for (std::sregex_iterator match(said.begin(), said.end(), line), end; match != end; ++match, ++lines) {
    last_time = std::stod((*match)[1]);
    last_total = std::stod((*match)[2]);
    if (lines == 0) first_time = last_time;
    if (lines == 0) first_total = last_total;
  }
  if (lines < 2) return std::nullopt;
  return (last_total - first_total) / (last_time - first_time);
}

}  // namespace

std::optional<double> measure_ddsperf(int domain, std::size_t bytes, int depth, double seconds) {
  const std::string duration = std::to_string(static_cast<int>(std::ceil(seconds)) + 2);
  const auto arguments = [&](std::vector<std::string> mode) {
    mode.insert(mode.begin(), {"-i", std::to_string(domain), "-D", duration, "-k", std::to_string(depth)});
    return mode;
  };
  Child subscriber("ddsperf", arguments({"sub"}));
  const Child publisher("ddsperf", arguments({"pub", "size", std::to_string(bytes)}));
  return parse_rate(subscriber.hear_all());
}

}  // namespace flexcast::bench
