#!/usr/bin/env bash
# Fetches Debian's ParaView and what is needed to build a plugin for it, and unpacks them into a folder.
# Nothing is installed: python3-paraview and the python3-vtk9 that libvtk9-dev needs exclude each other.
#
#   fetch-paraview.sh FOLDER     the folder gets usr/bin/pvpython and so on; if it has them, nothing is done
set -euo pipefail

cd "$(dirname "${BASH_SOURCE[0]}")/../.."
# shellcheck source=../../Utilities/packages.sh
source Utilities/packages.sh

if (($# != 1)); then
  echo "usage: fetch-paraview.sh FOLDER" >&2
  exit 2
fi
folder=$1
if [[ -e $folder/complete ]]; then
  exit 0
fi
if [[ $has_dpkg == no ]]; then
  echo "fetch-paraview.sh: it takes Debian's packages; elsewhere, install ParaView 5.11 and set ParaView_DIR" >&2
  exit 2
fi

read -r -a packages <<<"$(packages_of paraview)"
rm -rf "$folder"
mkdir -p "$folder/packages"
cd "$folder/packages"
log=../fetch.log
# A system that has all else installed may have no package lists.
if ! apt-get -q download "${packages[@]}" >"$log" 2>&1; then
  if ! { can_install && apt update && apt-get -q download "${packages[@]}"; } >"$log" 2>&1; then
    tail -n 20 "$log" >&2
    echo "fetch-paraview.sh: could not fetch ${packages[*]}" >&2
    exit 1
  fi
fi
for package in *.deb; do
  dpkg -x "$package" ..
done
cd ..
rm -rf packages
touch complete
