// Recording: everything a finished recording says.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "clients/mcap/reader.h"
#include "tests/system/messages.h"

namespace flexcast::test {

struct Recording {
  mcap::ReadEnd end;
  bool has_footer = false;
  std::map<std::string, std::size_t> messages;  // by topic
  std::vector<FrameMessage> frames;             // samples, in the order of the file
  std::vector<SceneMessage> scenes;
  std::vector<TopologyMessage> topologies;
  std::vector<ParameterSetMessage> parameter_sets;
  std::vector<StatusMessage> statuses;
  std::vector<EventMessage> events;
  std::vector<CommandMessage> commands;
  std::vector<ReplyMessage> replies;
  std::map<std::string, std::string> attachments;  // name -> content
  std::map<std::string, mcap::TextPairs> metadata;

  std::vector<std::uint64_t> run_ids() const;  // of the frames, in the order of their coming
  std::vector<FrameMessage> frames_of(std::uint64_t run_id) const;
  std::vector<EventMessage> command_events(flexcast_CommandKind command) const;  // applied commands of that kind
};

// Decodes every message; throws if one does not decode, belongs to no known topic or has the wrong schema.
Recording read_recording(const std::filesystem::path& file);

// The file is complete: every checksum right, summary and footer there.
void expect_complete(const Recording& recording);

// Frames (of one chunk each) with the numbers first, first + 1, ..., as their MCAP sequence says, too.
void expect_contiguous(const std::vector<FrameMessage>& frames, std::uint64_t first);

}  // namespace flexcast::test
