#!/usr/bin/env bash
# Gets meshes of CGAL for the examples and benchmarks into Data/downloaded/ (see README.md): a head and five parts of
# machines. Needs no root, changes nothing outside that folder, prints nothing if they are there.
set -euo pipefail

here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
target=$here/downloaded
archive=usr/share/doc/libcgal-dev/data.tar.gz # in the Debian package libcgal-demo
sums="9424b7132b58766984051fb7757543e88972f91fe7e9565d4e5b715b204f74a5  mannequin-devil.off
8db85ca5041eef6d952e48f0553a25fddb42f237b80a37b7aff096b8df3aca32  rotor.off
191a8cdfa3807e09d7dffb4bdc94dabe1231b4594001ca134100a9a32e996599  pinion.off
5009b3400b73ef199b6ac9a24a27f4f76e1aa7b71d957a50cb6dcbe09868ff3b  anchor.off
a412da1a4b90a1d018d44e0b06307ee692da4afd255975d2a93945e091098649  joint.off
01fc9017b44a803b1130f8f5d51f0c7d8bbfa27b908f5166c498fe21e57f2284  couplingdown.off"
mapfile -t meshes < <(cut -d ' ' -f 3 <<<"$sums")

fail() {
  echo "Data/fetch.sh: $*" >&2
  exit 1
}

are_right() { # folder
  [[ -d $1 ]] && (cd "$1" && sha256sum --check --status <<<"$sums" 2>/dev/null)
}

are_right "$target" && exit 0

scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT

unpack() { # archive
  tar --extract --gzip --file "$1" --directory "$scratch" "${meshes[@]/#/data/meshes/}" 2>/dev/null &&
    are_right "$scratch/data/meshes"
}

download() {
  if ! command -v apt-get >/dev/null || ! command -v dpkg-deb >/dev/null; then
    fail "the meshes come from the Debian package libcgal-demo, and this is no Debian;" \
      "take ${meshes[*]} from its data/meshes/ to $target"
  fi
  echo "Fetching meshes from the Debian package libcgal-demo ..."
  chmod 777 "$scratch" # apt, started by root, switches to its own user
  cd "$scratch"
  if ! apt-get --quiet=2 download libcgal-demo >log 2>&1; then
    cat log >&2
    fail "libcgal-demo cannot be downloaded (is 'apt-get update' due?)"
  fi
  dpkg-deb --extract libcgal-demo_*.deb package
  if ! unpack "package/$archive"; then
    fail "libcgal-demo holds other meshes than that of Debian 12 (their sha256 are in this script)"
  fi
}

if [[ ! -r /$archive ]] || ! unpack "/$archive"; then
  download
fi

mkdir -p "$target"
for mesh in "${meshes[@]}"; do
  mv "$scratch/data/meshes/$mesh" "$target/$mesh.part"
  mv "$target/$mesh.part" "$target/$mesh"
done
