#!/bin/sh
# Runs COMMAND with oclgrind as the only OpenCL platform. Fails if COMMAND fails, and if oclgrind reports anything, since its own
# exit status is 0 even then. Kernels are built without optimisation, because with it this version of oclgrind fails on
# llvm.experimental.noalias.scope.decl.
#   oclgrind.sh FOLDER COMMAND...     FOLDER: for the log and the platform's description
set -eu
folder=$1
shift
library=${OCLGRIND_LIBRARY:-/usr/lib/oclgrind/liboclgrind-rt-icd.so}

rm -rf "$folder"
mkdir -p "$folder/vendors"
echo "$library" > "$folder/vendors/oclgrind.icd"
: > "$folder/log"

status=0
OCL_ICD_VENDORS="$folder/vendors" PHLUX_DEVICE=oclgrind PHLUX_CACHE_DIR="$folder/cache" \
PHLUX_KERNEL_OPTIONS="${PHLUX_KERNEL_OPTIONS:-} -cl-opt-disable" \
OCLGRIND_LOG="$folder/log" OCLGRIND_DATA_RACES=1 "$@" || status=$?
if [ -s "$folder/log" ]; then
  echo "oclgrind reports:"
  head -n 200 "$folder/log"
  exit 1
fi
exit "$status"
