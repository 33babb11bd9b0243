#include "idl/wire/wait_set.h"

#include <dds/dds.h>

#include <algorithm>
#include <array>

namespace flexcast::wire {

Result<GuardCondition> GuardCondition::create(const Participant& participant) {
  auto entity = own_entity("cannot create a guard condition", dds_create_guardcondition(participant.handle()));
  if (!entity) return entity.error();
  return GuardCondition(std::move(entity).value());
}

void GuardCondition::trigger() const {
  (void)dds_set_guardcondition(handle(), true);
}

void GuardCondition::reset() const {
  (void)dds_set_guardcondition(handle(), false);
}

Result<WaitSet> WaitSet::create(const Participant& participant) {
  auto entity = own_entity("cannot create a wait set", dds_create_waitset(participant.handle()));
  if (!entity) return entity.error();
  return WaitSet(std::move(entity).value());
}

Result<void> WaitSet::attach_handle(EntityHandle handle) {
  const dds_return_t code = dds_waitset_attach(entity_.handle(), handle, 0);
  if (code != DDS_RETCODE_OK) return dds_error("cannot attach to a wait set", code);
  return {};
}

Result<void> WaitSet::attach(const GuardCondition& guard) {
  return attach_handle(guard.handle());
}

Result<void> WaitSet::attach_data(const UntypedReader& reader) {
  auto condition = own_entity("cannot wait for a reader", dds_create_readcondition(reader.handle(), DDS_ANY_STATE));
  if (!condition) return condition.error();
  conditions_.push_back(std::move(condition).value());
  return attach_handle(conditions_.back().handle());
}

Result<void> WaitSet::attach_matched(const UntypedReader& reader) {
  (void)dds_set_status_mask(reader.handle(), DDS_SUBSCRIPTION_MATCHED_STATUS);
  return attach_handle(reader.handle());
}

Result<void> WaitSet::attach_matched(const UntypedWriter& writer) {
  (void)dds_set_status_mask(writer.handle(), DDS_PUBLICATION_MATCHED_STATUS);
  return attach_handle(writer.handle());
}

bool WaitSet::wait(std::chrono::nanoseconds timeout) const {
  const std::chrono::nanoseconds limit = std::chrono::hours(24 * 365);
  std::array<dds_attach_t, 1> woken{};
  return dds_waitset_wait(entity_.handle(), woken.data(), woken.size(),
                          std::clamp(timeout, std::chrono::nanoseconds(0), limit).count()) > 0;
}

}  // namespace flexcast::wire
