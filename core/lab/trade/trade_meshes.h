// The meshes of a study of trades: the scene's own, other elements, more cells; and the particles they share.
#pragma once

#include <string>
#include <vector>

#include "core/base/result.h"
#include "core/lab/trade/trade_options.h"
#include "core/scene/scene.h"

namespace flexcast {

struct TradeMesh {
  std::string element;                 // "": the scene's
  int refinement = 0;                  // cells times 2^refinement
  std::string name;                    // "tet10, refined 2 times"; "" when there is one mesh only
  std::vector<std::string> overrides;  // that make it
  std::int64_t particles = 0, elements = 0;
  std::vector<std::int64_t> compared;  // its particles at the same places at rest in every mesh, in one order
};

struct TradeMeshes {
  std::vector<TradeMesh> all;
  std::size_t finest = 0;            // the most particles
  std::int64_t base_particles = 0;   // of the coarsest
  std::vector<std::int64_t> probes;  // numbers into `compared`, one a probe of the scene that all meshes have
  std::vector<std::string> probe_names;
};

// Loads the scene once a mesh. Errors: what the loader refuses; a mesh file or node numbers where cells should grow.
Result<TradeMeshes> make_trade_meshes(const TradeOptions& options, const Scene& base);

}  // namespace flexcast
