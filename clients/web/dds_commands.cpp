#include "clients/web/dds_commands.h"

#include <unistd.h>

#include <algorithm>
#include <random>

namespace flexcast::web {

DdsCommands::DdsCommands(const wire::Participant& participant, std::string client_id,
                         const wire::Reader<flexcast_Reply>& replies)
    : client_id_(std::move(client_id)),
      replies_(replies),
      writer_(wire::Writer<flexcast_Command>::create(participant)) {}

bool DdsCommands::reaches(const wire::Guid& server) {
  if (!writer_) return false;
  const auto contains = [&](const std::vector<wire::Guid>& peers) {
    return std::find(peers.begin(), peers.end(), server) != peers.end();
  };
  return contains(writer_.value().matched_participants()) && contains(replies_.matched_participants());
}

wire::Result<void> DdsCommands::write(const flexcast_Command& command) {
  if (!writer_) return writer_.error();
  return writer_.value().write(command);
}

std::string make_client_id() {
  std::random_device random;
  return "web-" + std::to_string(getpid()) + "-" + std::to_string(random());
}

}  // namespace flexcast::web
