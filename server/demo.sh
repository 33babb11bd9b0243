#!/usr/bin/env bash
# Installs what is missing, builds, simulates a soft bunny (--scene NAME: another of server/scenes) for ten seconds while
# a recorder listens over DDS and a page shows it, and says what happened. In a terminal the page stays until Ctrl-C.
# Everything it starts it also stops. SECONDS_TO_RECORD changes the ten seconds.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
source server/setup.sh

usage() {
  echo "usage: server/demo.sh [--scene NAME], NAME one of: $(basename -s .toml -a server/scenes/*.toml | tr '\n' ' ')" >&2
  exit 2
}
name=bunny
case $# in
  0) ;;
  2) [[ $1 == --scene && -f server/scenes/$2.toml ]] || usage; name=$2 ;;
  *) usage ;;
esac

duration=${SECONDS_TO_RECORD:-10}
scene=server/scenes/$name.toml
world=$name-demo-$$
file=build/$name.mcap
bin=build/bin

install_packages build
echo "Building into build/ (some minutes the first time)"
build build -DFLEXCAST_TESTS=OFF

logs=$(mktemp -d)
server='' recorder='' web=''
stop() {
  local pid
  for pid in $web $recorder $server; do kill "$pid" 2>/dev/null || true; done
  for pid in $web $recorder $server; do wait "$pid" 2>/dev/null || true; done
  rm -rf "$logs"
}
trap stop EXIT

# wait_for TEXT FILE PID: until the program has said TEXT, at most 20 s.
wait_for() {
  local i
  for ((i = 0; i < 200; ++i)); do
    grep -qs "$1" "$2" && return 0
    kill -0 "$3" 2>/dev/null || break
    sleep 0.1
  done
  echo "The program did not start:" >&2
  cat "${2%.*}".* >&2
  return 1
}

# number KEY: the first number called KEY in the JSON on standard input.
number() { grep -o "\"$1\": *[-0-9.e+]*" | head -n 1 | sed 's/.*: *//'; }

"$bin/flexcast-server" "$scene" --world "$world" --paused >"$logs/server.out" 2>"$logs/server.err" &
server=$!
wait_for '^ready:' "$logs/server.out" "$server"
sed 's/^ready:/Server:  /' "$logs/server.out"

"$bin/flexcast-web" --port 0 --world "$world" >"$logs/web.out" 2>"$logs/web.err" &
web=$!
wait_for '^ready:' "$logs/web.out" "$web"
page=$(sed -n 's/^ready: *//p' "$logs/web.out")
echo "Page:     $page"

"$bin/flexcast-record" -o "$file" --force --world "$world" --duration "$duration" --json \
  >"$logs/recorder.out" 2>"$logs/recorder.err" &
recorder=$!
wait_for '^recording:' "$logs/recorder.err" "$recorder"
echo "Recorder: $duration s into $file"
"$bin/flexcast-ctl" --world "$world" resume >/dev/null

while kill -0 "$recorder" 2>/dev/null; do
  status=$("$bin/flexcast-ctl" --world "$world" --json status 2>/dev/null) || break
  printf '  step %6d   %7.2f s simulated   real-time factor %5.2f   %6d frames\n' \
    "$(number step <<<"$status")" "$(number time <<<"$status")" \
    "$(number real_time_factor <<<"$status")" "$(number frames_published <<<"$status")"
  sleep 1
done
wait "$recorder"
recorder=''

result=$(<"$logs/recorder.out")
simulated=$(number simulated_seconds <<<"$result")
wall=$(number seconds <<<"$result")
echo
echo "Done. $(number steps <<<"$result") steps: $simulated s simulated in $wall s," \
  "real-time factor $(awk "BEGIN { printf \"%.2f\", $simulated / $wall }")."
echo "Recorded $(number frames <<<"$result") frames, $(number gaps <<<"$result") missing, $(number bytes <<<"$result") bytes: $file"
echo
echo "Next: the tour in README.md, or drop $file on the page"
if [[ -t 1 ]]; then
  echo "The world goes on until Ctrl-C. Watch it, pull it, change it: $page"
  wait "$server"
fi
