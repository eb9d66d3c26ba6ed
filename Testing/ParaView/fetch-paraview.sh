#!/usr/bin/env bash
# Fetches Debian's ParaView and what is needed to build a plugin for it, and unpacks them into a folder.
# Nothing is installed: python3-paraview and the python3-vtk9 that libvtk9-dev needs exclude each other.
#
#   fetch-paraview.sh FOLDER     the folder gets usr/bin/pvpython and so on; if it has them, nothing is done
#
# The status is 3 where this system has no such packages, and 1 where they could not be fetched.
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
  echo "Without ParaView: only Debian's is fetched; elsewhere, install ParaView 5.11 or newer and set ParaView_DIR" >&2
  exit 3
fi

read -r -a packages <<<"$(packages_of paraview)"
rm -rf "$folder"
mkdir -p "$folder/packages"
cd "$folder/packages"
log=../fetch.log

give_up()
{
  tail -n 20 "$log" >&2
  echo "fetch-paraview.sh: could not fetch ${packages[*]}" >&2
  exit 1
}

# ParaView, and the libraries that it needs and this system lacks
fetch()
{
  local report libraries
  report=$(missing_libraries_of paraview) || return 1
  read -r -d '' -a libraries <<<"$report" || true
  apt-get -q download "${packages[@]}" "${libraries[@]}"
}

# A system that has all else installed may have no package lists, or old ones.
if ! has_candidates "${packages[@]}" || ! fetch >"$log" 2>&1; then
  if can_install; then
    apt update >"$log" 2>&1 || give_up
  fi
  if ! has_candidates "${packages[@]}"; then
    echo "Without ParaView: this system's package lists do not have ${packages[*]}" >&2
    exit 3
  fi
  fetch >"$log" 2>&1 || give_up
fi
for package in *.deb; do
  dpkg -x "$package" ..
done
cd ..
rm -rf packages
# Half of libproxy has a folder of its own, which is known by its path in the system.
for library in usr/lib/*/libproxy/*.so; do
  [[ ! -e $library ]] || ln -s "libproxy/${library##*/}" "${library%/libproxy/*}"
done
# ParaView's CMake files ask for X.so; in Debian 13 the module is called X.cpython-313-x86_64-linux-gnu.so.
find usr/lib/python3 -name '*.cpython-*.so' | while read -r module; do
  ln -s "${module##*/}" "${module%.cpython-*}.so"
done
touch complete
