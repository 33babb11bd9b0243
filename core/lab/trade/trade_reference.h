// What runs are compared with: an exact solution, or a run so fine that halving its step proves what it is worth.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "core/lab/trade/trade_runner.h"

namespace flexcast {

// One run of a converged reference.
struct ReferenceLevel {
  double h = 0.0;                    // s
  double seconds = 0.0;              // it took
  std::optional<double> difference;  // m, largest RMS distance over the times to the level before
};

struct TradeReference {
  std::string exact;                   // name of the exact solution; "": converged
  std::vector<std::string> overrides;  // of the finest run
  std::string label;                   // them, or the exact solution, in words
  double error = 0.0;                  // m, its own: largest RMS over the times
  std::optional<double> order;         // observed
  double agreed_until = 0.0;           // s, the time to which the two finest runs agree; see calc_agreed_until
  std::vector<ReferenceLevel> levels;
  TradeFrames frames;
};

struct ReferenceSettings {
  double share = 20.0;  // s it may take
  double size = 1.0;    // m, of the scene
  std::function<void(const std::string& doing)> show = {};
};

// On the finest mesh. Errors: a scene that does not move like that.
Result<TradeReference> make_exact_reference(const std::string& name, const TradeRunner& runner);

// Halves the step until the reference's own error is at most 1e-5 of the size, and further while that is cheap, or the
// share is used up. The error is estimated by L. F. Richardson (Phil. Trans. R. Soc. A 210 (1911) 307-357) from the
// last difference and the order that the last two show, never a better order than the scheme's. Errors: two runs do not
// fit the share; every run fails.
Result<TradeReference> make_converged_reference(const TradeRunner& runner, const ReferenceSettings& settings);

// s: the last of the times before two motions are farther apart than `distance` (m); 0: none is. A motion that is
// chaotic can be known until then, and no longer at any price.
double calc_agreed_until(const TradeFrames& a, const TradeFrames& b, const TradeTimes& times, double distance);

// m, of the finer of two runs whose steps differ by two; `before`: the difference of the pair before.
double calc_own_error(double difference, std::optional<double> before, int order);

}  // namespace flexcast
