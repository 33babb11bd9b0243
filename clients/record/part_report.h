// What a report says of one part of a recording: the frames of that part, and the gaps and pauses beside them.
#pragma once

#include <cstdint>
#include <map>

#include "clients/record/content_ledger.h"
#include "clients/record/report.h"

namespace flexcast::record {

// Divides the account of a whole recording among its parts, given one after the other: every gap is in one of them.
class PartReports {
 public:
  // `whole`: what is known now; `content`: what is in the part. `last`: no part comes after it.
  Report divide(Report whole, const ContentLedger& content, bool last);

  // The part is complete: the next one begins after it. Until then divide() may be called again.
  void accept() { next_ = divided_; }

 private:
  std::map<std::uint64_t, std::uint64_t> next_;     // of each run: the first frame that no part has told of
  std::map<std::uint64_t, std::uint64_t> divided_;  // the same, after the part that was divided last
};

// The account of a recording of which only `content` is left, the newest of it.
Report restrict_report(Report whole, const ContentLedger& content);

}  // namespace flexcast::record
