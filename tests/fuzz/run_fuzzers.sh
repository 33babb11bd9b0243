#!/usr/bin/env bash
# Builds the fuzzers with clang and runs each, or those that are named, for SECONDS (default 10) from its seeds in
# tests/fuzz/corpus. Usage: tests/fuzz/run_fuzzers.sh [SECONDS] [NAME...]
#
# The engine comes from the build in build-tests, or in FLEXCAST_ENGINE_BUILD.
# A crash, a leak, an input that takes ten seconds or more memory than granted ends with 1, and leaves the input in
# build-fuzz/findings. "build-fuzz/bin/fuzz_NAME FILE" runs one input again.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."

seconds=${1:-10}
[[ $seconds =~ ^[0-9]+$ ]] || { echo "run_fuzzers.sh: '$seconds' is not a number of seconds" >&2; exit 2; }
names=("${@:2}")
((${#names[@]})) || names=(scene mesh mcap command value web)
build=build-fuzz
memory_mib=2048
command -v clang++ >/dev/null || { echo "run_fuzzers.sh: clang++ is missing: apt-get install clang" >&2; exit 1; }

engine=${FLEXCAST_ENGINE_BUILD:-build-tests}
[[ -e $engine/CMakeCache.txt ]] || { echo "run_fuzzers.sh: $engine is no build of flexcast: run tests/run.sh first, or" \
  "name another one in FLEXCAST_ENGINE_BUILD" >&2; exit 1; }

launcher=()
! command -v ccache >/dev/null || launcher=(-DCMAKE_C_COMPILER_LAUNCHER=ccache -DCMAKE_CXX_COMPILER_LAUNCHER=ccache)
make_fuzzers() {
  cmake --build "$engine" --target flexcast_core &&
    cmake -S . -B "$build" -G Ninja -DFLEXCAST_FUZZ="$(realpath "$engine")" -DFLEXCAST_WEB=OFF -DCMAKE_C_COMPILER=clang \
      -DCMAKE_CXX_COMPILER=clang++ "${launcher[@]}" &&
    cmake --build "$build" --target "${names[@]/#/fuzz_}"
}
mkdir -p "$build"
make_fuzzers >"$build/build.log" 2>&1 || { tail -50 "$build/build.log" >&2; exit 1; }

mkdir -p "$build/findings"
failed=0
for name in "${names[@]}"; do
  found=$build/corpus/$name  # the seeds, and what the run adds to them
  rm -rf "$found"
  mkdir -p "$found"
  cp tests/fuzz/corpus/"$name"/* "$found"
  [[ $name != scene ]] || cp server/scenes/*.toml "$found"
  log=$build/findings/$name.log
  if ASAN_OPTIONS=detect_stack_use_after_return=1 UBSAN_OPTIONS=print_stacktrace=1:halt_on_error=1 \
    "$build/bin/fuzz_$name" -seed=1 -timeout=10 -rss_limit_mb="$memory_mib" -max_len=8192 -print_final_stats=1 \
    -max_total_time="$seconds" -artifact_prefix="$build/findings/$name-" "$found" >"$log" 2>&1; then
    runs=$(sed -n 's/^stat::number_of_executed_units: *//p' "$log")
    rate=$(sed -n 's/^stat::average_exec_per_sec: *//p' "$log")
    echo "fuzz_$name: $runs inputs, $rate a second, nothing found"
  else
    failed=1
    echo "fuzz_$name: FAILED" >&2
    grep -v '^#[0-9]*\s' "$log" | tail -40 >&2
  fi
done
exit "$failed"
