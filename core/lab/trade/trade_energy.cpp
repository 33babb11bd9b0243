#include "core/lab/trade/trade_energy.h"

#include <algorithm>
#include <cmath>

namespace flexcast {

void TradeEnergy::add(const Simulation& simulation) {
  const StepReport report = simulation.calc_report();
  const double books = report.kinetic + report.elastic + report.gravity + report.contact - report.work +
                       report.dissipated - report.numerical;
  if (!begun_) start_ = books;
  begun_ = true;
  drift_ = std::max(drift_, std::abs(books - start_));
  numerical_ = std::max(numerical_, std::abs(report.numerical));
  scale_ = std::max(scale_, report.kinetic + report.elastic);
}

double TradeEnergy::calc_error() const {
  return scale_ > 0.0 ? (numerical_ + drift_) / scale_ : 0.0;
}

}  // namespace flexcast
