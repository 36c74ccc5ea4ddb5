#!/usr/bin/env bash
# Each set of parameters of runs.csv at each force, from the equilibrium at the last force on; then pictures and comparison.
#   cases/run red-cell-stretch, or with a tanktread in PATH: cases/red-cell-stretch/run.sh OUTPUT_DIRECTORY [--measure] [SET ...]
set -euo pipefail
case=$(dirname "$(realpath "$0")")
output=${1:?usage: run.sh OUTPUT_DIRECTORY [--measure] [SET ...]}
shift
export PYTHONPATH="$case/../../post" PYTHONDONTWRITEBYTECODE=1
forces="0 16.3 19.6 30.8 38.6 47.6 67.5 88 109 130.4 150.6 172.9 193.1" # pN, of the published measurements
tanktread --version >/dev/null
mkdir -p "$output"

measure=
[ "${1:-}" != --measure ] || { measure=$1; shift; }
mapfile -t rows < <(grep -v '^#' "$case/runs.csv")
IFS=, read -ra keys <<<"${rows[0]}"
for row in "${rows[@]:1}"; do
  IFS=, read -ra cells <<<"$row"
  set_name=${cells[0]}
  [[ $# -eq 0 || " $* " == *" $set_name "* ]] || continue
  options=()
  for ((k = 2; k < ${#cells[@]}; ++k)); do
    [ -z "${cells[k]}" ] || options+=(--set "${keys[k]}=${cells[k]}")
  done
  start=()
  for force in $forces; do
    folder=$output/$set_name/$force
    rm -rf "$folder"
    echo "$set_name, $force pN"
    tanktread membrane drag --case "$case/case.toml" "${options[@]}" --set "si.load_force_N=${force}e-12" \
      --still 1e-3 "${start[@]}" --out "$folder" >"$output/log"
    start=(--in "$(ls "$folder"/membrane/membrane_*.vtu | tail -n 1)")
  done
done
/usr/bin/python3 -m tanktread_post plot "$output" --case "$case"
if [ -n "$measure" ]; then
  made_by="cases/run red-cell-stretch $output --measure, by $(tanktread --version)"
  /usr/bin/python3 -m tanktread_post keep "$output" --case "$case" --made-by "$made_by"
fi
/usr/bin/python3 -m tanktread_post compare "$output" --case "$case"
