#!/usr/bin/env bash
# Makes the Debian package of the plugin from its build tree, looks at it, unpacks it and lets ParaView load the
# plugin from there.
#
#   test-plugin-package.sh BUILD_FOLDER PVPYTHON SCRATCH_FOLDER
set -euo pipefail

(($# == 3)) || { echo "usage: test-plugin-package.sh BUILD_FOLDER PVPYTHON SCRATCH_FOLDER" >&2; exit 2; }
build=$(realpath -e "$1")
pvpython=$2
scratch=$(realpath -m "$3")
home=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)
# shellcheck source=check-package.sh
source "$home/Testing/Packaging/check-package.sh"

rm -rf "$scratch"
mkdir -p "$scratch/unpacked"
umask 022
(cd "$build" && cpack -B "$scratch/packages") >"$scratch/log" 2>&1 || { tail -n 40 "$scratch/log"; exit 1; }

check_package '$ORIGIN:$ORIGIN/../../../' paraview-vtkirradiance 'paraview \(>= 5\.[0-9]+\)' 'paraview \(<< 5\.[0-9]+\)' 'libc6 '
plugin=$(echo "$scratch"/unpacked/paraview-vtkirradiance/usr/lib/*/paraview-*/plugins/IrradiancePlugin/IrradiancePlugin.so)
"$pvpython" "$home/Testing/Packaging/plugin_smoke.py" "$plugin" || fail "ParaView cannot use the plugin"

if ((failures)); then
  echo "$failures failures"
  exit 1
fi
