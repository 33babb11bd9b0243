#include "core/scene/place.h"

namespace flexcast {

std::string Place::prefix() const {
  return source + ": " + (owner.empty() ? "" : owner + ": ");
}

void refuse(const Place& place, const std::string& what) {
  throw SceneError(place.prefix() + (place.key.empty() ? "" : place.key + " ") + what);
}

void refuse_owner(const Place& place, const std::string& what) {
  throw SceneError(place.prefix() + what);
}

}  // namespace flexcast
