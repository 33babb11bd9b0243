#include <cmath>

#include "core/lab/trade/trade_report.h"

namespace flexcast {
namespace {

using Json = nlohmann::ordered_json;
using Status = TradeResult::Status;

Json number(double value) {
  return std::isfinite(value) ? Json(value) : Json(nullptr);
}

template <class T>
Json or_null(const std::optional<T>& value) {
  return value ? Json(*value) : Json(nullptr);
}

Json make_errors(const TradeResult& result, const Trade& trade) {
  if (result.status != Status::done) return nullptr;
  const TradeErrors& errors = result.errors;
  Json probes = Json::object();
  for (std::size_t i = 0; i < trade.meshes.probe_names.size(); ++i) {
    probes[trade.meshes.probe_names[i]] = {{"end", number(errors.probes_end[i])},
                                           {"largest", number(errors.probes[i])}};
  }
  return {{"of_motion", number(result.error)},
          {"of_scene", number(errors.rms / trade.size)},
          {"rms_end", number(errors.rms_end)},
          {"rms_largest", number(errors.rms)},
          {"particle_end", number(errors.largest_end)},
          {"particle_largest", number(errors.largest)},
          {"probes", probes},
          {"energy", number(errors.energy)},
          {"volume", trade.has_volumes ? number(errors.volume) : Json(nullptr)}};
}

Json make_setting_json(const TradeResult& result, const Trade& trade) {
  const TradeGroup& group = trade.groups[result.setting.group];
  const TradeMesh& mesh = trade.meshes.all[group.mesh];
  const bool done = result.status == Status::done;
  return {{"setting", result.setting.label},
          {"overrides", result.setting.overrides},
          {"group", group.name},
          {"integrator", group.row->name},
          {"step", result.h > 0.0 ? number(result.h) : Json(nullptr)},
          {"iterations", or_null(group.iterations)},
          {"tolerance", or_null(group.tolerance)},
          {"element", mesh.element.empty() ? Json(nullptr) : Json(mesh.element)},
          {"refinement", mesh.refinement},
          {"particles", mesh.particles},
          {"elements", mesh.elements},
          {"status", name_status(result.status)},
          {"cause", result.cause.empty() ? Json(nullptr) : Json(result.cause)},
          {"time", number(result.time)},
          {"wall_seconds_per_second", done ? number(result.cost) : Json(nullptr)},
          {"run_seconds", result.samples},
          {"errors", make_errors(result, trade)},
          {"at_reference_limit", result.at_limit},
          {"on_front", result.on_front}};
}

Json make_reference_json(const Trade& trade) {
  const TradeReference& reference = trade.reference;
  Json levels = Json::array();
  for (const ReferenceLevel& level : reference.levels) {
    levels.push_back({{"step", number(level.h)},
                      {"seconds", number(level.seconds)},
                      {"difference", level.difference ? number(*level.difference) : Json(nullptr)}});
  }
  return {{"exact", reference.exact.empty() ? Json(nullptr) : Json(reference.exact)},
          {"setting", reference.label},
          {"error", number(reference.error)},
          {"error_of_motion", number(trade.own_error())},
          {"error_of_scene", number(reference.error / trade.size)},
          {"order", reference.order ? number(*reference.order) : Json(nullptr)},
          {"agreed_until", reference.exact.empty() ? number(reference.agreed_until) : Json(nullptr)},
          {"levels", levels}};
}

Json make_orders(const Trade& trade) {
  Json orders = Json::array();
  for (std::size_t i = 0; i < trade.groups.size(); ++i) {
    const int theory = trade.groups[i].row->order;
    Json order = {{"group", trade.groups[i].name}, {"theory", theory > 0 ? Json(theory) : Json(nullptr)}};
    order["observed"] = trade.orders[i] ? number(trade.orders[i]->order) : Json(nullptr);
    order["settings"] = trade.orders[i] ? trade.orders[i]->settings : 0;
    orders.push_back(order);
  }
  return orders;
}

Json make_levels(const Trade& trade) {
  Json levels = Json::array();
  for (const TradeLevel& level : trade.levels) {
    Json setting = nullptr;
    if (level.cheapest >= 0) setting = trade.results[static_cast<std::size_t>(level.cheapest)].setting.label;
    levels.push_back({{"level", level.level},
                      {"setting", setting},
                      {"decidable", level.decidable},
                      {"sentence", make_level_sentence(trade, level)}});
  }
  return levels;
}

}  // namespace

Json make_trade_json(const Trade& trade) {
  const TradeMesh& finest = trade.meshes.all[trade.meshes.finest];
  Json settings = Json::array();
  for (const TradeResult& result : trade.results) settings.push_back(make_setting_json(result, trade));
  return {{"scene", trade.scene},
          {"duration", number(trade.times.duration())},
          {"frame", number(trade.times.frame)},
          {"frames", trade.times.frames()},
          {"compared_frames", trade.times.compared.size()},
          {"base_particles", trade.meshes.base_particles},
          {"compared_particles", finest.compared.size()},
          {"size", number(trade.size)},
          {"motion", number(trade.motion)},
          {"threads", trade.threads},
          {"budget", number(trade.budget)},
          {"spent", number(trade.spent)},
          {"stopped", trade.stopped},
          {"notes", trade.notes},
          {"reference", make_reference_json(trade)},
          {"levels", make_levels(trade)},
          {"orders", make_orders(trade)},
          {"settings", settings}};
}

}  // namespace flexcast
