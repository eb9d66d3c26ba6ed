#!/usr/bin/env bash
# Gets the mesh of a head for the examples and benchmarks into Data/downloaded/ (see README.md). Needs no root,
# changes nothing outside that folder, prints nothing if the mesh is there.
set -euo pipefail

here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
head=$here/downloaded/mannequin-devil.off
sum=9424b7132b58766984051fb7757543e88972f91fe7e9565d4e5b715b204f74a5
archive=usr/share/doc/libcgal-dev/data.tar.gz # in the Debian package libcgal-demo

fail() {
  echo "Data/fetch.sh: $*" >&2
  exit 1
}

matches() {
  [[ -f $1 ]] && echo "$sum  $1" | sha256sum --check --status
}

matches "$head" && exit 0

scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT

unpack() { # archive
  tar --extract --gzip --file "$1" --directory "$scratch" data/meshes/mannequin-devil.off 2>/dev/null &&
    matches "$scratch/data/meshes/mannequin-devil.off"
}

download() {
  if ! command -v apt-get >/dev/null || ! command -v dpkg-deb >/dev/null; then
    fail "the head comes from the Debian package libcgal-demo, and this is no Debian;" \
      "take data/meshes/mannequin-devil.off from there to $head"
  fi
  echo "Fetching the head from the Debian package libcgal-demo ..."
  chmod 777 "$scratch" # apt, started by root, switches to its own user
  cd "$scratch"
  if ! apt-get --quiet=2 download libcgal-demo >log 2>&1; then
    cat log >&2
    fail "libcgal-demo cannot be downloaded (is 'apt-get update' due?)"
  fi
  dpkg-deb --extract libcgal-demo_*.deb package
  if ! unpack "package/$archive"; then
    fail "libcgal-demo holds another mannequin-devil.off than that of Debian 12 (sha256 $sum)"
  fi
}

if [[ ! -r /$archive ]] || ! unpack "/$archive"; then
  download
fi

mkdir -p "$here/downloaded"
mv "$scratch/data/meshes/mannequin-devil.off" "$head.part"
mv "$head.part" "$head"
