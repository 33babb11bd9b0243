#include "server/server.h"

#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include "core/base/parallel.h"
#include "core/sim/frame_size.h"
#include "server/name.h"
#include "server/world_claim.h"

namespace flexcast::server {
namespace {

// How many frames the stream keeps for readers that lag depends on what it is made for.
wire::Qos make_frames_qos(const Scene& scene) {
  const Simulation& simulation = *scene.simulation;
  const auto format = make_stream_format(simulation.settings().stream);
  return wire::frames_writer_qos(calc_frame_size(simulation.model().particle_count(), format).bytes);
}

std::unique_ptr<RecorderRoll> make_roll(const Options& options, const wire::Qos& frames) {
  if (!options.lockstep) return nullptr;
  return std::make_unique<RecorderRoll>(
      RecorderRoll::Rules{static_cast<std::size_t>(*options.lockstep), static_cast<std::size_t>(frames.depth)});
}

// From the folder of the scene that the server was started with.
SceneLoader make_scene_loader(const std::string& first_scene, const wire::Qos& frames) {
  return [folder = std::filesystem::path(first_scene).parent_path(), frames](const std::string& name) -> Result<Scene> {
    if (auto checked = check_name(name); !checked) return checked.error();
    auto scene = load_scene(folder / (name + ".toml"));
    if (!scene) return scene;
    if (make_frames_qos(scene.value()).depth < frames.depth) {
      return Error{"the frames of '" + name +
                   "' are too large for this server's stream; start a server with this scene"};
    }
    for (const auto& note : scene.value().notes) spdlog::info("{}", note);
    return scene;
  };
}

}  // namespace

Result<std::unique_ptr<Server>> Server::start(const Options& options) {
  set_thread_count(options.threads);
  auto scene = load_scene(options.scene, options.overrides);
  if (!scene) return scene.error();
  for (const auto& note : scene.value().notes) spdlog::info("{}", note);
  auto participant = wire::Participant::create({options.domain, options.profile, options.security});
  if (!participant) return Error{participant.error().message};
  const std::uint64_t server_id = RunIds().next();
  const std::string world = options.world.empty() ? scene.value().name : options.world;
  const wire::Qos frames = make_frames_qos(scene.value());
  auto publications = Publications::create(participant.value(), world, server_id, frames);
  if (!publications) return Error{publications.error().message};

  const WorldOptions world_options{options.rate, options.paused, options.until,
                                   std::filesystem::path(options.checkpoints) / world,
                                   make_scene_loader(options.scene, frames)};
  auto roll = make_roll(options, frames);
  std::unique_ptr<Server> server(new Server(std::move(scene).value(), world_options, std::move(roll),
                                            std::move(participant).value(), std::move(publications).value()));
  const auto announce = [&] { server->publications_.publish(server->world_.calc_status(), {}); };
  auto claimed = claim_world(server->participant_, server->publications_.world(), server_id, announce);
  if (!claimed) return Error{claimed.error().message};
  auto service =
      CommandService::create(server->participant_, server->publications_.world(), server->commands_, server->replies_);
  if (!service) return Error{service.error().message};
  server->service_ = std::move(service).value();
  if (auto watched = server->watch_recorders(); !watched) return Error{watched.error().message};
  server->publisher_.start();
  server->simulation_.start();
  server->service_->start();
  return server;
}

wire::Result<void> Server::watch_recorders() {
  if (!roll_) return {};
  auto recorders = RecorderWatch::create(participant_, publications_.world(), *roll_, [this] { commands_.wake(); });
  if (!recorders) return recorders.error();
  recorders_ = std::move(recorders).value();
  recorders_->start();
  return {};
}

Server::Server(Scene scene, const WorldOptions& options, std::unique_ptr<RecorderRoll> roll,
               wire::Participant participant, Publications publications)
    : participant_(std::move(participant)),
      world_(std::move(scene), options, run_ids_),
      mailbox_(world_.simulation().model().particle_count(), world_.stream_format()),
      roll_(std::move(roll)),
      simulation_(world_, commands_, replies_, mailbox_, roll_.get()),
      publications_(std::move(publications)),
      publisher_(publications_, mailbox_),
      description_(fmt::format("world {} on domain {}, profile {}: {} particles, dt {:g} s, rate {}{}{}",
                               publications_.world(), participant_.domain(), participant_.profile(),
                               world_.simulation().model().particle_count(), world_.simulation().settings().time.step,
                               options.rate > 0.0 ? fmt::format("{:g}", options.rate) : "max",
                               options.paused ? ", paused" : "", roll_ ? ", in lockstep" : "")) {}

void Server::begin_stop() {
  if (service_) service_->stop_receiving();
  simulation_.begin_stop();
}

void Server::stop() {
  begin_stop();
  simulation_.stop();
  if (recorders_) recorders_->stop();
  if (service_) service_->stop_replying();
  publisher_.stop();
}

std::string Server::cut_off(const std::string& reason) {
  std::string text = fmt::format("{} had not ended {} and was cut off; what was asked meanwhile is not answered",
                                 simulation_.activity(), reason);
  recorders_.reset();
  service_.reset();
  publisher_.stop(text);
  const wire::Participant leaves = std::move(participant_);
  return text;
}

bool Server::ended() const {
  const WorldState state = simulation_.state();
  return (state == WorldState::finished || state == WorldState::failed) && simulation_.handed_over();
}

}  // namespace flexcast::server
