#!/usr/bin/env bash
# The main example from nothing: installs what is missing, builds in build/release, fetches the data and
# runs the moving teapot. The results go to MovingTeapot-output in the folder it is called from. Arguments
# are passed on to the program (--help shows them).
set -euo pipefail

caller=$PWD
cd "$(dirname "${BASH_SOURCE[0]}")/.."
home=$PWD
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

fetch_data || echo "The scene goes without it."

cd "$caller" # file names among the arguments are the caller's
exec "$home/Utilities/run-under-xvfb.sh" "$home/build/release/bin/MovingTeapot" \
  --output "$caller/MovingTeapot-output" "$@"
