// A motion at the times that are compared, and how far another one is from it.
#pragma once

#include <optional>
#include <vector>

#include "core/base/math.h"

namespace flexcast {

// The particles that are compared and the bodies they belong to.
struct TradeFrame {
  VecX positions;  // m, 3 n
  VecX volumes;    // m^3, one a body, 0 for springs
};

struct TradeFrames {
  TradeFrame start;
  std::vector<TradeFrame> at;  // one a time
};

// m, over particles.
double calc_rms(const VecX& difference);
double calc_largest(const VecX& difference);

// m: the largest RMS displacement from the start.
double calc_motion(const TradeFrames& frames);

// Distances between two motions at the last time, and the largest over the times.
struct TradeErrors {
  double rms_end = 0.0, rms = 0.0;          // m, over particles
  double largest_end = 0.0, largest = 0.0;  // m, of a particle
  std::vector<double> probes_end, probes;   // m
  double volume = 0.0;                      // relative, of the body where it is largest
  double energy =
      0.0;  // |numerical| + drift of the closed books over the largest kinetic + elastic; see trade_energy.h
};

// Adds what one time says. `probes` are numbers of compared particles.
void add_frame(const TradeFrame& frame, const TradeFrame& reference, const std::vector<std::int64_t>& probes,
               TradeErrors& errors);

// The largest over the times of the RMS distance, m.
double calc_distance(const TradeFrames& a, const TradeFrames& b);

}  // namespace flexcast
