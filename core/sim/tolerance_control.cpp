#include "core/sim/tolerance_control.h"

#include <algorithm>
#include <cmath>

namespace flexcast {
namespace {

constexpr double margin = 0.9;            // of what is allowed
constexpr double stability_share = 0.95;  // of the stable step
constexpr double refused = 1.3;           // needs so many times the substeps: taken again
constexpr double most_growth = 8.0;       // at once
constexpr double forgotten = 0.8;         // of the envelope, a step
constexpr double kink = 1.5;              // times as many substeps wanted after a refinement
constexpr int most_retries = 5;
constexpr int most_substeps = ToleranceControl::most_substeps;
constexpr int first_substeps = 3;  // with their start they give every derivative that is asked for

int to_substeps(double value) {
  return static_cast<int>(std::ceil(std::clamp(value, 1.0, static_cast<double>(most_substeps))));
}

// c h^p sqrt(|d^p v|^2 + |d^(p-1) v| |d^(p+1) v|); nothing where derivatives are missing.
std::optional<double> calc_rate(int p, double c, double h, const VelocityDerivatives& derivatives) {
  if (derivatives.known < p + 2) return std::nullopt;
  const auto norm = [&](int k) { return derivatives.rms[static_cast<std::size_t>(k)]; };
  return c * std::pow(h, p) * std::sqrt(norm(p) * norm(p) + norm(p - 1) * norm(p + 1));
}

}  // namespace

void ToleranceControl::begin(double length, double stable_step) {
  follow(length, stable_step);
  substeps_ = std::max(least_, first_substeps);
  envelope_ = substeps_;
  retries_ = 0;
  speed_ = 0.0;
}

void ToleranceControl::follow(double length, double stable_step) {
  least_ = std::isfinite(stable_step) && stable_step > 0.0 ? to_substeps(length / (stability_share * stable_step)) : 1;
  substeps_ = std::max(substeps_, least_);
}

// By what factor there should have been more substeps.
double ToleranceControl::calc_need(const JudgedStep& step) {
  const double allowed = margin * step.allowed;
  const double h = step.length / substeps_;
  const int p = std::max(step.row.order, 1);
  if (step.measured) return std::pow(*step.measured / allowed, 1.0 / p);
  const LeadingError& error = step.row.leading_error;
  // Symplectic Euler's own phase is the leapfrog's.
  const double phase = 0.5 * std::abs(error.position + error.velocity);
  const auto rate =
      phase > 0.0 ? calc_rate(p, phase, h, step.derivatives) : calc_rate(2, 1.0 / 24.0, h, step.derivatives);
  speed_ = std::max(speed_, p == 1 ? step.speed : step.derivatives.rms[1]);
  const double passing = 0.5 * std::abs(error.position - error.velocity) * std::pow(h, p) * speed_ / step.elapsed;
  if (!rate) return 1.0;
  return std::max(std::pow(*rate / allowed, 1.0 / (phase > 0.0 ? p : 2)), std::pow(passing / allowed, 1.0 / p));
}

// Refining smooth motion leaves the substeps that are wanted as they are. Where they grow with it the motion has a
// kink, and no number of them would do.
bool ToleranceControl::accept(const JudgedStep& step) {
  const double need = calc_need(step);
  const bool kinked = retries_ > 0 && !(need * substeps_ <= kink * wanted_);
  wanted_ = need * substeps_;
  if (!(need <= refused) && !kinked && retries_ < most_retries && substeps_ < most_substeps) {
    ++retries_;
    substeps_ = std::max(to_substeps(substeps_ * std::min(1.05 * need, most_growth)), first_substeps);
    envelope_ = substeps_;
    return false;
  }
  retries_ = 0;
  envelope_ = kinked ? substeps_ : std::max(std::min(wanted_, most_growth * substeps_), forgotten * envelope_);
  const int enough = std::max(least_, to_substeps(envelope_));
  if (enough > substeps_) {
    substeps_ = enough;
  } else if (enough < 0.9 * substeps_) {
    substeps_ = std::max(enough, static_cast<int>(0.6 * substeps_));
  }
  return true;
}

bool ToleranceControl::retry() {
  if (++retries_ > most_retries || substeps_ >= most_substeps) return false;
  wanted_ = most_substeps;
  substeps_ = to_substeps(2.0 * substeps_);
  envelope_ = substeps_;
  return true;
}

VecX ToleranceControl::save() const {
  return Eigen::Vector4d(substeps_, least_, envelope_, speed_);
}

bool ToleranceControl::restore(const VecX& saved) {
  const auto is_count = [](double value) {
    return value >= 1.0 && value <= most_substeps && value == std::floor(value);
  };
  if (saved.size() != 4 || !saved.allFinite() || !is_count(saved[0]) || !is_count(saved[1])) return false;
  substeps_ = static_cast<int>(saved[0]);
  least_ = static_cast<int>(saved[1]);
  envelope_ = saved[2];
  speed_ = saved[3];
  retries_ = 0;
  return true;
}

}  // namespace flexcast
