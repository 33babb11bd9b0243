#include "idl/wire/reader.h"

#include <dds/dds.h>

#include <algorithm>

#include "idl/wire/matched.h"
#include "idl/wire/sample_info.h"

namespace flexcast::wire {

Matched UntypedReader::matched() const {
  dds_subscription_matched_status_t status{};
  if (dds_get_subscription_matched_status(handle(), &status) != DDS_RETCODE_OK) return {};
  return {status.current_count, status.total_count};
}

std::vector<Guid> UntypedReader::matched_participants() const {
  return participants_of(handle(), dds_get_matched_publications, dds_get_matched_publication_data);
}

std::optional<Guid> UntypedReader::participant_of(std::uint64_t writer) const {
  return take_participant(dds_get_matched_publication_data(handle(), writer));
}

Result<std::size_t> UntypedReader::take_samples(void** samples, std::vector<SampleInfo>& infos) const {
  if (infos.empty()) return std::size_t{0};
  std::vector<dds_sample_info_t> dds_infos(infos.size());
  const dds_return_t count =
      dds_take(handle(), samples, dds_infos.data(), infos.size(), static_cast<std::uint32_t>(infos.size()));
  if (count < 0) return dds_error("cannot take samples", count);
  infos.resize(static_cast<std::size_t>(count));
  for (std::size_t i = 0; i < infos.size(); ++i) infos[i] = to_sample_info(dds_infos[i]);
  return infos.size();
}

bool UntypedReader::wait(std::chrono::nanoseconds timeout) const {
  const Entity condition(dds_create_readcondition(handle(), DDS_ANY_STATE));
  const Entity set(dds_create_waitset(dds_get_participant(handle())));
  if (condition.handle() <= 0 || dds_waitset_attach(set.handle(), condition.handle(), 0) != DDS_RETCODE_OK)
    return false;
  dds_attach_t woken = 0;
  return dds_waitset_wait(set.handle(), &woken, 1, std::max<std::int64_t>(timeout.count(), 0)) > 0;
}

UntypedLoan::~UntypedLoan() {
  if (!infos_.empty()) (void)dds_return_loan(reader_, samples_.data(), static_cast<std::int32_t>(infos_.size()));
}

}  // namespace flexcast::wire
