#!/usr/bin/env bash
# The main example from nothing: installs what is missing, builds in build/release, fetches the data and
# runs the moving teapot. Arguments are passed on to the program (--help shows them).
set -euo pipefail

cd "$(dirname "${BASH_SOURCE[0]}")/.."
# shellcheck source=Utilities/packages.sh
source Utilities/packages.sh

require_packages build display

configure=(cmake --preset release -DVTKIRRADIANCE_BUILD_EXAMPLES=ON)
# A tree that is there already keeps its tests.
[[ -e build/release/CMakeCache.txt ]] || configure+=(-DBUILD_TESTING=OFF)
echo "Building in build/release ..."
if ! report=$("${configure[@]}" 2>&1); then
  echo "$report"
  exit 1
fi
cmake --build --preset release --parallel "$(nproc)" --target MovingTeapot

Data/fetch.sh

results=build/release/MovingTeapot
mkdir -p "$results"
program=$PWD/build/release/bin/MovingTeapot
(cd "$results" && ../../../Utilities/run-under-xvfb.sh "$program" "$@")
echo "The results are in $PWD/$results"
