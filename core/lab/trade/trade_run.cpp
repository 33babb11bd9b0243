#include "core/lab/trade/trade_run.h"

#include <algorithm>
#include <cmath>

namespace flexcast {
namespace {

// Steps between two looks at the clock, so many that a look costs next to nothing.
class Batch {
 public:
  std::int64_t size() const { return size_; }
  void follow(double seconds) {
    if (seconds < 1e-3) size_ = std::min<std::int64_t>(2 * size_, 1 << 20);
    if (seconds > 1e-2) size_ = std::max<std::int64_t>(size_ / 2, 1);
  }

 private:
  std::int64_t size_ = 1;
};

}  // namespace

TradeRun run_to_end(Simulation& simulation, const TradeTimes& times, const TradeBudget& budget, double most_seconds,
                    const std::function<void(std::size_t)>& show) {
  TradeRun run;
  Batch batch;
  const auto frames = static_cast<std::int64_t>(std::llround(simulation.settings().time.step / times.frame));
  const std::int64_t substeps = simulation.settings().time.substeps;
  for (std::size_t i = 0; i < times.compared.size(); ++i) {
    const std::int64_t target = times.compared[i] / frames;
    while (simulation.state().step < target && run.end == TradeRun::End::done) {
      const std::int64_t count = std::min(batch.size(), target - simulation.state().step);
      const double start = budget.clock().now();
      std::int64_t taken = 0;
      while (taken < count && simulation.step()) ++taken;
      budget.clock().stepped(substeps * std::max<std::int64_t>(taken, 1));
      const double seconds = budget.clock().now() - start;
      run.seconds += seconds;
      batch.follow(seconds);
      if (taken < count)
        run.end = TradeRun::End::failed;
      else if (budget.is_stopped())
        run.end = TradeRun::End::stopped;
      else if (run.seconds > most_seconds)
        run.end = TradeRun::End::cut;
    }
    if (run.end != TradeRun::End::done) break;
    if (show) show(i);
  }
  run.time = simulation.state().time;
  if (simulation.failure()) run.cause = simulation.failure()->cause;
  return run;
}

}  // namespace flexcast
