#include "server/server.h"

#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include "server/world_claim.h"

namespace flexcast::server {
namespace {

SceneFacts make_facts(const Scene& scene, const std::string& world) {
  return {world.empty() ? scene.name : world,
          scene.name,
          scene.description,
          scene.text,
          scene.overrides,
          scene.files,
          scene.simulation->probes(),
          &scene.simulation->model()};
}

}  // namespace

Result<std::unique_ptr<Server>> Server::start(const Options& options) {
  auto scene = load_scene(options.scene, options.overrides);
  if (!scene) return scene.error();
  for (const auto& note : scene.value().notes) spdlog::info("{}", note);
  auto participant = wire::Participant::create({options.domain, options.profile});
  if (!participant) return Error{participant.error().message};
  const std::uint64_t server_id = RunIds().next();
  auto publications = Publications::create(participant.value(), make_facts(scene.value(), options.world), server_id,
                                           make_stream_format(scene.value().simulation->settings().stream));
  if (!publications) return Error{publications.error().message};

  std::unique_ptr<Server> server(
      new Server(options, std::move(scene).value(), std::move(participant).value(), std::move(publications).value()));
  const auto announce = [&] { server->publications_.publish(server->world_.calc_status(), {}); };
  auto claimed = claim_world(server->participant_, server->publications_.world(), server_id, announce);
  if (!claimed) return Error{claimed.error().message};
  auto service =
      CommandService::create(server->participant_, server->publications_.world(), server->commands_, server->replies_);
  if (!service) return Error{service.error().message};
  server->service_ = std::move(service).value();
  server->publisher_.start();
  server->simulation_.start();
  server->service_->start();
  return server;
}

Server::Server(const Options& options, Scene scene, wire::Participant participant, Publications publications)
    : scene_(std::move(scene)),
      participant_(std::move(participant)),
      world_(*scene_.simulation, {options.rate, options.paused, options.until}, run_ids_),
      mailbox_(scene_.simulation->model().particle_count()),
      simulation_(world_, commands_, replies_, mailbox_),
      publications_(std::move(publications)),
      publisher_(publications_, mailbox_),
      description_(fmt::format("world {} on domain {}, profile {}: {} particles, dt {:g} s, rate {}{}",
                               publications_.world(), participant_.domain(), participant_.profile(),
                               scene_.simulation->model().particle_count(), scene_.simulation->settings().time.step,
                               options.rate > 0.0 ? fmt::format("{:g}", options.rate) : "max",
                               options.paused ? ", paused" : "")) {}

void Server::stop() {
  if (service_) service_->stop_receiving();
  simulation_.stop();
  if (service_) service_->stop_replying();
  publisher_.stop();
}

bool Server::ended() const {
  const WorldState state = simulation_.state();
  return (state == WorldState::finished || state == WorldState::failed) && simulation_.handed_over();
}

}  // namespace flexcast::server
