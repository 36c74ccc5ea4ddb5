# Sourced by the scripts beside it: pinned packages of Debian 12 in a temporary folder, and the comparison with what was seen.
# Nothing is installed; the folder is gone when the script ends. FINDINGS_CACHE=FOLDER keeps the packages downloaded.
set -euo pipefail
export LC_ALL=C.UTF-8 PYTHONDONTWRITEBYTECODE=1

script=$(realpath "$0")
folder=$(mktemp -d)
root=$folder/root  # another one within ( ) parts packages that do not go together
trap 'cd /; rm -rf "$folder"' EXIT
cd "$folder"

python=/usr/bin/python3
libraries=usr/lib/x86_64-linux-gnu

# Exit code 2: the packages cannot be had, so nothing is known about them.
cannot_check() {
  echo "not checked: $*" >&2
  exit 2
}

# need PACKAGE=VERSION ...: for the programs that follow, with all that they depend on. What the machine has in just this version
# is used as it is; the rest is unpacked.
need() {
  local plan
  plan=$(apt-get --simulate install --yes --no-install-recommends --allow-downgrades "$@" 2>&1) ||
    cannot_check "apt-get finds no $* (is 'apt-get update' due?): $(grep '^E:' <<<"$plan" | head -n 1)"
  local missing
  mapfile -t missing < <(sed -nE 's/^Inst ([^ ]+) (\[[^]]*\] )?\(([^ ]+) .*/\1=\3/p' <<<"$plan")
  [ ${#missing[@]} -eq 0 ] || unpack "${missing[@]}"
}

# unpack PACKAGE=VERSION ...: just these, before those of the machine.
unpack() {
  local cache=${FINDINGS_CACHE:-$folder/packages} package
  mkdir -p "$cache" "$root"
  (cd "$cache" && apt-get download "$@" >"$folder/apt.log" 2>&1) || cannot_check "$(grep '^E:' "$folder/apt.log" | head -n 1)"
  for package in "$@"; do
    dpkg -x "$(package_file "$cache" "$package")" "$root"
  done
  use_root
}

# apt-get writes the colon of a version's epoch as %3a.
package_file() {
  local name=${2%%=*} version=${2#*=}
  ls "$1/${name%%:*}_${version//:/%3a}"_*.deb
}

use_root() {
  [ ! -x "$root/usr/bin/python3" ] || python=$root/usr/bin/python3
  export PATH=$root/usr/bin:$PATH PYTHONPATH=$root/usr/lib/python3/dist-packages CPLUS_INCLUDE_PATH=$root/usr/include
  export LD_LIBRARY_PATH=$root/lib/x86_64-linux-gnu:$root/usr/lib:$root/$libraries:$root/$libraries/blas:$root/$libraries/lapack
}

as_seen_failed() {
  cat "$folder/stderr" >&2
  [ "$1" -ne 2 ] || exit 2
  echo "CHANGED: $(basename "$script"): the check itself fails"
  exit 1
}

# as_seen COMMAND ...: runs it and prints what it prints. Exit code 1 unless that is, word for word, what the head of the script
# gives in the lines that begin with "# | ".
as_seen() {
  local expected found
  expected=$(sed -n 's/^# | //p' "$script")
  found=$("$@" 2>"$folder/stderr") || as_seen_failed $?
  echo "$found"
  [ "$found" != "$expected" ] || return 0
  cat "$folder/stderr" >&2
  diff <(echo "$expected") <(echo "$found") || true
  echo "CHANGED: $(basename "$script")"
  exit 1
}
