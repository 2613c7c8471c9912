#!/usr/bin/env bash
# Installs a build into a prefix, runs the program from there, and builds another project with the kernels of the prefix.
#   check.sh CMAKE BUILD CONSUMER
set -euo pipefail

cmake=$1 build=$2 consumer=$3
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
prefix=$folder/prefix
"$cmake" --install "$build" --prefix "$prefix" >"$folder/log" || { cat "$folder/log"; exit 1; }

cd "$folder"
"$prefix/bin/phlux" --version
zcat "$prefix/share/man/man1/phlux.1.gz" | grep -q '^\.TH PHLUX 1'
grep -q '^complete .*phlux$' "$prefix/share/bash-completion/completions/phlux"
head -n 1 "$prefix/share/zsh/vendor-completions/_phlux" | grep -qx '#compdef phlux'
[[ -z $(find "$prefix" -name '*.cmake' -path '*kernels*') ]]
grep -rl "$build" "$prefix" --include='*.cmake' && { echo "the package names the build folder"; exit 1; }

mv "$prefix" "$folder/moved" # the package must not depend on where it was installed
"$cmake" -S "$consumer" -B consumer -DCMAKE_PREFIX_PATH="$folder/moved" >log 2>&1 || { cat log; exit 1; }
"$cmake" --build consumer >log 2>&1 || { cat log; exit 1; }
./consumer/consumer
