// Domain: the process-wide state of Cyclone for one domain id. Internal to idl/wire.
#pragma once

#include <memory>
#include <string>

#include "idl/wire/entity.h"
#include "idl/wire/profile.h"

namespace flexcast::wire {

class Domain {
 public:
  Domain(int id, std::string profile, std::string security, Entity entity)
      : id_(id), profile_(std::move(profile)), security_(std::move(security)), entity_(std::move(entity)) {}

  // The open domain of this process, or a new one. An error if it is open with another profile or identity.
  static Result<std::shared_ptr<Domain>> open(int id, const Profile& profile, const std::string& security);

  int id() const { return id_; }
  const std::string& profile() const { return profile_; }
  const std::string& security() const { return security_; }

 private:
  int id_;
  std::string profile_;
  std::string security_;
  Entity entity_;
};

}  // namespace flexcast::wire
