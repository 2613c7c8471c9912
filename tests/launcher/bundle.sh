#!/usr/bin/env bash
# Checks the folder that ./phlux bundle makes: it needs no library of this machine, uses this machine's libraries of the
# compiler where they are new enough, as drivers do, and the program in it renders.
#   bundle.sh LAUNCHER PROGRAM SCENE
set -euo pipefail
launcher=$1 program=$2 scene=$3
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT

# A clone in which the launcher has nothing to build.
mkdir -p "$folder/clone/"{host,kernels,bench} "$folder/clone/build/bundle"
touch "$folder/clone/"{CMakeLists.txt,CMakePresets.json,LICENSE}
cp "$launcher" "$folder/clone/phlux"
cp "$program" "$folder/clone/build/bundle/phlux"
bundle=$folder/bundle
"$folder/clone/phlux" bundle "$bundle"

# With this machine's libraries of the compiler and glibc, with its glibc alone, and with neither.
common='libc\.so\|libm\.so\|ld-linux\|linux-vdso'
for path in "$bundle/lib" "$bundle/lib:$bundle/lib/compiler" "$bundle/lib:$bundle/lib/compiler:$bundle/lib/glibc"; do
  loader=$(echo /lib*/ld-linux-*.so.*) machine=$common
  if [[ $path == *glibc ]]; then loader=$(echo "$bundle"/lib/glibc/ld-linux-*) machine='linux-vdso'; fi
  if [[ $path == *lib ]]; then machine+='\|libstdc++\.so\|libgcc_s\.so\|libz\.so'; fi
  "$loader" --library-path "$path" --list "$bundle/lib/phlux" >"$folder/libraries"
  if grep -v "=> $bundle/lib\|$machine" "$folder/libraries"; then
    echo "FAILED: these libraries are not in the bundle"
    exit 1
  fi
  "$loader" --library-path "$path" "$bundle/lib/phlux" devices
done
(cd "$folder" && bundle/phlux render "$scene" --size 16x16 --spp 1 -o image.exr)
if "$folder/clone/phlux" bundle "$bundle" 2>"$folder/err" || ! grep -q "is not an empty folder" "$folder/err"; then
  echo "FAILED: a folder with files is overwritten"
  exit 1
fi
