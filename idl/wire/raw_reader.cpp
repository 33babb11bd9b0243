#include "idl/wire/raw_reader.h"

#include <dds/dds.h>
#include <dds/ddsi/ddsi_serdata.h>

#include <algorithm>

#include "idl/wire/sample_info.h"

namespace flexcast::wire {
namespace {

// Takes over the reference of the caller.
SampleBytes take_bytes(ddsi_serdata* sample) {
  const std::size_t size = ddsi_serdata_size(sample);
  ddsrt_iovec_t memory{};
  ddsi_serdata* reference = ddsi_serdata_to_ser_ref(sample, 0, size, &memory);
  ddsi_serdata_unref(sample);  // the other reference holds it
  const auto release = [memory](const void* held) {
    ddsi_serdata_to_ser_unref(static_cast<ddsi_serdata*>(const_cast<void*>(held)), &memory);
  };
  std::shared_ptr<const void> owner(static_cast<const void*>(reference), release);
  return {std::move(owner), {static_cast<const std::byte*>(memory.iov_base), size}};
}

}  // namespace

Result<RawReader> RawReader::create(const Participant& participant, const TopicRow& row, const Qos& qos) {
  auto endpoint = UntypedReader::create(participant, row, qos);
  if (!endpoint) return endpoint.error();
  return RawReader(std::move(endpoint).value(), row);
}

Result<std::size_t> RawReader::take_raw(const std::function<void(const RawSample&)>& receive, std::size_t most) const {
  if (most == 0) return std::size_t{0};
  std::vector<ddsi_serdata*> samples(most, nullptr);
  std::vector<dds_sample_info_t> infos(most);
  const dds_return_t count =
      dds_takecdr(handle(), samples.data(), static_cast<std::uint32_t>(most), infos.data(), DDS_ANY_STATE);
  if (count == DDS_RETCODE_NO_DATA) return std::size_t{0};
  if (count < 0) return dds_error("cannot take samples", count);
  const std::int64_t now = dds_time();
  for (std::size_t i = 0; i < static_cast<std::size_t>(count); ++i) {
    const SampleBytes bytes = take_bytes(samples[i]);
    receive({bytes, bytes, to_sample_info(infos[i]), now});
  }
  return static_cast<std::size_t>(count);
}

}  // namespace flexcast::wire
