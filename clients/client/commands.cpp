// The verbs of Connection: each is one request.
#include "clients/client/connection.h"

namespace flexcast::client {

Result<Reply> Connection::describe() {
  return send({.kind = flexcast_COMMAND_DESCRIBE});
}

Result<Reply> Connection::get(const std::vector<std::string>& names) {
  return send({.kind = flexcast_COMMAND_GET, .names = names});
}

Result<Reply> Connection::set(const std::vector<Parameter>& values, std::optional<std::uint64_t> if_revision) {
  return send({.kind = flexcast_COMMAND_SET, .values = values, .expected_revision = if_revision});
}

Result<Reply> Connection::set_text(std::span<const std::string> assignments, std::optional<std::uint64_t> if_revision) {
  const auto described = describe();
  if (!described) return described.error();
  std::vector<Parameter> values;
  for (const std::string& assignment : assignments) {
    auto parameter = parse_assignment(assignment, described.value().descriptors);
    if (!parameter) return parameter.error();
    values.push_back(std::move(parameter).value());
  }
  return set(values, if_revision);
}

Result<Reply> Connection::pause() {
  return send({.kind = flexcast_COMMAND_PAUSE});
}

Result<Reply> Connection::resume() {
  return send({.kind = flexcast_COMMAND_RESUME});
}

Result<Reply> Connection::reset(bool keep_parameters) {
  return send({.kind = flexcast_COMMAND_RESET, .keep_parameters = keep_parameters});
}

Result<Reply> Connection::step(std::uint64_t count, std::chrono::nanoseconds timeout) {
  return send({.kind = flexcast_COMMAND_STEP, .count = count}, timeout);
}

Result<Reply> Connection::run_until(double time, std::chrono::nanoseconds timeout) {
  return send({.kind = flexcast_COMMAND_RUN_UNTIL, .time = time}, timeout);
}

Result<Reply> Connection::save(const std::string& name) {
  return send({.kind = flexcast_COMMAND_SAVE, .name = name});
}

Result<Reply> Connection::restore(const std::string& name) {
  return send({.kind = flexcast_COMMAND_RESTORE, .name = name});
}

Result<Reply> Connection::load(const std::string& name) {
  return send({.kind = flexcast_COMMAND_LOAD, .name = name});
}

Result<Reply> Connection::grab(std::uint32_t particle, const Vector& target, double stiffness) {
  return send({.kind = flexcast_COMMAND_GRAB, .particle = particle, .target = target, .stiffness = stiffness});
}

Result<Reply> Connection::release(std::uint32_t particle) {
  return send({.kind = flexcast_COMMAND_RELEASE, .particle = particle});
}

}  // namespace flexcast::client
