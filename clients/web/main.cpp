// flexcast-web: worlds in a browser.
#include <iostream>

#include "clients/web/program.h"

int main(int argc, char** argv) {
  const auto parsed = flexcast::web::parse_options(argc, argv, std::cout, std::cerr);
  if (const int* code = std::get_if<int>(&parsed)) return *code;
  return flexcast::web::run_program(std::get<flexcast::web::Options>(parsed));
}
