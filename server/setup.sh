# Sourced by demo.sh and tests/run.sh: installs what packages.txt lists and the machine does not have.
# A tool that came another way (a newer node, say) is left alone.

flexcast_root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)

have_package() {
  case $1 in
    nodejs) command -v node >/dev/null && return 0 ;;
    npm) command -v npm >/dev/null && return 0 ;;
  esac
  dpkg-query -W -f='${Status}' "$1" 2>/dev/null | grep -q 'ok installed'
}

# install_packages KIND...: the rows of those kinds.
install_packages() {
  local kind package missing=()
  while read -r kind package; do
    [[ " $* " == *" $kind "* ]] || continue
    have_package "$package" || missing+=("$package")
  done < <(grep -v '^#' "$flexcast_root/server/packages.txt")
  ((${#missing[@]})) || return 0

  local as_root=()
  if ((EUID != 0)); then
    command -v sudo >/dev/null || { echo "These packages are missing and sudo is not there: ${missing[*]}" >&2; return 1; }
    as_root=(sudo)
  fi
  echo "Installing: ${missing[*]}"
  "${as_root[@]}" apt-get update -q >/dev/null || return 1
  "${as_root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get install -y -q --no-install-recommends "${missing[@]}" \
    >/dev/null || return 1
}

# build FOLDER CMAKE_OPTION...: configures and builds; shows the log only when something fails. Sources are compiled in
# batches, which is faster when everything is new.
build() {
  local folder=$1
  shift
  cmake -S "$flexcast_root" -B "$folder" -G Ninja \
    -DCMAKE_UNITY_BUILD=ON -DCMAKE_UNITY_BUILD_BATCH_SIZE=16 "$@" >"$folder.configure.log" 2>&1 ||
    { cat "$folder.configure.log" >&2; return 1; }
  cmake --build "$folder"
}
