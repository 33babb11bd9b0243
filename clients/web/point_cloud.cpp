#include "clients/web/point_cloud.h"

#include <cmath>
#include <cstring>
#include <functional>
#include <string>

namespace flexcast::web {
namespace {

constexpr std::string_view idl = R"(module foxglove {
  @final struct Time { unsigned long sec; unsigned long nsec; };
  @final struct Vector3 { double x; double y; double z; };
  @final struct Quaternion { double x; double y; double z; double w; };
  @final struct Pose { Vector3 position; Quaternion orientation; };
  enum NumericType { UNKNOWN, UINT8, INT8, UINT16, INT16, UINT32, INT32, FLOAT32, FLOAT64 };
  @final struct PackedElementField {
    string name;
    unsigned long offset;
    NumericType type;
  };
  @final struct PointCloud {
    Time timestamp;
    string frame_id;
    Pose pose;
    unsigned long point_stride;
    sequence<PackedElementField> fields;
    sequence<octet> data;
  };
};
)";

constexpr std::uint32_t float32 = 7;  // NumericType
constexpr std::int64_t second = 1'000'000'000;

// Little-endian XCDR1; alignment counts from the end of the header.
class CdrWriter {
 public:
  template <class T>
  void put(T value) {
    while ((bytes_.size() - 4) % sizeof value != 0) bytes_.push_back({});
    append(&value, sizeof value);
  }
  void put_string(std::string_view text) {
    put(static_cast<std::uint32_t>(text.size() + 1));
    append(text.data(), text.size());
    bytes_.push_back({});
  }
  // Room for so many bytes, and where they begin.
  std::byte* put_room(std::size_t size) {
    put(static_cast<std::uint32_t>(size));
    bytes_.resize(bytes_.size() + size);
    return bytes_.data() + bytes_.size() - size;
  }
  std::vector<std::byte> take() { return std::move(bytes_); }

 private:
  void append(const void* data, std::size_t size) {
    const auto* first = static_cast<const std::byte*>(data);
    bytes_.insert(bytes_.end(), first, first + size);
  }
  std::vector<std::byte> bytes_{std::byte{0}, std::byte{1}, std::byte{0}, std::byte{0}};
};

struct CloudField {
  std::string_view name;
  std::function<double(std::size_t)> value;  // of a particle
};

std::vector<CloudField> choose_fields(const client::Frame& frame) {
  std::vector<CloudField> fields;
  for (const auto& [name, axis] : {std::pair("x", 0u), std::pair("y", 1u), std::pair("z", 2u)})
    fields.push_back({name, [&frame, a = axis](std::size_t i) { return frame.positions[3 * i + a]; }});
  if (!frame.velocities.empty()) {
    fields.push_back({"speed", [&frame](std::size_t i) {
                        const auto v = frame.velocity(i);
                        return std::hypot(v[0], v[1], v[2]);
                      }});
  }
  if (!frame.stretch.empty()) fields.push_back({"stretch", [&frame](std::size_t i) { return frame.stretch[i]; }});
  if (!frame.stress.empty()) fields.push_back({"stress", [&frame](std::size_t i) { return frame.stress[i]; }});
  return fields;
}

}  // namespace

std::string_view point_cloud_idl() {
  return idl;
}

std::vector<std::byte> make_point_cloud(const client::Frame& frame, std::int64_t time) {
  const std::vector<CloudField> fields = choose_fields(frame);
  const std::size_t particles = frame.positions.size() / 3;
  CdrWriter cdr;
  cdr.put(static_cast<std::uint32_t>(time / second));
  cdr.put(static_cast<std::uint32_t>(time % second));
  cdr.put_string("world");
  for (const double pose : {0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0}) cdr.put(pose);
  cdr.put(static_cast<std::uint32_t>(fields.size() * sizeof(float)));
  cdr.put(static_cast<std::uint32_t>(fields.size()));
  std::uint32_t offset = 0;
  for (const CloudField& field : fields) {
    cdr.put_string(field.name);
    cdr.put(offset);
    cdr.put(float32);
    offset += sizeof(float);
  }
  std::byte* to = cdr.put_room(particles * fields.size() * sizeof(float));
  for (std::size_t i = 0; i < particles; ++i) {
    for (const CloudField& field : fields) {
      const auto value = static_cast<float>(field.value(i));
      std::memcpy(to, &value, sizeof value);
      to += sizeof value;
    }
  }
  return cdr.take();
}

}  // namespace flexcast::web
