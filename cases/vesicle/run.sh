#!/usr/bin/env bash
# Vesicles to rest, in rounds, and their energies; then the pictures and the tables.
#   cases/run vesicle, or with a tanktread in PATH: cases/vesicle/run.sh OUTPUT_DIRECTORY [--measure] [LEVELS [SHAPE ...]]
# LEVELS: of the mesh, "2 3" by default; SHAPE: of shapes.csv, all by default. What is finished is kept. --measure: tables and pictures go to measured/.
# Exit codes: 0; 1 an energy outside its band, or a vesicle not at rest; 3 a run went wrong (the others are made all the same).
set -euo pipefail
here=$(dirname "$(realpath "$0")")
output=${1:?usage: run.sh OUTPUT_DIRECTORY [--measure] [LEVELS [SHAPE ...]]}
shift
measure=
[ "${1:-}" != --measure ] || { measure=$1; shift; }
levels=${1:-2 3}
wanted=" ${*:2} "
rounds=3     # the law of a round is free of stress where the round before came to rest
still=0.03   # as [analyse] of compare.toml: a vesicle is at rest
longest=3    # shear times of a round
export PYTHONPATH="$here/../../post" PYTHONDONTWRITEBYTECODE=1
tanktread --version >/dev/null
mkdir -p "$output" && output=$(realpath "$output")

# come_to_rest FOLDER OPTIONS: from start.vtu to end.vtu and drag/
come_to_rest() {
  local folder=$1 options=("${@:2}") from=() round drag last
  for ((round = 1; round <= rounds; ++round)); do
    drag=$folder/drag-$round
    tanktread membrane drag --case "$here/case.toml" "${options[@]}" "${from[@]}" --shear-time "$longest" --still "$still" --out "$drag" >"$drag.log" 2>&1 || return
    last=$(find "$drag/membrane" -name '*.vtu' | sort | tail -n 1)
    from=(--in "$last" --set "capsule.0.stress_free={file=\"$last\"}")
  done
  ln "$last" "$folder/end.vtu"
  ln -s "drag-$rounds" "$folder/drag"
  tanktread run "$here/case.toml" --set "capsule.0.mesh={file=\"$folder/end.vtu\"}" --shear-time 0 --output "$folder/energy" >"$folder/energy.log" 2>&1
}

code=0
while IFS=, read -r shape branch v ratio modulus area volume coarsest; do
  if [[ $shape == \#* || $shape == shape || ($wanted != "  " && $wanted != *" $shape "*) ]]; then continue; fi
  for level in $levels; do
    folder=$output/$shape-$level
    if [ -f "$folder/energy/energy.csv" ] || [ "$level" -lt "$coarsest" ]; then continue; fi
    rm -rf "$folder" && mkdir "$folder"
    if [ "$branch" = stomatocyte ]; then
      /usr/bin/python3 "$here/cup.py" "$folder/start.vtu" "$level" "$v"
    else
      tanktread mesh spheroid --level "$level" --aspect-ratio "$ratio" "$folder/start.vtu" >/dev/null
    fi
    echo "$shape, level $level"
    if ! come_to_rest "$folder" --set "capsule.0.mesh={file=\"$folder/start.vtu\"}" --set membrane.reference_area="$area" \
      --set membrane.reference_volume="$volume" --set membrane.local_area_modulus="$modulus" --set membrane.volume_modulus="$modulus"; then
      echo "$shape, level $level: went wrong: $(tail -qn 1 "$folder"/*.log | tail -n 1)" >&2
      code=3
    fi
  done
done <"$here/shapes.csv"

/usr/bin/python3 -m tanktread_post plot "$output" --case "$here"
if [ -n "$measure" ]; then
  /usr/bin/python3 -m tanktread_post keep "$output" --case "$here" --made-by "cases/run vesicle $*, by $(tanktread --version)"
fi
/usr/bin/python3 -m tanktread_post compare "$output" --case "$here" || code=$((code > $? ? code : $?))
exit "$code"
