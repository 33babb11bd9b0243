// flexcast-export: turns a recording into files for ParaView and for tables.
#include "clients/export/options.h"
#include "clients/export/program.h"

int main(int argc, char** argv) {
  const auto parsed = flexcast::exporting::parse_options(argc, argv);
  if (const int* code = std::get_if<int>(&parsed)) return *code;
  return flexcast::exporting::run_program(std::get<flexcast::exporting::Options>(parsed));
}
