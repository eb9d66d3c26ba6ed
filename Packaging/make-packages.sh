#!/usr/bin/env bash
# Makes the Debian packages of these sources for the system that it runs on: the library, its development files
# and the Python package, from build/packages; with a ParaView, the plugin too, from build/packages-paraview.
#
#   make-packages.sh [--engine BUILD_FOLDER] [--paraview FOLDER] [FOLDER]
#
#   FOLDER       gets the packages (build/packages/debian)
#   --engine     another build folder of these sources, already built, whose engine is taken
#   --paraview   an unpacked ParaView, as Testing/ParaView/fetch-paraview.sh makes it
set -euo pipefail

usage()
{
  sed -n "5,9s/^# \{0,3\}//p" "${BASH_SOURCE[0]}" >&2
  exit 2
}

engine=()
paraview=
while [[ ${1:-} == --* ]]; do
  (($# > 1)) || usage
  case $1 in
    --engine) engine=("-DVTKIRRADIANCE_ENGINE_DIR=$(realpath -e "$2")") ;;
    --paraview) paraview=$(realpath -e "$2") ;;
    *) usage ;;
  esac
  shift 2
done
(($# <= 1)) || usage

cd "$(dirname "${BASH_SOURCE[0]}")/.."
target=$(realpath -m "${1:-build/packages/debian}")
# shellcheck source=../Utilities/packages.sh
source Utilities/packages.sh
require_packages build package

# What a package holds may not depend on who makes it.
umask 022
export LC_ALL=C.UTF-8

# package TREE [OPTION...]: configures, builds and packs
package()
{
  local tree=$PWD/$1 log
  shift
  mkdir -p "$tree"
  log=$tree/log
  if ! {
    cmake -S . -B "$tree" -G Ninja -DCMAKE_BUILD_TYPE=Release -DCMAKE_UNITY_BUILD=ON -DCMAKE_INSTALL_PREFIX=/usr \
      -DBUILD_TESTING=OFF -DVTKIRRADIANCE_BUILD_EXAMPLES=OFF -DVTKIRRADIANCE_DEBIAN_PACKAGES=ON "${engine[@]}" "$@" &&
      cmake --build "$tree" --parallel "$(nproc)" &&
      (cd "$tree" && rm -f ./*.deb && cpack)
  } >"$log" 2>&1; then
    tail -n 40 "$log"
    echo "make-packages.sh: could not be made; the whole report: $log"
    exit 1
  fi
  mv "$tree"/*.deb "$target"
}

rm -rf "$target"
mkdir -p "$target"
# Debian's folders are searched without being told, so nothing says where the library is.
package build/packages -DVTKIRRADIANCE_WRAP_PYTHON=ON -DVTKIRRADIANCE_PYTHON_DIR=lib/python3/dist-packages \
  -DCMAKE_SKIP_INSTALL_RPATH=ON
if [[ $paraview ]]; then
  package build/packages-paraview -DVTKIRRADIANCE_BUILD_PARAVIEW_PLUGIN=ON \
    -DParaView_DIR="$(echo "$paraview"/usr/lib/*/cmake/paraview-*)"
fi
ls "$target"/*.deb
