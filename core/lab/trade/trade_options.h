// The options of the verb `trade`.
#pragma once

#include <atomic>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace flexcast {

struct TradeOptions {
  std::filesystem::path scene;
  std::filesystem::path folder;          // of the files it writes; made when it is not there
  std::optional<double> until;           // s; without it the scene's duration, or 1 s
  std::vector<std::string> integrators;  // default: all but quasi_static
  std::vector<double> steps;             // s, of the integrator; default: a ladder
  std::vector<int> iterations;           // of xpbd and vbd; with 1 also the linearly implicit form of implicit schemes
  std::vector<double> tolerances;        // of the contract time.tolerance
  std::vector<std::string> elements;     // tet4, tet10; default: the scene's
  std::vector<int> refinements;          // cells times 2^r; default: 0
  double budget = 60.0;                  // s, of the whole study
  std::optional<int> repeats;            // of each run; default: as the budget allows
  std::vector<std::string> overrides;    // PATH=VALUE, of every setting
  int threads = 1;                       // of the engine
  bool json = false;
  bool progress = false;                    // on the log while running
  const std::atomic<bool>* stop = nullptr;  // ends the study early when it becomes true
};

}  // namespace flexcast
