// Verified recordings as tests look at them.
#pragma once

#include <stdexcept>

#include "tests/clients/verify/session.h"

namespace flexcast::verify::test {

inline Report report_of(const Session& session, std::optional<std::uint64_t> only = {}) {
  auto report = session.verify(only);
  if (!report) throw std::runtime_error(report.error().message);
  return std::move(report).value();
}

inline RunReport only_run(const Session& session) {
  Report report = report_of(session);
  EXPECT_EQ(report.runs.size(), 1u);
  EXPECT_EQ(report.verified(), report.runs[0].verdict == Verdict::equal);
  return std::move(report.runs.at(0));
}

// The first applied command of that kind, to be changed.
inline Event& event_of(Session& session, server::CommandKind kind) {
  for (Event& event : session.events) {
    if (event.kind == server::EventKind::command && event.command == kind) return event;
  }
  throw std::runtime_error("no such event");
}

}  // namespace flexcast::verify::test
