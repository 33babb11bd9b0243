#include "client.h"

#include <unistd.h>

#include <fastdds/rtps/transport/UDPv4TransportDescriptor.h>
#include <fastrtps/utils/IPLocator.h>
#include <algorithm>
#include <fastdds/dds/subscriber/SampleInfo.hpp>
#include <stdexcept>
#include <thread>

namespace flexcast_fastdds {
namespace {

using Clock = std::chrono::steady_clock;
using eprosima::fastdds::rtps::UDPv4TransportDescriptor;
using eprosima::fastrtps::rtps::IPLocator;
using eprosima::fastrtps::rtps::Locator_t;

constexpr auto period = std::chrono::milliseconds(5);

template <class T>
T* made(T* entity, const std::string& what) {
  if (!entity) throw std::runtime_error("Fast DDS cannot create " + what);
  return entity;
}

Locator_t loopback_locator() {
  Locator_t locator;
  locator.kind = LOCATOR_KIND_UDPv4;
  IPLocator::setIPv4(locator, "127.0.0.1");
  return locator;
}

// As our profile `loopback`: UDP on 127.0.0.1 without multicast, so every port where a participant may be is tried.
dds::DomainParticipantQos participant_qos() {
  dds::DomainParticipantQos qos;
  const auto udp = std::make_shared<UDPv4TransportDescriptor>();
  udp->interfaceWhiteList = {"127.0.0.1"};
  udp->maxInitialPeersRange = 51;
  qos.transport().use_builtin_transports = false;
  qos.transport().user_transports.push_back(udp);
  auto& builtin = qos.wire_protocol().builtin;
  builtin.metatrafficUnicastLocatorList.push_back(loopback_locator());
  builtin.initialPeersList.push_back(loopback_locator());
  return qos;
}

// Sequences of any length: the generated types know no bound, so memory grows with the samples.
template <class Qos>
Qos endpoint_qos(Qos qos, int depth) {
  qos.reliability().kind = dds::RELIABLE_RELIABILITY_QOS;
  qos.durability().kind = dds::VOLATILE_DURABILITY_QOS;
  qos.history().kind = dds::KEEP_LAST_HISTORY_QOS;
  qos.history().depth = depth;
  qos.endpoint().history_memory_policy = eprosima::fastrtps::rtps::PREALLOCATED_WITH_REALLOC_MEMORY_MODE;
  return qos;
}

}  // namespace

template <class Type>
dds::Topic* Client::add_topic(const char* name) {
  const dds::TypeSupport type(new Type);
  type.register_type(participant_);
  return made(participant_->create_topic(name, type.get_type_name(), dds::TOPIC_QOS_DEFAULT), name);
}

template <class Type>
dds::DataReader* Client::add_reader(const char* name, int depth) {
  const auto qos = endpoint_qos(dds::DATAREADER_QOS_DEFAULT, depth);
  return made(subscriber_->create_datareader(add_topic<Type>(name), qos), name);
}

template <class Type>
dds::DataWriter* Client::add_writer(const char* name, int depth) {
  auto qos = endpoint_qos(dds::DATAWRITER_QOS_DEFAULT, depth);
  qos.writer_data_lifecycle().autodispose_unregistered_instances = false;
  return made(publisher_->create_datawriter(add_topic<Type>(name), qos), name);
}

Client::Client(int domain, std::string world)
    : world_(std::move(world)), client_id_("fastdds-" + std::to_string(getpid())) {
  auto* factory = dds::DomainParticipantFactory::get_instance();
  participant_ =
      made(factory->create_participant(static_cast<std::uint32_t>(domain), participant_qos()), "participant");
  subscriber_ = made(participant_->create_subscriber(dds::SUBSCRIBER_QOS_DEFAULT), "subscriber");
  publisher_ = made(participant_->create_publisher(dds::PUBLISHER_QOS_DEFAULT), "publisher");
  frames_ = add_reader<flexcast::ParticleFramePubSubType>("flexcast/frames", 4096);
  replies_ = add_reader<flexcast::ReplyPubSubType>("flexcast/replies", 64);
  commands_ = add_writer<flexcast::CommandPubSubType>("flexcast/commands", 64);
}

Client::~Client() {
  if (!participant_) return;
  participant_->delete_contained_entities();
  dds::DomainParticipantFactory::get_instance()->delete_participant(participant_);
}

bool Client::wait_for_match(Duration timeout) {
  const auto end = Clock::now() + timeout;
  for (;;) {
    dds::SubscriptionMatchedStatus frames, replies;
    dds::PublicationMatchedStatus commands;
    frames_->get_subscription_matched_status(frames);
    replies_->get_subscription_matched_status(replies);
    commands_->get_publication_matched_status(commands);
    if (std::min({frames.current_count, replies.current_count, commands.current_count}) > 0) return true;
    if (Clock::now() >= end) return false;
    std::this_thread::sleep_for(period);
  }
}

// Sent again while there is no answer: the server executes it once.
std::optional<flexcast::Reply> Client::send(flexcast::Command command, Duration timeout) {
  command.world(world_);
  command.client_id(client_id_);
  command.request_id(++last_request_);
  auto resend = Clock::now();
  for (const auto end = Clock::now() + timeout; Clock::now() < end; std::this_thread::sleep_for(period)) {
    if (Clock::now() >= resend) {
      commands_->write(&command);
      resend = Clock::now() + std::chrono::seconds(1);
    }
    flexcast::Reply reply;
    dds::SampleInfo info;
    while (replies_->take_next_sample(&reply, &info) == ReturnCode_t::RETCODE_OK) {
      if (info.valid_data && reply.world() == world_ && reply.client_id() == client_id_ &&
          reply.request_id() == last_request_)
        return reply;
    }
  }
  return {};
}

std::vector<flexcast::ParticleFrame> Client::take_frames(Duration timeout) {
  std::vector<flexcast::ParticleFrame> taken;
  for (const auto end = Clock::now() + timeout; taken.empty() && Clock::now() < end;
       std::this_thread::sleep_for(period)) {
    flexcast::ParticleFrame frame;
    dds::SampleInfo info;
    while (frames_->take_next_sample(&frame, &info) == ReturnCode_t::RETCODE_OK)
      if (info.valid_data && frame.world() == world_) taken.push_back(frame);
  }
  return taken;
}

}  // namespace flexcast_fastdds
