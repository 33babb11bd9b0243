#include "core/scene/body_reader.h"

#include <algorithm>

#include "core/scene/keys.h"
#include "core/scene/mesh_section.h"
#include "core/scene/parameter_keys.h"
#include "core/scene/selectors.h"
#include "core/scene/suggestion.h"

namespace flexcast {
namespace {

using Scope = ParameterRow::Scope;
constexpr Quantity kilograms{ranges::positive, "kg"};

// Words that paths of parameters and overrides need for themselves.
constexpr std::string_view reserved_names[] = {"time",   "solver", "stream", "gravity", "contact",
                                               "handle", "server", "probe",  "body"};

void check_name(const TableReader& reader, const std::string& name) {
  if (std::ranges::find(reserved_names, name) != std::end(reserved_names))
    reader.refuse_value("name", "is a reserved word (not allowed: " + join(reserved_names) + ")");
}

// Keys that only make sense with the other model.
void refuse_keys_of(const TableReader& reader, const std::string& other_model,
                    const std::vector<std::string_view>& keys) {
  for (std::string_view key : keys)
    if (reader.has(key)) reader.refuse_value(key, "belongs to model = \"" + other_model + "\", not to this body's");
}

void read_material(const TableReader& body, BodyDescription& description) {
  if (!body.has("material")) body.refuse_missing("material", "{ law, young, poisson, density }");
  const TableReader reader(*body.table("material"), {"law", "young", "poisson", "density"});
  std::vector<std::string_view> names;
  for (const Law& law : laws()) names.push_back(law.name);
  description.law = find_law(reader.require_choice("law", names));
  description.young = require_parameter(reader, Scope::fem_body, "young");
  description.poisson = require_parameter(reader, Scope::fem_body, "poisson");
  description.density = require_parameter(reader, Scope::fem_body, "density");
}

void read_springs(const TableReader& body, BodyDescription& description) {
  if (!body.has("springs")) body.refuse_missing("springs", "{ stiffness, damping }");
  const TableReader reader(*body.table("springs"), {"stiffness", "damping"});
  description.spring_stiffness = require_parameter(reader, Scope::spring_body, "stiffness");
  description.spring_damping = read_parameter(reader, Scope::spring_body, "damping", description.spring_damping);
}

void read_masses(const TableReader& body, BodyDescription& description) {
  description.mass = body.number("mass", parameter_quantity(Scope::spring_body, "mass"));
  description.total_mass = body.number("total_mass", kilograms);
  if (!description.mass && !description.total_mass)
    refuse_owner(body.place(), "missing key mass (kg per particle) or total_mass (kg); expected one of them");
  if (description.mass && description.total_mass)
    refuse_owner(body.place(), "has both mass and total_mass; expected one of them");
}

void read_damping(const TableReader& body, bool fem, BodyDescription& description) {
  const auto entry = body.table("damping");
  if (!entry) return;
  const TableReader reader(*entry, {"mass", "stiffness"});
  const Scope scope = fem ? Scope::fem_body : Scope::spring_body;
  description.damping_mass = read_parameter(reader, scope, "mass", description.damping_mass);
  if (!fem && reader.has("stiffness"))
    reader.refuse_value("stiffness", "belongs to model = \"fem\"; springs are damped by springs.damping (N.s)");
  if (fem) description.damping_stiffness = read_parameter(reader, scope, "stiffness", description.damping_stiffness);
}

Selector read_select(const TableReader& reader) {
  return read_selector(reader.require_table("select"));
}

std::array<bool, 3> read_axes(const TableReader& reader) {
  const std::string axes = reader.text("axes").value_or("xyz");
  std::array<bool, 3> pinned = {};
  for (char letter : axes) {
    const std::size_t axis = std::string_view("xyz").find(letter);
    if (axis == std::string_view::npos || pinned[axis])
      reader.refuse_value("axes", "is not right (allowed: some of the letters x, y and z, each once)");
    pinned[axis] = true;
  }
  if (axes.empty()) reader.refuse_value("axes", "is empty (allowed: some of the letters x, y and z, each once)");
  return pinned;
}

std::vector<PinDescription> read_pins(const TableReader& body) {
  std::vector<PinDescription> pins;
  for (const TableEntry& entry : body.tables("pin")) {
    const TableReader reader(entry, {"select", "axes"});
    pins.push_back({read_select(reader), read_axes(reader)});
  }
  return pins;
}

std::vector<VectorDescription> read_vectors(const TableReader& body, std::string_view key, std::string_view unit) {
  std::vector<VectorDescription> vectors;
  for (const TableEntry& entry : body.tables(key)) {
    const TableReader reader(entry, {"select", "value"});
    vectors.push_back({read_select(reader), reader.require_vector("value", {ranges::any, unit})});
  }
  return vectors;
}

std::vector<VelocityDescription> read_velocities(const TableReader& body) {
  std::vector<VelocityDescription> velocities;
  for (const TableEntry& entry : body.tables("velocity")) {
    const TableReader reader(entry, {"select", "value", "spin", "about"});
    VelocityDescription velocity;
    velocity.select = read_select(reader);
    velocity.value = reader.vector("value", {ranges::any, "m/s"}).value_or(velocity.value);
    velocity.spin = reader.vector("spin", {ranges::any, "rad/s"}).value_or(velocity.spin);
    velocity.about = reader.vector("about", {ranges::any, "m"}).value_or(velocity.about);
    velocities.push_back(std::move(velocity));
  }
  return velocities;
}

std::vector<HandleDescription> read_handles(const TableReader& body) {
  constexpr Scope scope = Scope::handle;
  std::vector<HandleDescription> handles;
  for (const TableEntry& entry : body.tables("handle")) {
    const TableReader reader(entry, {"name", "select", "translate", "rotate", "about", "start", "duration"});
    HandleDescription handle;
    handle.name = reader.require_name("name");
    handle.place = reader.place_of("name");
    handle.select = read_select(reader);
    handle.translate = reader.vector("translate", parameter_quantity(scope, "translate")).value_or(handle.translate);
    handle.rotate = reader.vector("rotate", parameter_quantity(scope, "rotate")).value_or(handle.rotate);
    handle.about = reader.vector("about", parameter_quantity(scope, "about"));
    handle.start = reader.number("start", parameter_quantity(scope, "start")).value_or(handle.start);
    handle.duration = reader.number("duration", parameter_quantity(scope, "duration")).value_or(handle.duration);
    handles.push_back(std::move(handle));
  }
  return handles;
}

std::vector<MassDescription> read_particle_masses(const TableReader& body) {
  std::vector<MassDescription> masses;
  for (const TableEntry& entry : body.tables("particle_mass")) {
    const TableReader reader(entry, {"select", "value"});
    masses.push_back({read_select(reader), reader.require_number("value", kilograms)});
  }
  return masses;
}

}  // namespace

std::string owner_name(const TableEntry& entry, std::size_t number) {
  const auto name = entry.table->get_as<std::string>("name");
  return name && is_name(name->get()) ? "\"" + name->get() + "\"" : "number " + std::to_string(number);
}

BodyDescription read_body(const TableEntry& entry, std::size_t number) {
  BodyDescription body;
  body.place = {entry.place.source, "[[body]] " + owner_name(entry, number), ""};
  const TableReader reader({entry.table, body.place}, body_keys());
  body.name = reader.require_name("name");
  check_name(reader, body.name);
  const bool fem = reader.require_choice("model", {"fem", "mass_spring"}) == "fem";
  refuse_keys_of(reader, fem ? "mass_spring" : "fem",
                 fem ? std::vector<std::string_view>{"springs", "mass", "total_mass"}
                     : std::vector<std::string_view>{"material", "element", "surface_force"});
  if (!reader.has("mesh")) reader.refuse_missing("mesh", "{ shape, cells, size } or { file }");
  body.mesh = read_mesh_section(*reader.table("mesh"), fem);
  if (fem) body.quadratic = read_parameter(reader, Scope::fem_body, "element", std::string("tet4")) == "tet10";
  if (fem) read_material(reader, body);
  if (!fem) read_springs(reader, body);
  if (!fem) read_masses(reader, body);
  read_damping(reader, fem, body);
  body.drag = read_parameter(reader, fem ? Scope::fem_body : Scope::spring_body, "drag", body.drag);
  body.origin = reader.vector("origin", {ranges::any, "m"}).value_or(body.origin);
  body.rotation = reader.vector("rotation", {ranges::any, "rad"}).value_or(body.rotation);
  body.particle_masses = read_particle_masses(reader);
  body.pins = read_pins(reader);
  body.displacements = read_vectors(reader, "displacement", "m");
  body.velocities = read_velocities(reader);
  body.forces = read_vectors(reader, "force", "N");
  body.surface_forces = read_vectors(reader, "surface_force", "N");
  body.handles = read_handles(reader);
  return body;
}

}  // namespace flexcast
