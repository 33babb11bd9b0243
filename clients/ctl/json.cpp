#include "clients/ctl/json.h"

#include "idl/wire/fill.h"
#include "idl/wire/names.h"

namespace flexcast::ctl {
namespace {

using wire::elements;
using wire::name_of;

std::string string_of(const char* string) {
  return std::string(wire::text(string));
}

Json descriptor_json(const client::Descriptor& d) {
  return {{"name", d.name},
          {"kind", name_of(d.kind)},
          {"unit", d.unit},
          {"initial", to_json(d.initial)},
          {"minimum", d.minimum},
          {"maximum", d.maximum},
          {"minimum_open", d.minimum_open},
          {"maximum_open", d.maximum_open},
          {"choices", d.choices},
          {"live", d.live},
          {"description", d.description}};
}

Json failure_json(const flexcast_Failure& f) {
  return {{"cause", string_of(f.cause)},
          {"body", string_of(f.body)},
          {"element", f.element},
          {"particle", f.particle},
          {"position", f.position},
          {"step", f.step},
          {"suggestion", string_of(f.suggestion)}};
}

}  // namespace

Json to_json(const client::Reply& reply, const std::string& world) {
  Json json{{"outcome", name_of(reply.outcome)}};
  if (!reply.applied()) json["reason"] = reply.reason;
  json["command"] = name_of(reply.kind);
  json["world"] = world;
  json["run_id"] = reply.run_id;
  json["applied_step"] = reply.applied_step;
  json["time"] = reply.time;
  json["state"] = name_of(reply.state);
  json["parameter_revision"] = reply.parameter_revision;
  json["values"] = Json::object();
  for (const auto& [name, value] : reply.values) json["values"][name] = to_json(value);
  if (reply.kind == flexcast_COMMAND_DESCRIBE) {
    json["descriptors"] = Json::array();
    for (const auto& descriptor : reply.descriptors) json["descriptors"].push_back(descriptor_json(descriptor));
  }
  if (reply.kind == flexcast_COMMAND_STEP || reply.kind == flexcast_COMMAND_STATUS)
    json["report"] = to_json(reply.report);
  return json;
}

Json to_json(const flexcast_Status& s) {
  Json json{{"world", string_of(s.world)},
            {"run_id", s.run_id},
            {"state", name_of(s.state)},
            {"step", s.report.step},
            {"time", s.report.time},
            {"heartbeat", s.heartbeat},
            {"rate", s.rate},
            {"real_time_factor", s.real_time_factor},
            {"step_seconds", s.step_seconds},
            {"frames_published", s.frames_published},
            {"frames_skipped", s.frames_skipped},
            {"frame_queue", s.frame_queue},
            {"command_queue", s.command_queue},
            {"readers", s.readers},
            {"parameter_revision", s.parameter_revision},
            {"topology_revision", s.topology_revision},
            {"server_id", s.server_id},
            {"version", string_of(s.version)},
            {"report", to_json(s.report)}};
  if (s.state == flexcast_WORLD_FAILED) json["failure"] = failure_json(s.trouble);
  json["probes"] = json["handles"] = Json::object();
  for (const auto& p : elements(s.probes))
    json["probes"][string_of(p.name)] = {{"position", p.position}, {"velocity", p.velocity}};
  for (const auto& h : elements(s.handles))
    json["handles"][string_of(h.name)] = {{"force", h.force}, {"torque", h.torque}};
  json["warnings"] = wire::strings(s.warnings);
  return json;
}

}  // namespace flexcast::ctl
