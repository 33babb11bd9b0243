#include "clients/ctl/doctor.h"

#include <fmt/format.h>

#include "clients/ctl/checks.h"
#include "clients/ctl/examination.h"
#include "clients/ctl/json.h"

namespace flexcast::ctl {

int report(const Options& options, const Findings& findings, std::ostream& out) {
  bool failed = false;
  Json checks = Json::array();
  for (const Check& check : check_table()) {
    const Diagnosis diagnosis = check.examine(findings);
    failed = failed || diagnosis.level == Level::fail;
    if (options.json) {
      checks.push_back({{"check", check.name},
                        {"level", name_of(diagnosis.level)},
                        {"finding", diagnosis.finding},
                        {"remedy", diagnosis.remedy}});
      continue;
    }
    const std::string remedy = diagnosis.remedy.empty() ? "" : " -> " + diagnosis.remedy;
    out << fmt::format("{:<5} {:<15} {}{}\n", name_of(diagnosis.level), check.name, diagnosis.finding, remedy);
  }
  if (options.json) out << Json{{"healthy", !failed}, {"checks", std::move(checks)}}.dump() << "\n";
  out << std::flush;
  return failed ? 1 : 0;
}

int run_doctor(const Options& options, std::ostream& out, std::ostream&) {
  return report(options, examine(options), out);
}

}  // namespace flexcast::ctl
