#!/usr/bin/env bash
# Runs clang-tidy with .clang-tidy over the engine's sources (and, through them, its headers).
#
#   tidy.sh BUILD_DIR [CLANG_TIDY]      BUILD_DIR holds compile_commands.json
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
printf '%s\0' "${files[@]}" | xargs -0 -n 1 -P "$(nproc)" "$clang_tidy" -p "$build" --quiet
echo "${#files[@]} sources"
