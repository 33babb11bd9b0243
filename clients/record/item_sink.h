// ItemSink: where the file's thread puts what was received.
#pragma once

#include <cstdint>

#include "clients/mcap/status.h"
#include "clients/record/item.h"

namespace flexcast::record {

class ItemSink {
 public:
  virtual ~ItemSink() = default;

  virtual mcap::Status write(const Item& item) = 0;

  // For times when nothing comes: hands a chunk that is old enough to the disk. `now`: ns since 1970.
  virtual mcap::Status flush_if_older(std::int64_t now) = 0;

  virtual std::uint64_t bytes_written() const = 0;
};

}  // namespace flexcast::record
