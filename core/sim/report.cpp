#include "core/sim/report.h"

#include <cstdio>

namespace flexcast {

std::string Failure::text() const {
  std::string text = "step " + std::to_string(step) + " failed: " + cause;
  if (!body.empty()) text += ", body " + body;
  if (element >= 0) text += ", element " + std::to_string(element);
  if (particle >= 0) {
    char place[128];
    std::snprintf(place, sizeof place, ", particle %lld at (%.6g, %.6g, %.6g) m", static_cast<long long>(particle),
                  position.x(), position.y(), position.z());
    text += place;
  }
  if (!suggestion.empty()) text += "; " + suggestion;
  return text;
}

}  // namespace flexcast
