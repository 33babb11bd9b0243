// What clients of flexcast-web say: any bytes are a message or refused with a text, and so is a service's request.
#include "clients/web/client_message.h"
#include "clients/web/services.h"
#include "tests/fuzz/targets/fuzz.h"

namespace flexcast::fuzz {
namespace {

std::optional<flexcast_ValueKind> kind_of(const std::string& name) {
  const auto kinds = {flexcast_VALUE_NUMBER, flexcast_VALUE_INTEGER, flexcast_VALUE_VECTOR, flexcast_VALUE_CHOICE,
                      flexcast_VALUE_BOOLEAN};
  return name.size() < kinds.size() ? std::optional(*(kinds.begin() + name.size())) : std::nullopt;
}

void check_request(const std::string& text) {
  for (const web::Service& service : web::service_table()) {
    const auto request = web::parse_request(service, text, kind_of);
    if (!request) {
      require(request.error().message.starts_with(service.verb), "a refusal that does not name its verb");
      continue;
    }
    require(request.value().kind == service.kind, "a request of another kind");
    require(service.kind != flexcast_COMMAND_STEP || request.value().count > 0, "no steps");
  }
}

}  // namespace
}  // namespace flexcast::fuzz

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace flexcast;
  const std::string text = fuzz::as_text(data, size);
  for (const bool is_text : {true, false}) {
    const auto message = web::parse_message(is_text, text);
    if (!message) {
      fuzz::require(!message.error().message.empty(), "an error without a text");
      continue;
    }
    if (const auto* set = std::get_if<web::SetParameters>(&message.value()))
      for (const auto& entry : set->entries) (void)web::to_value(entry.value, fuzz::kind_of(entry.name));
    if (const auto* call = std::get_if<web::CallService>(&message.value())) fuzz::check_request(call->payload);
  }
  fuzz::check_request(text);
  return 0;
}
