#include "idl/wire/topics.h"

#include <array>
#include <chrono>

namespace flexcast::wire {
namespace {

using namespace std::chrono_literals;

constexpr Qos newest{};                                     // volatile
constexpr Qos everything{.depth = 0, .max_samples = 4096};  // volatile, for recorders
constexpr Qos state{.transient_local = true};               // late readers get the newest
constexpr Qos every_state{.transient_local = true, .depth = 0, .max_samples = 4096};
constexpr Qos health{.transient_local = true, .deadline = 750ms, .lease = 1s};  // written 4 times a second
constexpr Qos every_health{.transient_local = true, .depth = 0, .max_samples = 4096, .deadline = 750ms, .lease = 1s};
constexpr Qos dialogue{.depth = 64};  // of each client
constexpr Qos history{.transient_local = true, .depth = 4096};
constexpr Qos whole_history{.transient_local = true, .depth = 0, .max_samples = 65536};
constexpr Qos frames{.depth = 64};  // of each chunk

template <class T>
constexpr TopicRow row(TopicId id, const char* name, std::string_view type_name, const Qos& writer, const Qos& monitor,
                       const Qos& recorder, bool recorded = true) {
  return {id, name, type_name, &descriptor_of<T>(), writer, monitor, recorder, recorded};
}

const std::array table{
    row<flexcast_SceneInfo>(TopicId::scene, "flexcast/scene", "flexcast::SceneInfo", state, state, every_state),
    row<flexcast_Topology>(TopicId::topology, "flexcast/topology", "flexcast::Topology", state, state, every_state),
    row<flexcast_ParameterSet>(TopicId::parameters, "flexcast/parameters", "flexcast::ParameterSet", state, state,
                               every_state),
    row<flexcast_ParticleFrame>(TopicId::frames, "flexcast/frames", "flexcast::ParticleFrame", frames, newest,
                                everything),
    row<flexcast_Status>(TopicId::status, "flexcast/status", "flexcast::Status", health, health, every_health),
    row<flexcast_Command>(TopicId::commands, "flexcast/commands", "flexcast::Command", dialogue, dialogue, everything),
    row<flexcast_Reply>(TopicId::replies, "flexcast/replies", "flexcast::Reply", dialogue, dialogue, everything),
    row<flexcast_Event>(TopicId::events, "flexcast/events", "flexcast::Event", history, history, whole_history),
    row<flexcast_RecorderInfo>(TopicId::recorders, "flexcast/recorders", "flexcast::RecorderInfo", state, state,
                               every_state, false),
    row<flexcast_RecorderCommand>(TopicId::recorder_commands, "flexcast/recorder_commands", "flexcast::RecorderCommand",
                                  dialogue, dialogue, everything, false),
};

}  // namespace

std::span<const TopicRow> topic_table() {
  return table;
}

const TopicRow& topic(TopicId id) {
  return table[static_cast<std::size_t>(id)];
}

}  // namespace flexcast::wire
