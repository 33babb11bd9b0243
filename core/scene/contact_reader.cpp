#include "core/scene/contact_reader.h"

#include <algorithm>

#include "core/scene/keys.h"
#include "core/scene/parameter_keys.h"

namespace flexcast {
namespace {

using Scope = ParameterRow::Scope;

struct ShapeKeys {
  std::string_view shape;
  Scope scope;
  Obstacle::Shape value;
  std::vector<std::string_view> keys;  // that only this shape has
};

const std::vector<ShapeKeys>& shapes() {
  static const std::vector<ShapeKeys> all = {
      {"plane", Scope::plane, Obstacle::Shape::plane, {"point", "normal"}},
      {"sphere", Scope::sphere, Obstacle::Shape::sphere, {"center", "radius"}},
      {"box", Scope::box, Obstacle::Shape::box, {"lo", "hi"}},
  };
  return all;
}

const ShapeKeys& read_shape(const TableReader& reader) {
  std::vector<std::string_view> names;
  for (const ShapeKeys& row : shapes()) names.push_back(row.shape);
  return *std::ranges::find(shapes(), reader.require_choice("shape", names), &ShapeKeys::shape);
}

void refuse_keys_of_others(const TableReader& reader, const ShapeKeys& shape) {
  for (const ShapeKeys& other : shapes()) {
    if (&other == &shape) continue;
    for (std::string_view key : other.keys)
      if (reader.has(key))
        reader.refuse_value(key, "belongs to shape = \"" + std::string(other.shape) + "\", not to this contact's");
  }
}

void read_plane(const TableReader& reader, Obstacle& plane) {
  plane.point = require_vector_parameter(reader, Scope::plane, "point");
  plane.normal = require_vector_parameter(reader, Scope::plane, "normal");
  if (plane.normal == Vec3::Zero()) reader.refuse_value("normal", "is zero; expected a vector that is not");
}

void read_sphere(const TableReader& reader, Obstacle& sphere) {
  sphere.center = require_vector_parameter(reader, Scope::sphere, "center");
  sphere.radius = require_parameter(reader, Scope::sphere, "radius");
}

void read_box(const TableReader& reader, Obstacle& box) {
  box.lo = require_vector_parameter(reader, Scope::box, "lo");
  box.hi = require_vector_parameter(reader, Scope::box, "hi");
  for (int axis = 0; axis < 3; ++axis)
    if (!(box.lo[axis] < box.hi[axis]))
      reader.refuse_value("lo", std::string("is not below hi along ") + "xyz"[axis] + "; expected lo < hi");
}

}  // namespace

Obstacle read_contact(const TableEntry& entry) {
  const TableReader reader(entry, contact_keys());
  Obstacle obstacle;
  obstacle.name = reader.require_name("name");
  const ShapeKeys& shape = read_shape(reader);
  refuse_keys_of_others(reader, shape);
  obstacle.shape = shape.value;
  switch (obstacle.shape) {
    case Obstacle::Shape::plane:
      read_plane(reader, obstacle);
      break;
    case Obstacle::Shape::sphere:
      read_sphere(reader, obstacle);
      break;
    case Obstacle::Shape::box:
      read_box(reader, obstacle);
      break;
  }
  obstacle.friction = read_parameter(reader, shape.scope, "friction", obstacle.friction);
  obstacle.stiffness = read_parameter(reader, shape.scope, "stiffness", obstacle.stiffness);
  return obstacle;
}

}  // namespace flexcast
