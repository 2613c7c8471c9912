# The Debian package of each release: built in a root of that release, and installed, run, upgraded and removed in a bare one,
# where dependencies come from the archive, as for a user. Sourced by .ci/nightly.
# shellcheck shell=bash disable=SC2154 # variables that nightly sets

# Lintian's two exceptions: CHANGELOG.md is there, but not in Debian's form; and nobody maintains the package by mail.

# In a root with the clone, where ./phlux installs what building needs. Also builds a package of an older version, to upgrade.
# shellcheck disable=SC2016 # for the inner sh
build_package() { # ROOT
  enter "$1" root sh -euxc '
    ./phlux --version
    apt-get install -y --no-install-recommends dpkg-dev file lintian
    rm -rf /srv/package
    mkdir -p /srv/package/older
    cpack --config build/CPackConfig.cmake -B /srv/package
    cpack --config build/CPackConfig.cmake -B /srv/package/older -D CPACK_PACKAGE_VERSION=0.0.1
    lintian --allow-root --fail-on error,warning --suppress-tags no-changelog,bogus-mail-host /srv/package/*.deb'
}

# shellcheck disable=SC2016 # for the inner sh
use_package() { # ROOT
  enter_bare "$1" sh -euxc '
    apt-get install -y --no-install-recommends man-db
    apt-get install -y --no-install-recommends /srv/package/older/*.deb
    apt-get install -y --no-install-recommends /srv/package/*.deb
    test "$(dpkg-query -W -f "\${Version}" phlux)" != 0.0.1
    dpkg-query -L phlux >/srv/files
    cd /tmp
    phlux --version
    phlux devices
    phlux render /srv/cornell-box.xml --size 32x32 -n 4
    test -s cornell-box.exr
    test -s cornell-box.png
    phlux verify --quick
    man --pager=cat phlux | grep -q -- --integrator
    bash -euc "source /usr/share/bash-completion/completions/phlux; COMP_WORDS=(phlux re) COMP_CWORD=1; _phlux;
               test \"\${COMPREPLY[*]}\" = render"
    test -s /usr/share/zsh/vendor-completions/_phlux
    apt-get remove -y phlux
    left=$(while read -r file; do test ! -e "$file" || dpkg-query -S "$file" >/dev/null 2>&1 || echo "$file"; done </srv/files)
    test -z "$left"'
}

package_of() { # RELEASE
  fresh_root "$1" root || return 0
  timed "Debian $1: package" "package$1-build" build_package "$root" || return 0
  local user=$folder/debian$1-package
  rm -rf --one-file-system "$user"
  cp -a "$bare" "$user"
  cp -a "$root/srv/package" "$repository/scenes/cornell-box.xml" "$user/srv/"
  timed "Debian $1: package installed, upgraded, run, removed" "package$1-use" use_package "$user" || true
}

stage_package() {
  local release
  for release in $releases; do package_of "$release"; done
}
