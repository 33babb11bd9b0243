#include "idl/wire/writer.h"

#include <dds/dds.h>

#include "idl/wire/matched.h"

namespace flexcast::wire {

Matched UntypedWriter::matched() const {
  dds_publication_matched_status_t status{};
  if (dds_get_publication_matched_status(handle(), &status) != DDS_RETCODE_OK) return {};
  return {status.current_count, status.total_count};
}

std::vector<Guid> UntypedWriter::matched_participants() const {
  return participants_of(handle(), dds_get_matched_subscriptions, dds_get_matched_subscription_data);
}

Result<void> UntypedWriter::write_sample(const void* sample) const {
  const dds_return_t code = dds_write(handle(), sample);
  if (code != DDS_RETCODE_OK) return dds_error("cannot write a sample", code);
  return {};
}

Result<void> UntypedWriter::dispose_sample(const void* sample) const {
  const dds_return_t code = dds_dispose(handle(), sample);
  if (code != DDS_RETCODE_OK) return dds_error("cannot dispose an instance", code);
  return {};
}

}  // namespace flexcast::wire
