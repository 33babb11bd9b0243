#include "core/sim/checkpoint.h"

#include <xxhash.h>

#include <bit>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <sstream>

namespace flexcast {
namespace {

static_assert(std::endian::native == std::endian::little, "checkpoints are little endian");
constexpr std::string_view magic = "flexckpt";

class Writer {
 public:
  template <class Number>
  void add(Number number) {
    bytes_.append(reinterpret_cast<const char*>(&number), sizeof number);
  }
  void add(std::string_view text) {
    add(static_cast<std::uint64_t>(text.size()));
    bytes_.append(text);
  }
  void add(const VecX& vector) {
    add(static_cast<std::uint64_t>(vector.size()));
    bytes_.append(reinterpret_cast<const char*>(vector.data()),
                  sizeof(double) * static_cast<std::size_t>(vector.size()));
  }
  void add(const Vec3& vector) {
    for (const double component : vector) add(component);
  }
  void add_raw(std::string_view bytes) { bytes_.append(bytes); }
  const std::string& bytes() const { return bytes_; }

 private:
  std::string bytes_;
};

// Reads what the writer wrote; once something does not fit, everything is zero and failed() true.
class Reader {
 public:
  explicit Reader(std::string_view bytes) : rest_(bytes) {}

  template <class Number>
  Number number() {
    Number value{};
    const std::string_view bytes = take(sizeof value);
    if (!bytes.empty()) std::memcpy(&value, bytes.data(), sizeof value);
    return value;
  }
  std::string text() { return std::string(take(number<std::uint64_t>())); }
  VecX vector() {
    const auto size = number<std::uint64_t>();
    if (size > rest_.size() / sizeof(double)) return failed_ = true, VecX();
    VecX vector(static_cast<Eigen::Index>(size));
    const std::string_view bytes = take(size * sizeof(double));
    if (!bytes.empty()) std::memcpy(vector.data(), bytes.data(), bytes.size());
    return vector;
  }
  Vec3 vec3() {
    const double x = number<double>(), y = number<double>(), z = number<double>();
    return {x, y, z};
  }
  // How many entries follow, each of at least `size` bytes.
  std::size_t count(std::size_t size) {
    const auto count = number<std::uint64_t>();
    if (count > rest_.size() / size) return failed_ = true, 0;
    return count;
  }
  bool failed() const { return failed_; }
  bool at_end() const { return rest_.empty(); }

 private:
  std::string_view take(std::uint64_t size) {
    if (failed_ || size > rest_.size()) return failed_ = true, std::string_view();
    const std::string_view bytes = rest_.substr(0, size);
    rest_.remove_prefix(size);
    return bytes;
  }

  std::string_view rest_;
  bool failed_ = false;
};

void add_value(Writer& writer, const ParameterValue& value) {
  writer.add(static_cast<std::uint8_t>(value.index()));
  std::visit(
      [&](const auto& content) {
        using Content = std::decay_t<decltype(content)>;
        if constexpr (std::is_same_v<Content, std::string>) {
          writer.add(std::string_view(content));
        } else {
          writer.add(content);
        }
      },
      value);
}

Result<ParameterValue> read_value(Reader& reader) {
  switch (static_cast<ParameterKind>(reader.number<std::uint8_t>())) {
    case ParameterKind::number:
      return ParameterValue(reader.number<double>());
    case ParameterKind::integer:
      return ParameterValue(reader.number<std::int64_t>());
    case ParameterKind::vector:
      return ParameterValue(reader.vec3());
    case ParameterKind::choice:
      return ParameterValue(reader.text());
  }
  return Error{"the checkpoint has a value of an unknown kind"};
}

template <class Element>
void add_elements(Writer& writer, const std::vector<Element>& elements) {
  writer.add_raw({reinterpret_cast<const char*>(elements.data()), sizeof(Element) * elements.size()});
}

}  // namespace

std::uint64_t calc_fingerprint(const Model& model, const State& initial) {
  Writer writer;
  writer.add(model.rest_positions);
  writer.add(initial.positions);
  writer.add(initial.velocities);
  writer.add(model.external_forces);
  add_elements(writer, model.tetrahedra);
  add_elements(writer, model.midsides);
  add_elements(writer, model.springs);
  add_elements(writer, model.fixed);
  for (const Body& body : model.bodies) {
    writer.add(std::string_view(body.name));
    for (const IndexRange range : {body.particles, body.tetrahedra, body.midsides, body.springs}) {
      writer.add(range.first);
      writer.add(range.count);
    }
    for (const ParticleMass& mass : body.mass_overrides) {
      writer.add(mass.particle);
      writer.add(mass.value);
    }
  }
  for (const Handle& handle : model.handles) {
    writer.add(std::string_view(handle.name));
    add_elements(writer, handle.particles);
    for (const Vec3& base : handle.base) writer.add(base);
  }
  for (const Obstacle& obstacle : model.obstacles) {
    writer.add(std::string_view(obstacle.name));
    writer.add(static_cast<std::int32_t>(obstacle.shape));
  }
  return XXH3_64bits(writer.bytes().data(), writer.bytes().size());
}

std::string encode_checkpoint(const Checkpoint& checkpoint) {
  Writer writer;
  writer.add_raw(magic);
  writer.add(checkpoint_version);
  writer.add(checkpoint.fingerprint);
  writer.add(checkpoint.state.step);
  writer.add(checkpoint.state.time);
  writer.add(checkpoint.state.positions);
  writer.add(checkpoint.state.velocities);
  writer.add(checkpoint.base_step);
  writer.add(checkpoint.base_time);
  writer.add(checkpoint.history);
  writer.add(checkpoint.books);
  writer.add(static_cast<std::uint64_t>(checkpoint.grabs.size()));
  for (const Grab& grab : checkpoint.grabs) {
    writer.add(grab.particle);
    writer.add(grab.target);
    writer.add(grab.stiffness);
  }
  writer.add(checkpoint.contract);
  writer.add(static_cast<std::uint64_t>(checkpoint.values.size()));
  for (const ParameterAssignment& assignment : checkpoint.values) {
    writer.add(std::string_view(assignment.name));
    add_value(writer, assignment.value);
  }
  writer.add(static_cast<std::uint64_t>(XXH3_64bits(writer.bytes().data(), writer.bytes().size())));
  return writer.bytes();
}

Result<Checkpoint> decode_checkpoint(std::string_view bytes) {
  constexpr std::size_t frame = magic.size() + sizeof checkpoint_version + sizeof(std::uint64_t);
  if (bytes.size() < frame || bytes.substr(0, magic.size()) != magic) return Error{"this is not a checkpoint"};
  Reader reader(bytes.substr(magic.size(), bytes.size() - magic.size() - sizeof(std::uint64_t)));
  const auto version = reader.number<std::uint32_t>();
  if (version != checkpoint_version) {
    return Error{"the checkpoint has version " + std::to_string(version) + "; this program reads version " +
                 std::to_string(checkpoint_version)};
  }
  Reader tail(bytes.substr(bytes.size() - sizeof(std::uint64_t)));
  if (tail.number<std::uint64_t>() != XXH3_64bits(bytes.data(), bytes.size() - sizeof(std::uint64_t))) {
    return Error{"the checkpoint is damaged or cut short: its checksum does not fit"};
  }
  Checkpoint checkpoint;
  checkpoint.fingerprint = reader.number<std::uint64_t>();
  checkpoint.state.step = reader.number<std::int64_t>();
  checkpoint.state.time = reader.number<double>();
  checkpoint.state.positions = reader.vector();
  checkpoint.state.velocities = reader.vector();
  checkpoint.base_step = reader.number<std::int64_t>();
  checkpoint.base_time = reader.number<double>();
  checkpoint.history = reader.vector();
  checkpoint.books = reader.number<EnergyBooks>();
  const std::size_t grabs = reader.count(sizeof(std::int32_t) + 4 * sizeof(double));
  for (std::size_t i = 0; i < grabs; ++i) {
    const auto particle = reader.number<std::int32_t>();
    const Vec3 target = reader.vec3();
    checkpoint.grabs.push_back({particle, target, reader.number<double>()});
  }
  checkpoint.contract = reader.vector();
  const std::size_t values = reader.count(sizeof(std::uint64_t) + 1);
  for (std::size_t i = 0; i < values; ++i) {
    std::string name = reader.text();
    auto value = read_value(reader);
    if (!value) return value.error();
    checkpoint.values.push_back({std::move(name), std::move(value).value()});
  }
  if (reader.failed() || !reader.at_end()) return Error{"the checkpoint is damaged: its parts do not fit together"};
  return checkpoint;
}

Result<void> write_checkpoint(const std::filesystem::path& path, const Checkpoint& checkpoint) {
  const std::string bytes = encode_checkpoint(checkpoint);
  std::filesystem::path temporary = path;
  temporary += ".part";
  errno = 0;
  std::ofstream file(temporary, std::ios::binary | std::ios::trunc);
  file.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  file.close();
  std::error_code error;
  if (file) std::filesystem::rename(temporary, path, error);
  if (file && !error) return {};
  const std::string reason = error ? error.message() : errno ? std::strerror(errno) : "unknown reason";
  std::filesystem::remove(temporary, error);
  return Error{path.string() + ": cannot be written: " + reason};
}

Result<Checkpoint> read_checkpoint(const std::filesystem::path& path) {
  errno = 0;
  std::ifstream file(path, std::ios::binary);
  std::ostringstream bytes;
  if (file.peek() != std::ifstream::traits_type::eof()) bytes << file.rdbuf();
  if (!file.is_open() || file.bad()) {
    return Error{path.string() + ": cannot be read: " + (errno ? std::strerror(errno) : "unknown reason")};
  }
  auto checkpoint = decode_checkpoint(bytes.view());
  if (!checkpoint) return Error{path.string() + ": " + checkpoint.error().message};
  return checkpoint;
}

}  // namespace flexcast
