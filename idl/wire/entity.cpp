#include "idl/wire/entity.h"

#include <dds/dds.h>

namespace flexcast::wire {

Entity::~Entity() {
  if (handle_ > 0) (void)dds_delete(handle_);
}

Error dds_error(std::string_view what, std::int32_t code) {
  return {std::string(what) + ": " + dds_strretcode(code)};
}

Result<Entity> own_entity(std::string_view what, EntityHandle handle) {
  if (handle < 0) return dds_error(what, handle);
  return Entity(handle);
}

}  // namespace flexcast::wire
