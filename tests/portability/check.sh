#!/bin/sh
# Compiles every program in FOLDER for a kind of device that this machine need not have. Fails on register spills, on more
# registers than allow enough threads, and on large stack frames in private memory.
#   check.sh TARGET FOLDER       TARGET: nvptx64, amdgcn or spir64
# CLANG and LIBCLC name the compiler and the folder of OpenCL's built-in functions; PTXAS, if set, determines the registers
# of nvptx64; WARNINGS=-Werror makes a warning fail too.
set -eu
target=$1
folder=$2
failed=0

# -Weverything, less: padded (structs of scalars and vectors), declaration-after-statement (C99), float-equal (meant),
# unused-macros, unused-parameter, unreachable-code and constant-logical-operand (parts are constants), unsafe-buffer-usage
# (of C++; clang 15 has none), and in double precision double-promotion (of tables and exact constants).
compile() {
  "$CLANG" -x cl -cl-std=CL1.2 -O3 -Xclang -finclude-default-header ${WARNINGS-} -Weverything \
    -Wno-padded -Wno-declaration-after-statement -Wno-float-equal -Wno-unused-macros -Wno-unused-parameter \
    -Wno-unused-function -Wno-unreachable-code -Wno-unreachable-code-return -Wno-constant-logical-operand \
    -Wno-unknown-warning-option -Wno-unsafe-buffer-usage -Wno-linker-warnings -Wno-unused-command-line-argument $more "$@"
}

complain() {
  echo "$*"
  failed=1
}

# most NAME: the limit on registers. The program with every part, which no scene has, and double precision, which is for
# comparison and not for speed, may use all that a thread can have; those with three rough models, or with an environment
# map, a lens and a filter, more than others do.
most() {
  case $1 in *-double.* | everything*) echo 256 ;; rough-* | map-*) echo 232 ;; *) echo 192 ;; esac
}

# most_stack NAME: the limit on bytes of private memory. A traversal of the hierarchy needs STACK_SIZE (66) distances and
# children, 528 bytes in float32: path and rays have one, light two (subpaths, and shadow rays to the eye), bidir four. Queues
# of starts and shadow rays and the rest may use 1500, a fifth more than the largest (glass-bidir) when this was written.
# Double precision needs twice as much.
most_stack() {
  others=1500
  case $1 in
  *-double.*) echo $((2 * (4 * 528 + others))) ;;
  everything-brute-force.*) echo $others ;;
  everything-bidir.* | *mesh-bidir.*) echo $((4 * 528 + others)) ;;
  everything-light.*) echo $((2 * 528 + others)) ;;
  everything.* | mesh.* | rays.*) echo $((528 + others)) ;;
  *) echo $others ;;
  esac
}

# row NAME REGISTERS STACK SPILLS
row() {
  printf '%-34s %9s %11s %7s\n' "$@"
  [ "$2" = registers ] && return
  [ "$2" -le "$(most "$1")" ] || complain "$1: more than $(most "$1") registers"
  [ "$3" -le "$(most_stack "$1")" ] || complain "$1: more than $(most_stack "$1") bytes of stack"
  [ "$4" -eq 0 ] || complain "$1: registers are spilled"
}

# largest PATTERN FILE: the largest number that the group of PATTERN matches, 0 if there is none
largest() { { sed -n "s/$1/\\1/p" "$2"; echo 0; } | sort -n | tail -n 1; }

check_nvptx64() {
  compile --target=nvptx64-nvidia-nvcl -march=sm_80 -Xclang -mlink-builtin-bitcode -Xclang "$LIBCLC/nvptx64--nvidiacl.bc" \
    -S -o "$2.ptx" "$1" || return 1
  ! grep -n '\.extern' "$2.ptx" || return 1 # a function that no library has
  [ -n "${PTXAS-}" ] || return 0
  "$PTXAS" -arch=sm_90 -v -o /dev/null "$2.ptx" >"$2.ptxas" 2>&1 || { cat "$2.ptxas"; return 1; }
  row "$3" "$(largest '.*Used \([0-9]*\) registers.*' "$2.ptxas")" \
    "$(largest '.* \([0-9]*\) bytes stack frame.*' "$2.ptxas")" \
    "$(largest '.* \([0-9]*\) bytes spill stores.*' "$2.ptxas")"
}

check_amdgcn() {
  compile --target=amdgcn-amd-amdhsa -mcpu=gfx1030 -nogpulib -Xclang -mlink-builtin-bitcode \
    -Xclang "$LIBCLC/amdgcn--amdhsa.bc" -S -o "$2.s" "$1" || return 1
  row "$3" "$(largest ' *\.vgpr_count: *\([0-9]*\)' "$2.s")" \
    "$(largest ' *\.private_segment_fixed_size: *\([0-9]*\)' "$2.s")" \
    "$(largest ' *\.vgpr_spill_count: *\([0-9]*\)' "$2.s")"
}

# The front end alone: its errors and warnings are the check, and optimisation would take 20 times as long.
check_spir64() { compile --target=spir64 -S -emit-llvm -Xclang -disable-llvm-passes -o /dev/null "$1"; }

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
[ "$target" = spir64 ] || row program registers stack/bytes spilled
for width in $widths; do
  for program in "$folder"/*."$width".cl; do
    name=$(basename "$program" .cl)
    case $name in *-double.*) more=-Wno-double-promotion ;; *) more= ;; esac
    case $target-$name in nvptx64-*-native.*) echo "$name: not compiled, libclc has no native_exp2 there"; continue ;; esac
    "check_$target" "$program" "$out/$name" "$name" || complain "$name does not compile for $target"
    count=$((count + 1))
  done
done
echo "$count programs for $target"
exit "$failed"
