#!/bin/sh
# Compiles every program in FOLDER for a kind of device that need not be here. A register spill fails, and so do more
# registers than a device can give to enough threads.
#   check.sh TARGET FOLDER       TARGET: nvptx64, amdgcn or spir64
# CLANG and LIBCLC name the compiler and the folder of OpenCL's built-in functions; PTXAS, where set, makes the registers
# of nvptx64 known; WARNINGS=-Werror makes a warning fail too.
set -eu
target=$1
folder=$2
failed=0

# -Weverything, less: padded (structs of scalars and vectors), declaration-after-statement (C99), float-equal (meant),
# unused-macros, unused-parameter and unreachable-code (of parts that a scene lacks), unsafe-buffer-usage (of C++; clang 15 has none), and in
# double precision double-promotion (of tables and exact constants).
compile() {
  "$CLANG" -x cl -cl-std=CL1.2 -O3 -Xclang -finclude-default-header ${WARNINGS-} -Weverything \
    -Wno-padded -Wno-declaration-after-statement -Wno-float-equal -Wno-unused-macros -Wno-unused-parameter \
    -Wno-unused-function -Wno-unreachable-code -Wno-unreachable-code-return -Wno-unknown-warning-option -Wno-unsafe-buffer-usage \
    -Wno-linker-warnings -Wno-unused-command-line-argument $more "$@"
}

complain() {
  echo "$*"
  failed=1
}

# most NAME: the ceiling on registers; the program that has everything at once is allowed more than scenes have, and doubles,
# which are there to be compared with and not for speed, all that a thread can have.
most() {
  case $1 in *-double.*) echo 255 ;; everything*) echo 232 ;; *) echo 192 ;; esac
}

check_nvptx64() {
  compile --target=nvptx64-nvidia-nvcl -march=sm_80 -Xclang -mlink-builtin-bitcode -Xclang "$LIBCLC/nvptx64--nvidiacl.bc" \
    -S -o "$2.ptx" "$1" || return 1
  ! grep -n '\.extern' "$2.ptx" || return 1 # a function that no library has
  [ -n "${PTXAS-}" ] || return 0
  "$PTXAS" -arch=sm_90 -v -o /dev/null "$2.ptx" >"$2.ptxas" 2>&1 || { cat "$2.ptxas"; return 1; }
  registers=$(sed -n 's/.*Used \([0-9]*\) registers.*/\1/p' "$2.ptxas" | sort -n | tail -n 1)
  echo "$3: $registers registers"
  ! grep 'spill' "$2.ptxas" | grep -qv ' 0 bytes spill stores, 0 bytes spill loads' || complain "$3: spills"
  [ "$registers" -le "$(most "$3")" ] || complain "$3: more than $(most "$3") registers"
}

check_amdgcn() {
  compile --target=amdgcn-amd-amdhsa -mcpu=gfx1030 -nogpulib -Xclang -mlink-builtin-bitcode \
    -Xclang "$LIBCLC/amdgcn--amdhsa.bc" -S -o "$2.s" "$1" || return 1
  registers=$(sed -n 's/^ *\.vgpr_count: *//p' "$2.s" | sort -n | tail -n 1)
  spills=$(sed -n 's/^ *\.vgpr_spill_count: *//p' "$2.s" | sort -n | tail -n 1)
  echo "$3: $registers vector registers"
  [ "$spills" -eq 0 ] || complain "$3: $spills vector registers spilled"
  [ "$registers" -le "$(most "$3")" ] || complain "$3: more than $(most "$3") vector registers"
}

check_spir64() { compile --target=spir64 -S -emit-llvm -o /dev/null "$1"; }

case $target in
nvptx64)
  widths=1
  [ -n "${PTXAS-}" ] || echo "no ptxas: registers are not checked"
  ;;
amdgcn) widths=1 ;;
spir64) widths="1 4 8 16" ;;
*) echo "check.sh: unknown target $target"; exit 2 ;;
esac

out=$folder/$target
mkdir -p "$out"
count=0
for width in $widths; do
  for program in "$folder"/*."$width".cl; do
    name=$(basename "$program" .cl)
    case $name in *-double.*) more=-Wno-double-promotion ;; *) more= ;; esac
    "check_$target" "$program" "$out/$name" "$name" || complain "$name does not compile for $target"
    count=$((count + 1))
  done
done
echo "$count programs for $target"
exit "$failed"
