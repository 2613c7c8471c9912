# Builds the Debian package, and installs, runs and removes it on a bare Debian. Sourced by .ci/nightly.
# shellcheck shell=bash disable=SC2154 # variables that nightly sets

build_package() { # FOLDER
  build_apart release "$1" && (cd "$1" && rm -f ./*.deb && cpack -G DEB)
}

# In the bare root: dependencies come from its archive, as for a user.
# shellcheck disable=SC2016 # for the inner sh
use_package() { # ROOT
  enter_bare "$1" sh -euxc '
    apt-get install -y /srv/phlux.deb
    test -s /usr/share/man/man1/phlux.1.gz || test -s /usr/share/man/man1/phlux.1
    test -s /usr/share/bash-completion/completions/phlux
    cd /tmp
    phlux --version
    phlux devices
    phlux render /srv/cornell-box.xml --size 32x32 -n 4
    test -s cornell-box.exr
    apt-get remove -y phlux
    ! command -v phlux
    test ! -e /usr/share/phlux'
}

stage_package() {
  local build=$folder/release root=$folder/debian12-package
  timed "package: build" package-build build_package "$build" || return 0
  bare_root 12 || return 0
  rm -rf --one-file-system "$root"
  cp -a "$bare" "$root"
  cp "$build"/*.deb "$root/srv/phlux.deb"
  cp "$repository/scenes/cornell-box.xml" "$root/srv/"
  timed "package: install, run, remove" package-use use_package "$root" || true
}
