// flexcast-replay: publishes a recording again.
#include "clients/replay/options.h"
#include "clients/replay/program.h"
#include "idl/wire/memory.h"

int main(int argc, char** argv) {
  flexcast::wire::keep_freed_memory();
  const auto parsed = flexcast::replay::parse_options(argc, argv);
  if (const int* code = std::get_if<int>(&parsed)) return *code;
  return flexcast::replay::run_program(std::get<flexcast::replay::Options>(parsed));
}
