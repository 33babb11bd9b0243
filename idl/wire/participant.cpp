#include "idl/wire/participant.h"

#include <dds/dds.h>

#include <algorithm>
#include <mutex>

#include "idl/wire/domain.h"
#include "idl/wire/security.h"

namespace flexcast::wire {
namespace {

// What Cyclone logs while one of these lives, in place of printing it: the reason of a refused identity.
class LogCapture {
 public:
  LogCapture() { dds_set_log_sink(&LogCapture::append, this); }
  ~LogCapture() { dds_set_log_sink(nullptr, nullptr); }
  LogCapture(const LogCapture&) = delete;
  LogCapture& operator=(const LogCapture&) = delete;

  std::string first_line() const {
    const std::scoped_lock lock(mutex_);
    return text_.substr(0, text_.find('\n'));
  }

 private:
  static void append(void* self, const dds_log_data_t* data) {
    auto& capture = *static_cast<LogCapture*>(self);
    const std::scoped_lock lock(capture.mutex_);
    if (data->priority & (DDS_LC_FATAL | DDS_LC_ERROR)) capture.text_ += data->message;
  }

  mutable std::mutex mutex_;  // any thread may log
  std::string text_;
};

Result<Entity> create_entity(const ParticipantOptions& options) {
  const std::string what = "cannot join domain " + std::to_string(options.domain);
  const auto domain = static_cast<dds_domainid_t>(options.domain);
  if (options.security.empty()) return own_entity(what, dds_create_participant(domain, nullptr, nullptr));
  const auto qos = make_security_qos(options.security);
  if (!qos) return qos.error();
  const LogCapture log;
  auto entity = own_entity(what + " with the identity in " + options.security,
                           dds_create_participant(domain, qos.value().get(), nullptr));
  if (!entity && !log.first_line().empty()) return Error{entity.error().message + ": " + log.first_line()};
  return entity;
}

}  // namespace

Participant::Participant(std::shared_ptr<Domain> domain, Entity entity)
    : domain_(std::move(domain)), entity_(std::move(entity)) {}

Result<Participant> Participant::create(const ParticipantOptions& options) {
  if (options.domain < 0 || options.domain > maximum_domain)
    return Error{"domain " + std::to_string(options.domain) + " is not in 0.." + std::to_string(maximum_domain)};
  const auto profile = resolve_profile(options.profile);
  if (!profile) return profile.error();
  auto domain = Domain::open(options.domain, profile.value(), options.security);
  if (!domain) return domain.error();
  auto entity = create_entity(options);
  if (!entity) return entity.error();
  return Participant(std::move(domain).value(), std::move(entity).value());
}

int Participant::domain() const {
  return domain_->id();
}

const std::string& Participant::profile() const {
  return domain_->profile();
}

const std::string& Participant::security() const {
  return domain_->security();
}

Guid Participant::guid() const {
  Guid guid{};
  dds_guid_t raw;
  if (dds_get_guid(handle(), &raw) == DDS_RETCODE_OK) std::copy(std::begin(raw.v), std::end(raw.v), guid.begin());
  return guid;
}

}  // namespace flexcast::wire
