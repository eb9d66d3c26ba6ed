#!/usr/bin/env bash
# An example from nothing: installs what is missing, builds in build/release, fetches the data and runs it.
#
#   run.sh [EXAMPLE] [ARGUMENT...]
#
# EXAMPLE is a folder here, MovingTeapot if there is none. The results go to the folder that this is called
# from. Arguments are passed on to the program (--help shows them).
set -euo pipefail

caller=$PWD
cd "$(dirname "${BASH_SOURCE[0]}")/.."
home=$PWD
# shellcheck source=Utilities/packages.sh
source Utilities/packages.sh

example=MovingTeapot
if [[ ${1:-} && $1 != */* && -e Examples/$1/CMakeLists.txt ]]; then
  example=$1
  shift
fi

require_packages build display
[[ -e Examples/$example/$example.cxx ]] || require_packages python

configure=(cmake --preset release -DVTKIRRADIANCE_BUILD_EXAMPLES=ON)
# A tree that is there already keeps its tests.
[[ -e build/release/CMakeCache.txt ]] || configure+=(-DBUILD_TESTING=OFF)
echo "Building in build/release ..."
if ! report=$("${configure[@]}" 2>&1); then
  echo "$report"
  exit 1
fi
cmake --build --preset release --parallel "$(nproc)" --target "$example"

case $example in
  MovingTeapot | CuringOven | InteractiveRoom) fetch_data || echo "The data could not be fetched; the program goes on with what is there." ;;
esac

cd "$caller" # file names among the arguments are the caller's
# What waits for the user's mouse and keys needs the user's own display; what plays or measures does not.
if [[ $example == InteractiveRoom && " $*" != *" --events"* && " $*" != *" --frames"* ]]; then
  exec "$home/build/release/bin/$example" "$@"
fi
exec "$home/Utilities/run-under-xvfb.sh" "$home/build/release/bin/$example" "$@"
