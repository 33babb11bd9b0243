#include "core/lab/trade/trade_files.h"

#include <cmath>

#include "core/lab/output_file.h"
#include "core/lab/trade/trade_pictures.h"
#include "core/lab/trade/trade_report.h"

namespace flexcast {
namespace {

std::string quote(const std::string& text) {
  std::string quoted = "\"";
  for (const char c : text) quoted += c == '"' ? std::string("\"\"") : std::string(1, c);
  return quoted + "\"";
}

std::string field(double value) {
  return std::isfinite(value) ? exact_text(value) : "";
}

std::string make_csv_head(const Trade& trade) {
  std::string head =
      "setting,group,integrator,step,iterations,tolerance,element,refinement,particles,elements,status,cause,time,runs,"
      "wall_seconds_per_second,of_motion,of_scene,rms_end,rms_largest,particle_end,particle_largest,energy,volume,"
      "at_reference_limit,on_front";
  for (const std::string& name : trade.meshes.probe_names) head += "," + name + ".end," + name + ".largest";
  return head + "\n";
}

std::string make_csv_errors(const TradeResult& result, const Trade& trade) {
  const TradeErrors& errors = result.errors;
  std::string text;
  for (const double value :
       {result.cost, result.error, errors.rms / trade.size, errors.rms_end, errors.rms, errors.largest_end,
        errors.largest, errors.energy, trade.has_volumes ? errors.volume : std::nan("")})
    text += "," + (result.status == TradeResult::Status::done ? field(value) : "");
  return text;
}

std::string make_csv_row(const TradeResult& result, const Trade& trade) {
  const TradeGroup& group = trade.groups[result.setting.group];
  const TradeMesh& mesh = trade.meshes.all[group.mesh];
  std::string row = quote(result.setting.label) + "," + quote(group.name) + "," + std::string(group.row->name) + "," +
                    (result.h > 0.0 ? field(result.h) : "") + "," +
                    (group.iterations ? std::to_string(*group.iterations) : "") + "," +
                    (group.tolerance ? field(*group.tolerance) : "") + "," + mesh.element + "," +
                    std::to_string(mesh.refinement) + "," + std::to_string(mesh.particles) + "," +
                    std::to_string(mesh.elements) + "," + name_status(result.status) + "," + quote(result.cause) + "," +
                    field(result.time) + "," + std::to_string(result.samples.size());
  row += make_csv_errors(result, trade);
  row += std::string(",") + (result.at_limit ? "1" : "0") + "," + (result.on_front ? "1" : "0");
  for (std::size_t i = 0; i < trade.meshes.probe_names.size(); ++i) {
    const bool done = result.status == TradeResult::Status::done;
    row += "," + (done ? field(result.errors.probes_end[i]) : "") + "," + (done ? field(result.errors.probes[i]) : "");
  }
  return row + "\n";
}

Result<void> write(const std::filesystem::path& path, const std::string& text) {
  auto file = OutputFile::open(path);
  if (!file) return file.error();
  file.value().stream() << text;
  return file.value().close();
}

}  // namespace

Result<void> make_folder(const std::filesystem::path& folder) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (!std::filesystem::is_directory(folder))
    return Error{"-o " + folder.string() +
                 ": the folder cannot be made: " + (error ? error.message() : "it is a file")};
  return {};
}

std::string make_trade_csv(const Trade& trade) {
  std::string text = make_csv_head(trade);
  for (const TradeResult& result : trade.results) text += make_csv_row(result, trade);
  return text;
}

Result<void> write_trade_files(const Trade& trade, const std::filesystem::path& folder) {
  if (auto done = write(folder / "trade.csv", make_trade_csv(trade)); !done) return done;
  if (auto done = write(folder / "trade.json", make_trade_json(trade).dump(2) + "\n"); !done) return done;
  if (auto done = write(folder / "trade.svg", make_svg(make_trade_plot(trade))); !done) return done;
  return write(folder / "order.svg", make_svg(make_order_plot(trade)));
}

}  // namespace flexcast
