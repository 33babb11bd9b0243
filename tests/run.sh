#!/usr/bin/env bash
# Installs what is missing, builds everything twice (as released, and with address and undefined-behaviour sanitizers)
# and runs all tests. The last lines are ctest's own summary. With --long the proofs that need minutes run for as long as
# they are meant to: streams for a minute, hundreds of kills.
set -euo pipefail
case "$*" in
  "") ;;
  --long) export FLEXCAST_LONG=1 ;;
  *) echo "usage: tests/run.sh [--long]" >&2; exit 2 ;;
esac
cd "$(dirname "${BASH_SOURCE[0]}")/.."
source server/setup.sh

install_packages build tests
for folder in tests/interop tests/web; do
  (cd "$folder" && npm ci --no-audit --no-fund --loglevel=error)
done

# The test programs and the fuzzers alone, without the reference cases and the lab's studies, which would take too long:
# tests of this build take the name sanitized.PROGRAM below. The fuzzers need clang, which takes less time for this than GCC
# and is a second opinion; warnings are errors in the other build only.
build build-sanitize -DCMAKE_BUILD_TYPE=Debug -DCMAKE_CXX_FLAGS_DEBUG=-O1 -DCMAKE_C_FLAGS_DEBUG=-O1 \
  -DCMAKE_C_COMPILER=clang -DCMAKE_CXX_COMPILER=clang++ -DFLEXCAST_SANITIZE=address,undefined -DFLEXCAST_FUZZ=ON \
  -DFLEXCAST_LONG_TESTS=OFF -DFLEXCAST_STUDIES=OFF -DFLEXCAST_WERROR=OFF
build build-tests -DCMAKE_BUILD_TYPE=Release -DFLEXCAST_SANITIZED_BUILD="$PWD/build-sanitize"

ctest --test-dir build-tests --output-on-failure --no-tests=error -j "$(nproc)"
