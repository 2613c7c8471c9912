#!/usr/bin/env bash
# Checks the scripts for Slurm: their syntax, with shellcheck where it is installed, and the commands that they run, with
# stand-ins for phlux and srun that print their arguments.
#   sbatch.sh FOLDER
set -euo pipefail
scripts=$(readlink -f "$1")
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
mkdir "$folder/bin"
for name in phlux srun; do
  printf '#!/bin/sh\necho "%s $*"\n' "$name" >"$folder/bin/$name"
  chmod +x "$folder/bin/$name"
done
export PATH=$folder/bin:$PATH

for script in "$scripts"/*.sbatch; do
  bash -n "$script"
  if command -v shellcheck >/dev/null; then shellcheck "$script"; fi
done

# expect WORDS COMMAND...: what the command prints has the words.
expect() {
  local output
  output=$("${@:2}")
  if [[ $output != *"$1"* ]]; then
    printf '%s\nprints: %s\ninstead of: %s\n' "${*:2}" "$output" "$1" >&2
    exit 1
  fi
}
cd "$folder"
render=(bash "$scripts/render.sbatch" scene.xml --spp 8)
array=(env SLURM_ARRAY_TASK_ID=3 bash "$scripts/array.sbatch" scene.xml 256)
expect "phlux render scene.xml --spp 8 --checkpoint phlux.checkpoint" "${render[@]}"
expect "phlux render scene.xml --checkpoint part-0003.checkpoint --spp 256 --first-sample 768" "${array[@]}"
touch phlux.checkpoint part-0003.checkpoint
expect "phlux render scene.xml --spp 8 --resume phlux.checkpoint" "${render[@]}"
expect "phlux render scene.xml --resume part-0003.checkpoint --png none --moments -o part-0003.exr" "${array[@]}"
