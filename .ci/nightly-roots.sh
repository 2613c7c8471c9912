# Runs the README's commands on bare Debians. Sourced by .ci/nightly.
# shellcheck shell=bash disable=SC2154 # variables that nightly sets

declare -A codename=([12]=bookworm [13]=trixie)
clone=/srv/phlux # the same for every user, since ccache stores paths

# enter ROOT USER COMMAND...: runs the command in the clone in the root, with /proc, /dev and /sys. Mounts and processes end
# with it: the inner bash is their init, and ends with unshare.
enter() {
  local root=$1 user=$2 home=/root path=/usr/local/sbin:/usr/local/bin:/usr/sbin:/usr/bin:/sbin:/bin more=()
  shift 2
  if [[ $user != root ]]; then home=/home/$user path=/usr/local/bin:/usr/bin:/bin; fi
  if [[ $ccache ]]; then
    more=(CCACHE_DIR=/ccache CCACHE_BASEDIR="$clone" CCACHE_NOHASHDIR=1 CCACHE_COMPILERCHECK=content CCACHE_UMASK=000)
  fi
  # shellcheck disable=SC2016 # for the inner bash
  ROOT=$root CACHE=$ccache unshare --mount --pid --fork --kill-child bash -ec '
    mount -t proc proc "$ROOT/proc"
    mount --rbind /dev "$ROOT/dev"
    mount --rbind /sys "$ROOT/sys"
    if [[ $CACHE ]]; then mkdir -p "$ROOT/ccache"; mount --bind "$CACHE" "$ROOT/ccache"; fi
    chroot "$@"' _ --userspec="$user:$user" "$root" \
    env -i HOME="$home" USER="$user" PATH="$path" LANG=C.UTF-8 TERM=dumb "${more[@]}" \
    sh -c "cd $clone && exec \"\$@\"" _ "$@"
}

bootstrap() { # RELEASE ROOT
  command -v debootstrap >/dev/null || apt-get install -y --no-remove debootstrap || return
  rm -rf --one-file-system "$2.new"
  debootstrap --variant=minbase "${codename[$1]}" "$2.new" http://deb.debian.org/debian && mv "$2.new" "$2"
}

# bare_root RELEASE: the root as made by debootstrap; sets `bare`.
bare_root() {
  bare=$folder/debian$1-bare
  [[ -d $bare ]] || timed "Debian $1: debootstrap" "debian$1-bare" bootstrap "$1" "$bare"
}

# Prerequisites of the README: git, a clone, and a user with sudo. Also ccache, if requested.
furnish() { # ROOT USER
  local packages=(git)
  if [[ $ccache ]]; then packages+=(ccache); fi
  if [[ $2 != root ]]; then packages+=(sudo); fi
  enter_bare "$1" apt-get install -y --no-install-recommends "${packages[@]}" || return
  if [[ $2 != root ]]; then
    chroot "$1" useradd --create-home --shell /bin/bash "$2" || return
    echo "$2 ALL=(ALL) NOPASSWD: ALL" >"$1/etc/sudoers.d/$2"
  fi
  git clone --quiet --no-hardlinks "$repository" "$1$clone" && chroot "$1" chown -R "$2:$2" "$clone"
}
enter_bare() { # enter() before the clone exists
  mkdir -p "$1$clone"
  enter "$1" root sh -c 'apt-get update -q && exec "$@"' _ "${@:2}" && rmdir "$1$clone"
}

update_clone() { # ROOT USER
  git -c safe.directory='*' -C "$1$clone" fetch --quiet "$repository" HEAD &&
    git -c safe.directory='*' -C "$1$clone" reset --quiet --hard FETCH_HEAD && chroot "$1" chown -R "$2:$2" "$clone"
}

# fresh_root RELEASE USER: a root in which the program has never run, or that of an earlier call; sets `root`.
fresh_root() {
  bare_root "$1" || return
  root=$folder/debian$1-$2
  if [[ -d $root ]]; then update_clone "$root" "$2"; return; fi
  rm -rf --one-file-system "$root.new" # from an interrupted call
  cp -a "$bare" "$root.new"
  timed "Debian $1, $2: user and clone" "debian$1-$2-furnish" furnish "$root.new" "$2" || return
  mv "$root.new" "$root"
}

# Unexpected messages of the launcher and of the program, and removed packages.
stumbles_of() {
  { grep -E '^phlux: (not installed|going on|warning|error|internal|the build|configuring failed)|FAILED|^E: ' "$1" || true
    sed -n 's/^Remove: /removed: /p' "$root/var/log/apt/history.log" 2>/dev/null; } | sort -u | head -n 5 | paste -sd ';'
}
tests_and_left_out() {
  printf '%s, %s disabled, %s skipped' "$(tests_of "$1")" "$(grep -c '(Disabled)$' "$1")" "$(grep -c '(Skipped)$' "$1")"
}

commands_in() { # RELEASE USER
  local filter=() all="all tests"
  if [[ $2 != root && $user_tests ]]; then filter=(-R "$user_tests") all="tests -R $user_tests"; fi
  fresh_root "$1" "$2" || return 0
  export STUMBLES=stumbles_of
  timed "Debian $1, $2: ./phlux render" "debian$1-$2-render" enter "$root" "$2" ./phlux render scenes/cornell-box.xml || true
  [[ -s $root$clone/cornell-box.exr ]] || { failed=1; note "Debian $1, $2: the image" 0 "FAILED: none" ""; }
  JUDGE=tests_and_left_out timed "Debian $1, $2: ./phlux test, $all" "debian$1-$2-test" \
    enter "$root" "$2" ./phlux test "${filter[@]}" || true
  timed "Debian $1, $2: ./phlux --version" "debian$1-$2-version" enter "$root" "$2" ./phlux --version || true
  unset STUMBLES
}

stage_roots() {
  local release user
  for release in $releases; do
    for user in root tester; do commands_in "$release" "$user"; done
  done
}
