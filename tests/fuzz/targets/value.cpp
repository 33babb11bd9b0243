// Values of parameters as people type them: what can be read is written so that it is read the same again.
#include "clients/client/value.h"
#include "tests/fuzz/targets/fuzz.h"

#include <cmath>

namespace flexcast::fuzz {
namespace {

using client::Value;

bool same(const Value& a, const Value& b) {
  const auto nan = [](const Value& value) {
    const auto* number = std::get_if<double>(&value);
    const auto* vector = std::get_if<client::Vector>(&value);
    return (number && std::isnan(*number)) ||
           (vector && (std::isnan((*vector)[0]) || std::isnan((*vector)[1]) || std::isnan((*vector)[2])));
  };
  return a == b || (nan(a) && nan(b));
}

void check(std::string_view text, std::optional<flexcast_ValueKind> wanted) {
  const auto value = client::parse_value(text, wanted);
  if (!value) return require(!value.error().message.empty(), "an error without a text");
  const std::string written = client::to_text(value.value());
  const auto again = client::parse_value(written, client::kind_of(value.value()));
  require(again.ok() && same(again.value(), value.value()), "a value that is not read as it is written");
}

}  // namespace
}  // namespace flexcast::fuzz

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace flexcast;
  const std::string text = fuzz::as_text(data, size);
  fuzz::check(text, {});
  for (const auto wanted : {flexcast_VALUE_NUMBER, flexcast_VALUE_INTEGER, flexcast_VALUE_VECTOR, flexcast_VALUE_CHOICE,
                            flexcast_VALUE_BOOLEAN})
    fuzz::check(text, wanted);
  const client::Descriptor gravity{.name = "gravity", .kind = flexcast_VALUE_VECTOR};
  (void)client::parse_assignment(text, {gravity});
  return 0;
}
