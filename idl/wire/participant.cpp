#include "idl/wire/participant.h"

#include <dds/dds.h>

#include <algorithm>

#include "idl/wire/domain.h"

namespace flexcast::wire {

Participant::Participant(std::shared_ptr<Domain> domain, Entity entity)
    : domain_(std::move(domain)), entity_(std::move(entity)) {}

Result<Participant> Participant::create(const ParticipantOptions& options) {
  if (options.domain < 0 || options.domain > maximum_domain)
    return Error{"domain " + std::to_string(options.domain) + " is not in 0.." + std::to_string(maximum_domain)};
  const auto profile = resolve_profile(options.profile);
  if (!profile) return profile.error();
  auto domain = Domain::open(options.domain, profile.value());
  if (!domain) return domain.error();
  auto entity = own_entity("cannot join domain " + std::to_string(options.domain),
                           dds_create_participant(static_cast<dds_domainid_t>(options.domain), nullptr, nullptr));
  if (!entity) return entity.error();
  return Participant(std::move(domain).value(), std::move(entity).value());
}

int Participant::domain() const {
  return domain_->id();
}

const std::string& Participant::profile() const {
  return domain_->profile();
}

Guid Participant::guid() const {
  Guid guid{};
  dds_guid_t raw;
  if (dds_get_guid(handle(), &raw) == DDS_RETCODE_OK) std::copy(std::begin(raw.v), std::end(raw.v), guid.begin());
  return guid;
}

}  // namespace flexcast::wire
