#!/usr/bin/env bash
# Vesicles from spheroids to rest, and their energies; then the pictures and the tables.
#   cases/run vesicle, or with a tanktread in PATH: cases/vesicle/run.sh OUTPUT_DIRECTORY [LEVELS [SHAPE ...]]
# LEVELS: of the mesh, "2 3" by default; SHAPE: of shapes.csv, all by default. What is finished is kept.
set -euo pipefail
here=$(dirname "$(realpath "$0")")
output=${1:?usage: run.sh OUTPUT_DIRECTORY [LEVELS [SHAPE ...]]}
levels=${2:-2 3}
wanted=" ${*:3} "
tanktread --version >/dev/null
mkdir -p "$output" && output=$(realpath "$output")
while IFS=, read -r shape branch v ratio modulus area volume time longest; do
  if [[ $shape == \#* || $shape == shape || ($wanted != "  " && $wanted != *" $shape "*) ]]; then continue; fi
  for level in $levels; do
    folder=$output/$shape-$level
    if [ -f "$folder/energy/energy.csv" ]; then continue; fi
    rm -rf "$folder" && mkdir "$folder"
    tanktread mesh spheroid --level "$level" --aspect-ratio "$ratio" "$folder/start.vtu" >/dev/null
    if [ "$branch" = stomatocyte ]; then PYTHONPATH="$here/../../post" /usr/bin/python3 "$here/cup.py" "$folder/start.vtu" "$folder/start.vtu" "$v"; fi
    step=$(awk -v l="$level" -v s="$longest" 'BEGIN { print s * 16^(2 - l) }') # the rate of a node goes as h^-4
    echo "$shape, level $level"
    tanktread membrane drag --case "$here/case.toml" --set "capsule.0.mesh={file=\"$folder/start.vtu\"}" --set membrane.reference_area="$area" \
      --set membrane.reference_volume="$volume" --set membrane.local_area_modulus="$modulus" --set membrane.volume_modulus="$modulus" --shear-time "$time" --step "$step" --out "$folder/drag" >"$folder/drag.log"
    last=$(find "$folder/drag/membrane" -name '*.vtu' | sort | tail -n 1)
    ln "$last" "$folder/end.vtu"
    tanktread run "$here/case.toml" --set "capsule.0.mesh={file=\"$folder/end.vtu\"}" --shear-time 0 --output "$folder/energy" >"$folder/energy.log" 2>&1
  done
done <"$here/shapes.csv"

cd "$here/../.."
export PYTHONPATH=post PYTHONDONTWRITEBYTECODE=1
/usr/bin/python3 -c 'import pathlib, sys; from tanktread_post import case_analysis
for name, text in case_analysis.load(sys.argv[2]).measured(*sys.argv[1:]).items(): (pathlib.Path(sys.argv[1]) / name).write_text(text)' "$output" "$here"
/usr/bin/python3 -m tanktread_post plot "$output" --case "$here"
/usr/bin/python3 -m tanktread_post compare "$output" --case "$here"
