#!/usr/bin/env bash
# Checks the apt-get commands of ./phlux on simulated machines: a copy of it runs with stand-ins for dpkg, apt, sudo, cmake and
# ctest. INSTALLED lists the installed packages, RELEASE those of the release. Installing one version of libclc removes another.
#   check.sh PHLUX
# shellcheck disable=SC2317 # functions that only expect() calls
set -euo pipefail
phlux=$1
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
mkdir -p "$folder/bin" "$folder/clone/build"
cp "$phlux" "$folder/clone/phlux"
export FOLDER=$folder

stand_in() { { echo '#!/usr/bin/env bash'; cat; } >"$folder/bin/$1"; chmod +x "$folder/bin/$1"; }

stand_in dpkg-query <<'END'
for pattern; do :; done # the last argument
for package in $INSTALLED; do
  # shellcheck disable=SC2053
  [[ $package == $pattern ]] || continue
  if [[ $2 == *Package* ]]; then echo "installed $package"; else printf installed; fi
done
END
stand_in apt-cache <<'END'
[[ " $RELEASE " != *" $2 "* ]] || echo "Package: $2"
END
stand_in apt-get <<'END'
simulated=no packages=()
for argument; do
  case $argument in
  -s) simulated=yes ;;
  install | -*) ;;
  update) echo update >>"$FOLDER/asked"; exit "${UPDATE_FAILS:-0}" ;;
  *) packages+=("$argument") ;;
  esac
done
[[ $simulated == yes ]] || echo "$*" >>"$FOLDER/asked"
for package in "${packages[@]}"; do
  [[ " $RELEASE " == *" $package "* ]] || exit 100
  [[ $package == libclc-* ]] || continue
  version=${package#libclc-}
  for other in $INSTALLED "${packages[@]}"; do
    if [[ $other == libclc-* && $other != "libclc-${version%-dev}"* ]]; then
      [[ " $* " != *" --no-remove "* ]] || exit 100
      echo "$other" >>"$FOLDER/removed"
    fi
  done
done
END
stand_in sudo <<'END'
exec "$@"
END
stand_in cmake <<'END'
echo "no such thing: something is not checked" >"$FOLDER/clone/build/tests-left-out.txt"
END
stand_in ctest <<'END'
echo tested
END

needed=$(sed -n '/^build_packages=(/,/)$/p' "$phlux" | tr '()\n' '   ' | sed 's/build_packages=//')
failed=0
expect() { # MESSAGE CONDITION...
  local message=$1
  shift
  "$@" || { echo "FAILED: $message"; cat "$folder/asked" "$folder/err"; failed=1; }
}
says() { grep -qF -- "$1" "$folder/err"; }
asked() { grep -q -- "$1" "$folder/asked"; }
never() { ! "$@"; }
machine() { # INSTALLED RELEASE [COMMAND...]: runs ./phlux test on it, by COMMAND
  : >"$folder/asked"
  rm -f "$folder/removed"
  INSTALLED=$1 RELEASE=$2 PATH=$folder/bin:$PATH "${@:3}" "$folder/clone/phlux" test >"$folder/out" 2>"$folder/err" ||
    { echo "FAILED: it ends with $?"; cat "$folder/err"; failed=1; }
  expect "the tests run" grep -qx tested "$folder/out"
  expect "nothing is removed" test ! -e "$folder/removed"
  expect "every installation has --no-remove" never grep -v -- '--no-remove\|^update' "$folder/asked"
  expect "what CMake leaves out is told" says "not tested: no such thing: something is not checked"
}
packages() { local version; for version; do printf ' %s' "clang-$version" "libclc-$version" "libclc-$version-dev"; done; }
others="python3-matplotlib chromium librandom123-dev libopenmpi-dev openmpi-bin"

echo "Debian 12, bare"
machine "" "$needed $others oclgrind $(packages 14 15)"
expect "what building needs is installed" asked ' g++ .* catch2'
expect "oclgrind is installed" asked ' oclgrind'
expect "clang 15 for GPUs" asked 'clang-15 libclc-15 libclc-15-dev'
expect "nothing is left out" never says "not installed"

echo "Debian 13, with mesa's OpenCL and its libclc-19 beside PoCL's clang 18"
machine "$needed libclang-common-18-dev libclc-19" "$needed $others $(packages 18 19)"
expect "the libclc that is there" asked 'clang-19 libclc-19-dev'
expect "not the other" never asked libclc-18
expect "no oclgrind, and a word on it" says "not installed: oclgrind: this release has none"

echo "Debian 13, with PoCL's clang 18"
machine "$needed libclang-common-18-dev" "$needed $others $(packages 18 19)"
expect "its libclc" asked 'clang-18 libclc-18 libclc-18-dev'

echo "a libclc that is there without a clang in the release"
machine "$needed $others oclgrind libclang-common-18-dev libclc-17" "$(packages 18)"
expect "no libclc, and a word on it" says "not installed: libclc with its clang"
expect "nothing is installed" never asked install

echo "all is there"
machine "$needed $others oclgrind $(packages 15)" ""
expect "nothing is asked" test ! -s "$folder/asked"

echo "a source of packages that does not answer"
UPDATE_FAILS=100 machine "" "$needed $others oclgrind $(packages 15)"
expect "it goes on" says "apt-get update failed: going on"

rm "$folder/bin/sudo"
as_user=(setpriv --reuid 65534 --clear-groups)
if ((EUID != 0)) || command -v sudo >/dev/null; then
  echo "not checked: a user without sudo, which only root without sudo can become"
elif ! "${as_user[@]}" test -w /dev/null; then
  echo "not checked: a user without sudo, because only root may write to /dev/null here"
else
  echo "a user without sudo, and root has installed what building needs"
  chmod -R go+rwX "$folder"
  machine "$needed $others" "oclgrind $(packages 15)" "${as_user[@]}"
  expect "what root should install" says "there is no sudo. As root: apt-get install --no-install-recommends oclgrind"
  expect "nothing is asked" test ! -s "$folder/asked"
fi

exit "$failed"
