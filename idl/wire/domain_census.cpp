#include "idl/wire/domain_census.h"

#include <dds/dds.h>

#include <algorithm>
#include <array>

#include "idl/wire/fill.h"

namespace flexcast::wire {
namespace {

constexpr std::size_t most = 1024;  // of each kind

Guid guid_of(const dds_guid_t& raw) {
  Guid guid{};
  std::copy(std::begin(raw.v), std::end(raw.v), guid.begin());
  return guid;
}

// Reads without taking: the readers keep what they know.
template <class T, class Visit>
void visit_alive(EntityHandle reader, Visit visit) {
  std::vector<void*> samples(most, nullptr);
  std::vector<dds_sample_info_t> infos(most);
  const dds_return_t count = dds_read(reader, samples.data(), infos.data(), most, most);
  for (dds_return_t i = 0; i < count; ++i) {
    const auto& info = infos[static_cast<std::size_t>(i)];
    if (info.valid_data && info.instance_state == DDS_IST_ALIVE) {
      visit(*static_cast<const T*>(samples[static_cast<std::size_t>(i)]));
    }
  }
  if (count > 0) (void)dds_return_loan(reader, samples.data(), count);
}

}  // namespace

Result<DomainCensus> DomainCensus::create(const Participant& participant) {
  const auto read = [&](dds_entity_t topic) {
    return own_entity("cannot ask who is on the domain",
                      dds_create_reader(participant.handle(), topic, nullptr, nullptr));
  };
  auto participants = read(DDS_BUILTIN_TOPIC_DCPSPARTICIPANT);
  if (!participants) return participants.error();
  auto writers = read(DDS_BUILTIN_TOPIC_DCPSPUBLICATION);
  if (!writers) return writers.error();
  return DomainCensus(participant.guid(), std::move(participants).value(), std::move(writers).value());
}

std::vector<Guid> DomainCensus::participants() const {
  std::vector<Guid> found;
  visit_alive<dds_builtintopic_participant_t>(participants_.handle(), [&](const auto& one) {
    if (const Guid guid = guid_of(one.key); guid != own_) found.push_back(guid);
  });
  return found;
}

std::vector<RemoteWriter> DomainCensus::writers() const {
  std::vector<RemoteWriter> found;
  visit_alive<dds_builtintopic_endpoint_t>(writers_.handle(), [&](const auto& one) {
    const Guid guid = guid_of(one.participant_key);
    if (guid != own_) found.push_back({guid, std::string(text(one.topic_name)), std::string(text(one.type_name))});
  });
  return found;
}

}  // namespace flexcast::wire
