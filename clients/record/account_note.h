// AccountNote: what the recorder alone knows of frames, written into the file while it records, so that a recording
// whose recorder was killed can tell it, too. Each note says what has come since the last one.
#pragma once

#include <cstdint>
#include <map>
#include <vector>

#include "clients/mcap/types.h"
#include "clients/record/run_ledger.h"
#include "idl/wire/topics.h"

namespace flexcast::record {

struct AccountNote {
  std::vector<std::uint64_t> watched;               // runs that the recorder has seen from their beginning
  std::vector<Pause> paused;                        // published while the recorder was paused
  std::vector<Pause> dropped;                       // did not fit the queue, in whole or in part
  std::map<wire::TopicId, std::uint64_t> messages;  // that did not fit the queue, all of the recording

  bool empty() const { return watched.empty() && paused.empty() && dropped.empty(); }
};

// Name of the metadata record, of which a file has one for each note.
inline constexpr const char* account_metadata = "flexcast.account";

// `watched.N` = "RUN_ID", `pause.N` and `queue.N` = "RUN_ID FIRST LAST", `dropped.TOPIC` = messages.
mcap::TextPairs to_metadata(const AccountNote& note);

// What does not read as such a value is passed over.
AccountNote account_of(const mcap::TextPairs& metadata);

}  // namespace flexcast::record
