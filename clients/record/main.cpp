// flexcast-record: records a world to an MCAP file.
#include "clients/record/options.h"
#include "clients/record/program.h"
#include "idl/wire/memory.h"

int main(int argc, char** argv) {
  flexcast::wire::keep_freed_memory();
  const auto parsed = flexcast::record::parse_options(argc, argv);
  if (const int* code = std::get_if<int>(&parsed)) return *code;
  return flexcast::record::run_program(std::get<flexcast::record::Options>(parsed));
}
