# Other OpenCL drivers: runs verify on each and compares their images. Sourced by .ci/nightly.
# shellcheck shell=bash disable=SC2034,SC2154 # variables that nightly sets and reads

# The Debian release in whose root each driver runs.
declare -A release_of=([pocl-3.1]=12 [pocl-6]=13 [intel]=12 [rusticl]=13)
drivers=(pocl-3.1 pocl-6 intel rusticl) # the others are compared with the first

widths_of() { if [[ $1 == rusticl ]]; then echo 1; else echo 1 4 8 16; fi; } # rusticl compiles the others for minutes
image="--size 24x24 --spp 64 --seed 1 --moments --png none -q"
# The same samples on each driver, so that images differ only by rounding and its consequences: far less than noise, unless a
# driver is wrong. The limits are nevertheless those of noise: of 400,000 normal z-values one exceeds 6 in 1 of 1000 runs.
largest_z=6 largest_share=0.003

# on DRIVER COMMAND...
on() {
  local driver=$1 more=()
  shift
  root=$folder/debian${release_of[$driver]}-root
  if [[ $driver == intel ]]; then # it needs a newer TBB than Embree, and both use the one loaded first
    more=(OCL_ICD_VENDORS=/opt/intel-vendors LD_PRELOAD=/opt/intel/libtbb.so.12)
  elif [[ $driver == rusticl ]]; then # on the processor, by llvmpipe
    more=(OCL_ICD_VENDORS=/etc/OpenCL/vendors/rusticl.icd RUSTICL_ENABLE=llvmpipe)
  fi
  enter "$root" root env "${more[@]}" PHLUX_CACHE_DIR="/var/cache/phlux-$driver" POCL_CACHE_DIR="/var/cache/pocl-$driver" "$@"
}

fetch_intel() { # from PyPI, with pip of this machine, as a bare root has no Python
  python3 -m venv "$folder/intel" &&
    "$folder/intel/bin/pip" install --quiet intel-opencl-rt intel-cmplr-lib-rt
}

install_intel() { # ROOT
  [[ -d $folder/intel ]] || fetch_intel || return
  mkdir -p "$1/opt/intel" "$1/opt/intel-vendors"
  cp -a "$folder"/intel/lib/. "$1/opt/intel/"
  echo /opt/intel/libintelocl.so >"$1/opt/intel-vendors/intel.icd"
}

set_up() { # DRIVER
  # The one scene whose mesh is generated, with the python3 of this machine.
  [[ -s $root$clone/scenes/stability/million-lights.ply ]] || python3 "$root$clone/scenes/stability/million_lights.py" || return
  if [[ $1 == intel ]]; then install_intel "$root" || return; fi
  if [[ $1 == rusticl ]]; then
    enter "$root" root apt-get install -y --no-remove --no-install-recommends mesa-opencl-icd || return
  fi
  on "$1" ./phlux --version && on "$1" ./phlux devices
}

verify_on() { # DRIVER
  local width
  for width in $(widths_of "$1"); do
    JUDGE=verdict timed "$1: verify --quick --width $width" "$1-verify-$width" on "$1" ./phlux verify --quick --width "$width" ||
      true
  done
  # In all variants, of which --quick has some.
  JUDGE=verdict timed "$1: verify of integrators" "$1-verify-integrators" on "$1" ./phlux verify --integrator path \
    --integrator light --integrator bidir || true
}
verdict() { grep -E '^(passed|FAILED)|^portable lanes' "$1" | head -n 3 | paste -sd ';'; }

# Arguments of the renders: the shipped scenes by their own integrators, and two of them by the others.
renders() {
  local scene
  for scene in "$repository"/scenes/*.xml "$repository"/scenes/stability/*.xml; do
    printf '%s\n' "${scene#"$repository"/}"
  done
  for scene in glossy-box caustic; do
    printf '%s\n' "scenes/$scene.xml -i light" "scenes/$scene.xml -i bidir"
  done
}
file_of() { tr -c 'a-z0-9\n-' _ <<<"$1"; } # file name for a line of renders

render_all() { # DRIVER
  local line status=0
  while read -r line; do
    # shellcheck disable=SC2086 # options
    on "$1" ./phlux render $line $image -o "/srv/$1-$(file_of "$line").exr" </dev/null || { echo "FAILED: $line"; status=1; }
    mv "$root/srv/$1-$(file_of "$line").exr" "$images/" || status=1
  done < <(renders)
  return "$status"
}

# compare_all DRIVER: compares its images with those of the first driver, in the root of the first.
compare_all() {
  local line status=0
  cp "$images/"*.exr "$folder/debian${release_of[${drivers[0]}]}-root/srv/"
  while read -r line; do
    printf '%s ' "$line"
    on "${drivers[0]}" ./phlux compare "/srv/$1-$(file_of "$line").exr" "/srv/${drivers[0]}-$(file_of "$line").exr" --json \
      </dev/null | python3 -c '
import json, sys
figures = json.load(sys.stdin)
good = figures["nonfinite"] == 0 and figures["max_z"] <= float(sys.argv[1]) and figures["z_share_over_3"] <= float(sys.argv[2])
print("max_z %.2g share %.2g" % (figures["max_z"], figures["z_share_over_3"]), "" if good else "DIFFERS")
sys.exit(not good)' "$largest_z" "$largest_share" || status=1
  done < <(renders)
  return "$status"
}
worst_z() {
  printf '%s images, largest z %s%s' "$(grep -c max_z "$1")" "$(sed -n 's/.*max_z \([^ ]*\) .*/\1/p' "$1" | sort -g | tail -n 1)" \
    "$(sed -n 's/\(.*\) max_z \(.*\) DIFFERS$/; \1: z \2/p' "$1" | tr -d '\n')"
}

stage_drivers() {
  local driver
  images=$folder/images
  mkdir -p "$images"
  for driver in "${drivers[@]}"; do
    fresh_root "${release_of[$driver]}" root || continue
    timed "$driver: set up" "$driver-setup" set_up "$driver" || continue
    verify_on "$driver"
    timed "$driver: renders of all scenes" "$driver-renders" render_all "$driver" || true
    [[ $driver == "${drivers[0]}" ]] ||
      JUDGE=worst_z timed "$driver: its images against ${drivers[0]}'s" "$driver-compare" compare_all "$driver" || true
  done
}
