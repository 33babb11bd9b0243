#include "core/sim/stream_format.h"

#include <algorithm>

namespace flexcast {

StreamFormat make_stream_format(const StreamSettings& settings) {
  const auto has = [&](const char* field) {
    return std::find(settings.fields.begin(), settings.fields.end(), field) != settings.fields.end();
  };
  StreamFormat format{has("positions"), has("velocities"), StreamPrecision::float32, has("stretch"), has("stress")};
  if (settings.precision == "float64") format.precision = StreamPrecision::float64;
  if (settings.precision == "quantized16") format.precision = StreamPrecision::quantized16;
  return format;
}

}  // namespace flexcast
