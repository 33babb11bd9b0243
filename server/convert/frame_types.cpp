#include "server/convert/frame_types.h"

#include <algorithm>

namespace flexcast::server {

StreamFormat make_stream_format(const StreamSettings& settings) {
  const auto has = [&](const char* field) {
    return std::find(settings.fields.begin(), settings.fields.end(), field) != settings.fields.end();
  };
  return {has("positions"), has("velocities"), settings.precision == "float64"};
}

}  // namespace flexcast::server
