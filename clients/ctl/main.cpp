// flexcast-ctl: lists, describes, tunes and steers running worlds.
#include <iostream>

#include "clients/ctl/verbs.h"

int main(int argc, char** argv) {
  return flexcast::ctl::run(argc, argv, std::cout, std::cerr);
}
