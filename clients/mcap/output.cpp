#include "clients/mcap/output.h"

#include "clients/mcap/crc32.h"

namespace flexcast::mcap {

Status Output::write(Bytes bytes) {
  return write(bytes, crc32(bytes));
}

Status Output::write(Bytes bytes, std::uint32_t crc) {
  if (!status_) return status_;
  status_ = sink_.write(bytes);
  offset_ += bytes.size();
  crc_ = crc32_join(crc_, crc, bytes.size());
  return status_;
}

Status Output::flush() {
  if (status_) status_ = sink_.flush();
  return status_;
}

Status Output::cut(std::uint64_t offset, std::uint32_t crc) {
  if (Status status = sink_.cut(offset); !status) return status;
  status_ = {};
  offset_ = offset;
  crc_ = crc;
  return {};
}

}  // namespace flexcast::mcap
