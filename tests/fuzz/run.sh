#!/usr/bin/env bash
# Runs each fuzzer of a build for some seconds, from the inputs of tests/fuzz/corpus.
#   tests/fuzz/run.sh BUILD SECONDS [FOLDER]      FOLDER: what is found is kept there; default: a temporary one
# The exit code is 1 if one failed: an input that crashed, took 10 s, or 2 GB of memory.
set -euo pipefail
here=$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")
build=$1 seconds=$2 found=${3:-$(mktemp -d)} failed=0
for corpus in "$here"/corpus/*/; do
  name=$(basename "$corpus")
  mkdir -p "$found/$name"
  echo "fuzz_$name"
  "$build/tests/fuzz/fuzz_$name" -max_total_time="$seconds" -timeout=10 -rss_limit_mb=2048 -malloc_limit_mb=1024 \
    -max_len=65536 -artifact_prefix="$found/$name-" -print_final_stats=1 -verbosity=0 "$found/$name" "$corpus" || failed=1
done
exit "$failed"
