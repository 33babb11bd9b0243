// flexcast-verify: executes a recording once more and compares every frame.
#include <iostream>

#include "clients/verify/options.h"
#include "clients/verify/program.h"

int main(int argc, char** argv) {
  const auto parsed = flexcast::verify::parse_options(argc, argv, std::cout, std::cerr);
  if (const int* code = std::get_if<int>(&parsed)) return *code;
  return flexcast::verify::run_program(std::get<flexcast::verify::Options>(parsed), std::cout, std::cerr);
}
