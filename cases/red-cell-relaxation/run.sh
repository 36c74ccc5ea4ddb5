#!/usr/bin/env bash
# Stretches the cell without membrane viscosity, lets it go with that of each row of releases.csv, or does both in a fluid; then pictures and
# comparison. A run in a fluid that is finished is kept, one that was interrupted goes on.
#   cases/run red-cell-relaxation, or with a tanktread in PATH: cases/red-cell-relaxation/run.sh OUTPUT_DIRECTORY [--measure] [RUN ...]
set -euo pipefail
case=$(dirname "$(realpath "$0")")
output=${1:?usage: run.sh OUTPUT_DIRECTORY [--measure] [RUN ...]}
shift
export PYTHONPATH="$case/../../post" PYTHONDONTWRITEBYTECODE=1
tanktread --version >/dev/null
mkdir -p "$output"

# A run of a membrane viscosity in a fluid.
run_in_fluid() {
  local out=$1 viscosity=$2 shear_time=$3 keys=()
  if [ -f "$out/echo.toml" ]; then
    tanktread run --resume "$out" </dev/null
    return
  fi
  [ "$viscosity" = 0 ] || keys=(--set membrane.viscous.scheme=implicit --set "si.membrane_shear_viscosity_N_s_per_m=$viscosity")
  tanktread run "$case/case_fluid.toml" "${keys[@]}" --shear-time "$shear_time" --output "$out" </dev/null
}

measure=
[ "${1:-}" != --measure ] || { measure=$1; shift; }
rm -rf "$output/stretched"
tanktread membrane drag --case "$case/case.toml" --set output.observables_every=0.1 --still 1e-3 --shear-time 2 --out "$output/stretched"
start=$(ls "$output"/stretched/membrane/membrane_*.vtu | tail -n 1)
# The columns of releases.csv, in their order.
grep -v '^#' "$case/releases.csv" | tail -n +2 | while IFS=, read -r run _ viscosity drag shear_time; do
  [[ $# -eq 0 || " $* " == *" $run "* ]] || continue
  echo "$run"
  if [ -z "$drag" ]; then
    run_in_fluid "$output/$run" "$viscosity" "$shear_time"
    continue
  fi
  rm -rf "${output:?}/$run"
  tanktread membrane drag --case "$case/case.toml" --in "$start" --set si.load_force_N=0 --set membrane.viscous.scheme=implicit \
    --set "si.membrane_shear_viscosity_N_s_per_m=$viscosity" --drag "$drag" --shear-time "$shear_time" --out "$output/$run" </dev/null
done
/usr/bin/python3 -m tanktread_post plot "$output" --case "$case"
if [ -n "$measure" ]; then
  made_by="cases/run red-cell-relaxation $output --measure, by $(tanktread --version)"
  /usr/bin/python3 -m tanktread_post keep "$output" --case "$case" --made-by "$made_by"
fi
/usr/bin/python3 -m tanktread_post compare "$output" --case "$case"
