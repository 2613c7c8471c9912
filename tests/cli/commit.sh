#!/bin/sh
# Checks that the header for `phlux --version` names the commit, marks modified sources, and is rewritten only if it changes.
#   commit.sh GIT CMAKE write_commit.cmake
set -eu
git=$1 cmake=$2 script=$3
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
export GIT_CONFIG_GLOBAL=/dev/null GIT_CONFIG_SYSTEM=/dev/null
export GIT_AUTHOR_NAME=a GIT_AUTHOR_EMAIL=a@b GIT_COMMITTER_NAME=a GIT_COMMITTER_EMAIL=a@b

write() { "$cmake" -DGIT="$git" -DSOURCE="$folder/clone" -DOUTPUT="$folder/commit.h" -P "$script"; }
expect() { # TEXT
  grep -qF "#define PHLUX_COMMIT \"$1\"" commit.h || { echo "expected $1:"; cat commit.h; exit 1; }
}
commit() { (cd clone && "$git" add -A && "$git" commit -qm "$1" --date 2001-02-03T12:00:00Z); }
head_of_clone() { (cd clone && "$git" log -1 --format='%h of %cs'); }

mkdir -p clone/host
echo one >clone/host/a.cpp
write && expect unknown
(cd clone && "$git" init -q)
write && expect unknown
commit first
write && expect "$(head_of_clone)"
echo two >clone/host/a.cpp
write && expect "$(head_of_clone), with changes"
commit second
write && expect "$(head_of_clone)"
echo three >clone/host/new.cpp
write && expect "$(head_of_clone), with changes"
rm clone/host/new.cpp
echo text >clone/README.md # nothing that is built
write && expect "$(head_of_clone)"

touch -d 2001-01-01 commit.h
write
[ -z "$(find commit.h -newermt 2001-01-02)" ] || { echo "written anew without need"; exit 1; }

# A folder inside the repository of another project.
mkdir -p clone/inner/host
"$cmake" -DGIT="$git" -DSOURCE="$folder/clone/inner" -DOUTPUT="$folder/commit.h" -P "$script"
expect unknown
