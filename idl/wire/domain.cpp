#include "idl/wire/domain.h"

#include <dds/dds.h>

#include <map>
#include <mutex>

namespace flexcast::wire {

Result<std::shared_ptr<Domain>> Domain::open(int id, const Profile& profile, const std::string& security) {
  static std::mutex mutex;
  static std::map<int, std::weak_ptr<Domain>> open_domains;
  const std::lock_guard lock(mutex);

  if (auto open = open_domains[id].lock()) {
    if (open->security() != security)
      return Error{"domain " + std::to_string(id) + " is already open in this process with " +
                   (open->security().empty() ? "no identity" : "the identity in " + open->security())};
    if (open->profile() == profile.name) return open;
    return Error{"domain " + std::to_string(id) + " is already open in this process with profile " + open->profile() +
                 ", not " + profile.name};
  }
  const std::string where = "domain " + std::to_string(id) + ", profile " + profile.name;
  auto entity = own_entity(where + " cannot be opened",
                           dds_create_domain(static_cast<dds_domainid_t>(id), profile.config.c_str()));
  if (!entity) return entity.error();
  auto domain = std::make_shared<Domain>(id, profile.name, security, std::move(entity).value());
  open_domains[id] = domain;
  return domain;
}

}  // namespace flexcast::wire
