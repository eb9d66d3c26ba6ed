#!/usr/bin/env bash
# Runs clang-tidy with .clang-tidy over the engine's sources (and, through them, its headers).
#
#   tidy.sh BUILD_DIR [CLANG_TIDY]      BUILD_DIR holds compile_commands.json
#
# Some two dozen sources are read as if they were one: most of the time goes to the headers of Eigen and C++, for each
# source anew. Sources for one instruction set are read with their like. Where names clash, the group is read in halves,
# in the end each source alone.
#
# The status is 77 for another version of clang-tidy than that of the rules: later ones have more checks by these names.
#
# It leaves out EnclosingEllipsoid.cpp and PolygonTriangulation.cpp: reading CGAL takes longer than all
# the rest together.
set -euo pipefail

build=$(cd "${1:?usage: tidy.sh BUILD_DIR [CLANG_TIDY]}" && pwd)
clang_tidy=${2:-clang-tidy}
if ! command -v "$clang_tidy" >/dev/null; then
  echo "tidy.sh: no $clang_tidy"
  exit 1
fi
version=$("$clang_tidy" --version | sed -nE 's/.* version ([0-9]+)\..*/\1/p')
if [[ $version != 14 ]]; then
  echo "Skipped: Tidy has the checks of clang-tidy 14, and there is only version $version"
  exit 77
fi
if [[ ! -e $build/compile_commands.json ]]; then
  echo "tidy.sh: no compile_commands.json in $build"
  exit 1
fi
cd "$(dirname "${BASH_SOURCE[0]}")/../.."

mapfile -t files < <(find Modules/RayCasting Modules/PhotonWalks -name '*.cpp' \
  ! -name EnclosingEllipsoid.cpp ! -name PolygonTriangulation.cpp | sort)
if ((${#files[@]} == 0)); then
  echo "tidy.sh: no source file found"
  exit 1
fi
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT

# options SOURCE: those of the compiler that say what the sources of its module mean, not those for optimising. In a
# unity build only some sources have commands of their own.
options()
{
  local module
  module=$(cut -d / -f 1-2 <<<"$1")
  grep -F " -c $PWD/$module/" "$build/compile_commands.json" | grep -vF CGAL | head -n 1 |
    grep -oE -- '-isystem [^ ]+|-I[^ ]+|-D[^ ]+|-std=[^ ]+' | tr ' ' '\n'
}

# tidy SOURCE...: looks at the sources as if they were one, or, where that does not compile, at each half
tidy()
{
  local one=$scratch/$BASHPID-$RANDOM.cpp output status=0 arguments
  printf "#include \"$PWD/%s\" // NOLINT(bugprone-suspicious-include)\n" "$@" >"$one"
  mapfile -t arguments < <(options "$1")
  output=$("$clang_tidy" --quiet --config-file=.clang-tidy "$one" -- "${arguments[@]}" 2>&1) || status=$?
  if ((status == 0)); then
    return 0
  fi
  if (($# > 1)) && grep -q 'clang-diagnostic-error' <<<"$output"; then
    status=0
    tidy "${@:1:$#/2}" || status=1
    tidy "${@:$#/2+1}" || status=1
    return "$status"
  fi
  echo "$output"
  return 1
}

# group SOURCE: its module, and the instruction set that it repeats other loops for
group()
{
  local set=${1##*/}
  set=$(grep -oE '(Plain|Avx2|Avx512)\.cpp$' <<<"$set" || true)
  echo "$(cut -d / -f 1-2 <<<"$1") $set"
}

export build clang_tidy scratch
export -f options tidy
# A line for each group of sources, of so many at most.
declare -A groups
for file in "${files[@]}"; do
  groups[$(group "$file")]+="$file "
done
printf '%s\n' "${groups[@]}" | xargs -d '\n' -n 1 bash -c 'xargs -n 24 <<<"$0"' | awk '{ print NF, $0 }' |
  sort -rn | cut -d ' ' -f 2- |
  xargs -P "$(nproc)" -d '\n' -n 1 bash -c 'IFS=" " read -ra sources <<<"$1"; tidy "${sources[@]}"' tidy
echo "${#files[@]} sources"
