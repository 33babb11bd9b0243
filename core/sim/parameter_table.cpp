#include <type_traits>

#include "core/forces/model.h"
#include "core/integrators/integrator.h"
#include "core/sim/parameters.h"
#include "core/sim/settings.h"

namespace flexcast {
namespace {

using Scope = ParameterRow::Scope;
using Kind = ParameterKind;

constexpr Range count{1.0, 1e6, false, false};
constexpr Range tolerance{0.0, 1.0, true, true};
constexpr Range time_tolerance{0.0, 1.0, false, true};
constexpr Range time_budget{0.0, 1e3, false, false};

template <class Row>
std::vector<std::string> names_of(std::span<const Row> rows) {
  std::vector<std::string> names;
  for (const Row& row : rows) names.emplace_back(row.name);
  return names;
}

template <class Value>
constexpr Kind kind_of = std::is_same_v<Value, double> ? Kind::number
                         : std::is_same_v<Value, int>  ? Kind::integer
                         : std::is_same_v<Value, Vec3> ? Kind::vector
                                                       : Kind::choice;

// Name and scene key, where they differ.
struct Names {
  Names(std::string_view both) : name(both), scene_key(both) {}
  Names(const char* both) : name(both), scene_key(both) {}
  Names(std::string_view its_name, std::string_view its_key) : name(its_name), scene_key(its_key) {}
  std::string_view name, scene_key;
};

// A row whose value is the field that access(model, settings, index) refers to.
template <class Access>
ParameterRow field_row(Scope scope, Names names, std::string_view unit, Range range, std::string_view description,
                       Access access) {
  using Value = std::remove_reference_t<std::invoke_result_t<Access, Model&, Settings&, std::size_t>>;
  using Stored = std::conditional_t<std::is_same_v<Value, int>, std::int64_t, Value>;
  ParameterRow row;
  row.scope = scope;
  row.name = names.name;
  row.scene_key = names.scene_key;
  row.kind = kind_of<Value>;
  row.unit = unit;
  row.range = range;
  row.description = description;
  row.get = [access](const Model& model, const Settings& settings, std::size_t index) -> ParameterValue {
    return static_cast<Stored>(access(const_cast<Model&>(model), const_cast<Settings&>(settings), index));
  };
  row.set = [access](Model& model, Settings& settings, std::size_t index, const ParameterValue& value) {
    access(model, settings, index) = static_cast<Value>(std::get<Stored>(value));
  };
  return row;
}

template <class Value, class Part>
ParameterRow settings_row(Names names, std::string_view unit, Range range, std::string_view description,
                          Part Settings::*part, Value Part::*field) {
  return field_row(Scope::scene, names, unit, range, description,
                   [=](Model&, Settings& settings, std::size_t) -> Value& { return settings.*part.*field; });
}

ParameterRow body_row(Scope scope, Names names, std::string_view unit, Range range, std::string_view description,
                      double Body::*field) {
  return field_row(scope, names, unit, range, description,
                   [=](Model& model, Settings&, std::size_t body) -> double& { return model.bodies[body].*field; });
}

template <class Value>
ParameterRow obstacle_row(Scope scope, Names names, std::string_view unit, Range range, std::string_view description,
                          Value Obstacle::*field) {
  return field_row(scope, names, unit, range, description,
                   [=](Model& model, Settings&, std::size_t i) -> Value& { return model.obstacles[i].*field; });
}

template <class Value>
ParameterRow handle_row(Names names, std::string_view unit, Range range, std::string_view description,
                        Value Handle::*field) {
  return field_row(Scope::handle, names, unit, range, description,
                   [=](Model& model, Settings&, std::size_t i) -> Value& { return model.handles[i].*field; });
}

ParameterRow with_choices(ParameterRow row, std::vector<std::string> choices) {
  row.choices = std::move(choices);
  return row;
}

// To be read only.
ParameterRow fixed(ParameterRow row) {
  row.live = false;
  row.set = [](Model&, Settings&, std::size_t, const ParameterValue&) {};
  return row;
}

ParameterRow law_row() {
  ParameterRow row;
  row.scope = Scope::fem_body;
  row.name = "law";
  row.scene_key = "material.law";
  row.kind = Kind::choice;
  row.choices = names_of(laws());
  row.description = "elastic law";
  row.get = [](const Model& model, const Settings&, std::size_t body) -> ParameterValue {
    return std::string(model.bodies[body].law->name);
  };
  row.set = [](Model& model, Settings&, std::size_t body, const ParameterValue& value) {
    model.bodies[body].law = find_law(std::get<std::string>(value));
  };
  return row;
}

ParameterRow element_row() {
  ParameterRow row;
  row.scope = Scope::fem_body;
  row.name = "element";
  row.scene_key = "element";
  row.kind = Kind::choice;
  row.choices = {"tet4", "tet10"};
  row.description = "linear or quadratic tetrahedra";
  row.get = [](const Model& model, const Settings&, std::size_t body) -> ParameterValue {
    return std::string(model.bodies[body].is_quadratic() ? "tet10" : "tet4");
  };
  return fixed(std::move(row));
}

void add_scene_rows(std::vector<ParameterRow>& rows) {
  const auto time = &Settings::time;
  const auto solver = &Settings::solver;
  const auto stream = &Settings::stream;
  rows.push_back(field_row(Scope::scene, "gravity", "m/s^2", ranges::any, "acceleration of everything that has mass",
                           [](Model& model, Settings&, std::size_t) -> Vec3& { return model.gravity; }));
  rows.push_back(
      settings_row("time.step", "s", ranges::positive, "time that one step covers", time, &TimeSettings::step));
  rows.push_back(with_choices(
      settings_row("time.integrator", "", ranges::any, "scheme that takes the steps", time, &TimeSettings::integrator),
      names_of(integrators())));
  rows.push_back(settings_row("time.substeps", "", count, "integrator steps per step", time, &TimeSettings::substeps));
  rows.push_back(settings_row("time.tolerance", "1/s", time_tolerance,
                              "contract: position error made per second over the scene's size; 0: none", time,
                              &TimeSettings::tolerance));
  rows.push_back(settings_row("time.budget", "", time_budget, "contract: wall time per step over time.step; 0: none",
                              time, &TimeSettings::budget));
  rows.push_back(with_choices(settings_row("time.error_estimate", "", ranges::any,
                                           "free: where a scheme gives it for nothing; doubling: by half steps", time,
                                           &TimeSettings::error_estimate),
                              {"free", "doubling"}));
  rows.push_back(with_choices(settings_row("solver.linear", "", ranges::any, "linear solver of implicit schemes",
                                           solver, &SolverSettings::linear),
                              {"auto", "pcg", "ldlt"}));
  rows.push_back(settings_row("solver.linear_tolerance", "", tolerance, "relative residual at which pcg ends", solver,
                              &SolverSettings::linear_tolerance));
  rows.push_back(settings_row("solver.newton_iterations", "", count,
                              "Newton iterations a step at most; 1: linearly implicit", solver,
                              &SolverSettings::newton_iterations));
  rows.push_back(settings_row("solver.newton_tolerance", "", tolerance,
                              "norm of the residual over the norms of its terms", solver,
                              &SolverSettings::newton_tolerance));
  rows.push_back(settings_row("solver.iterations", "", count, "sweeps a step of position-based schemes", solver,
                              &SolverSettings::iterations));
  rows.push_back(settings_row("stream.every", "", count, "publish every n-th step", stream, &StreamSettings::every));
  rows.push_back(fixed(with_choices(
      settings_row("stream.precision", "", ranges::any, "of what is published", stream, &StreamSettings::precision),
      {"float32", "float64", "quantized16"})));
}

void add_body_rows(std::vector<ParameterRow>& rows) {
  rows.push_back(law_row());
  rows.push_back(
      body_row(Scope::fem_body, {"young", "material.young"}, "Pa", ranges::positive, "Young's modulus", &Body::young));
  rows.push_back(body_row(Scope::fem_body, {"poisson", "material.poisson"}, "", ranges::poisson, "Poisson's ratio",
                          &Body::poisson));
  rows.push_back(body_row(Scope::fem_body, {"density", "material.density"}, "kg/m^3", ranges::positive,
                          "density at rest", &Body::density));
  rows.push_back(body_row(Scope::fem_body, "damping.stiffness", "s", ranges::non_negative, "Kelvin-Voigt damping time",
                          &Body::stiffness_damping));
  rows.push_back(element_row());
  rows.push_back(body_row(Scope::spring_body, {"stiffness", "springs.stiffness"}, "N", ranges::non_negative,
                          "k_s of every spring: force per relative extension", &Body::stiffness));
  rows.push_back(body_row(Scope::spring_body, {"damping", "springs.damping"}, "N.s", ranges::non_negative,
                          "k_d of every spring", &Body::damping));
  rows.push_back(
      body_row(Scope::spring_body, "mass", "kg", ranges::positive, "mass of every particle", &Body::particle_mass));
  rows.push_back(body_row(Scope::any_body, "damping.mass", "1/s", ranges::non_negative,
                          "mass-proportional damping rate", &Body::mass_damping));
  rows.push_back(
      body_row(Scope::any_body, "drag", "N.s/m", ranges::non_negative, "drag on every particle", &Body::drag));
}

void add_obstacle_rows(std::vector<ParameterRow>& rows) {
  rows.push_back(obstacle_row(Scope::any_obstacle, "friction", "", ranges::non_negative, "Coulomb's coefficient",
                              &Obstacle::friction));
  rows.push_back(obstacle_row(Scope::any_obstacle, "stiffness", "N/m", ranges::non_negative,
                              "force per depth on a particle; 0: chosen by the engine", &Obstacle::stiffness));
  rows.push_back(obstacle_row(Scope::plane, "point", "m", ranges::any, "a point of the plane", &Obstacle::point));
  rows.push_back(
      obstacle_row(Scope::plane, "normal", "", ranges::any, "into the free side, any length but 0", &Obstacle::normal));
  rows.push_back(obstacle_row(Scope::sphere, "center", "m", ranges::any, "centre of the sphere", &Obstacle::center));
  rows.push_back(
      obstacle_row(Scope::sphere, "radius", "m", ranges::positive, "radius of the sphere", &Obstacle::radius));
  rows.push_back(obstacle_row(Scope::box, "lo", "m", ranges::any, "lower corner of the box", &Obstacle::lo));
  rows.push_back(obstacle_row(Scope::box, "hi", "m", ranges::any, "upper corner of the box", &Obstacle::hi));
}

void add_handle_rows(std::vector<ParameterRow>& rows) {
  rows.push_back(handle_row("translate", "m", ranges::any, "how far it moves", &Handle::translate));
  rows.push_back(handle_row("rotate", "rad", ranges::any, "rotation vector of its turn", &Handle::rotate));
  rows.push_back(handle_row("about", "m", ranges::any, "the point it turns about, before it moves", &Handle::about));
  rows.push_back(handle_row("start", "s", ranges::non_negative, "when the motion begins", &Handle::start));
  rows.push_back(
      handle_row("duration", "s", ranges::non_negative, "how long the motion takes; 0: at once", &Handle::duration));
}

std::vector<ParameterRow> make_rows() {
  std::vector<ParameterRow> rows;
  add_scene_rows(rows);
  add_body_rows(rows);
  add_obstacle_rows(rows);
  add_handle_rows(rows);
  return rows;
}

}  // namespace

std::span<const ParameterRow> parameter_rows() {
  static const std::vector<ParameterRow> rows = make_rows();
  return rows;
}

}  // namespace flexcast
