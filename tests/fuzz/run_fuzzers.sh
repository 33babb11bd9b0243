#!/usr/bin/env bash
# Runs each fuzzer, or those that are named, for SECONDS (default 10) from its seeds in tests/fuzz/corpus.
# Usage: tests/fuzz/run_fuzzers.sh [SECONDS] [NAME...]
#
# They come from the build with sanitizers of tests/run.sh, build-sanitize, or from FLEXCAST_SANITIZED_BUILD.
# A crash, a leak, an input that takes ten seconds or more memory than granted ends with 1, and leaves the input in
# findings of that build. "build-sanitize/bin/fuzz_NAME FILE" runs one input again.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."

seconds=${1:-10}
[[ $seconds =~ ^[0-9]+$ ]] || { echo "run_fuzzers.sh: '$seconds' is not a number of seconds" >&2; exit 2; }
names=("${@:2}")
((${#names[@]})) || names=(scene mesh mcap command value web)
build=${FLEXCAST_SANITIZED_BUILD:-build-sanitize}
memory_mib=2048
grep -q '^FLEXCAST_FUZZ:BOOL=ON' "$build/CMakeCache.txt" 2>/dev/null ||
  { echo "run_fuzzers.sh: $build is no build with fuzzers: run tests/run.sh first, or name another one in" \
    "FLEXCAST_SANITIZED_BUILD" >&2; exit 1; }
make_fuzzers() { cmake --build "$build" --target "${names[@]/#/fuzz_}"; }
built=$(make_fuzzers 2>&1) || { tail -50 <<<"$built" >&2; exit 1; }

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
