#!/usr/bin/env bash
# Ten steps of the shear capsule, one component after the other, through files; then the same steps by one run.
#   cases/run staged-step, or with a tanktread in PATH: cases/staged-step/run.sh OUTPUT_DIRECTORY
set -euo pipefail
case=$(dirname "$(realpath "$0")")/../shear-capsule/case.toml
output=${1:?usage: run.sh OUTPUT_DIRECTORY}
tanktread --version >/dev/null
mkdir -p "$output" && cd "$output" && rm -rf staged record fused && mkdir staged

tanktread membrane --case "$case" --out staged/membrane.vtu
tanktread fluid --case "$case" --steps 0 --out staged/fluid.vti --fields flow.vti
for step in {1..10}; do
  tanktread coupler interpolate --case "$case" --in staged/membrane.vtu --grid flow.vti --out velocity.vtu
  tanktread membrane --case "$case" --in velocity.vtu --move --state staged/membrane.vtu --out staged/membrane.vtu
  tanktread coupler spread --case "$case" --in staged/membrane.vtu --out force.vti
  tanktread fluid --case "$case" --state staged/fluid.vti --force force.vti --out staged/fluid.vti --fields flow.vti
  echo "step $step"
done
tanktread run "$case" --output fused --shear-time 0.004 --record record --to 10 >fused.log
tanktread diff staged record/end --ignore echo.toml  # only a run knows its case
