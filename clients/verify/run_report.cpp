#include "clients/verify/run_report.h"

namespace flexcast::verify {

std::string_view name_of(Verdict verdict) {
  switch (verdict) {
    case Verdict::equal:
      return "equal";
    case Verdict::empty:
      return "empty";
    case Verdict::differs:
      return "differs";
    case Verdict::not_verifiable:
      break;
  }
  return "not_verifiable";
}

}  // namespace flexcast::verify
