#!/usr/bin/env bash
# Installs the Debian packages in empty Debians that never saw the sources, and uses them there: a consumer is
# built with find_package and run, the Python lines of the README are run, ParaView loads the plugin. Needs
# root, debootstrap, 4 GB below SCRATCH_FOLDER and half a gigabyte of downloads; takes some minutes.
#
#   chroot-smoke.sh PACKAGES_FOLDER [SCRATCH_FOLDER]
#
# ParaView is tried if there is a package of the plugin, in a Debian of its own: python3-paraview and
# python3-vtk9 exclude each other.
set -euo pipefail

# No mount outlives this script, however it ends.
if [[ ${1:-} != --inside ]]; then
  exec unshare --mount --pid --fork --kill-child bash "$0" --inside "$@"
fi
shift
packages=$(realpath -e "${1:?usage: chroot-smoke.sh PACKAGES_FOLDER [SCRATCH_FOLDER]}")
scratch=$(realpath -m "${2:-$(mktemp -d)}")
home=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)

clean_up()
{
  umount "$scratch"/{vtk,paraview}/{proc,dev/shm} 2>/dev/null || true
  rm -rf --one-file-system "$scratch/bare" "$scratch/vtk" "$scratch/paraview"
}
trap clean_up EXIT
clean_up
mkdir -p "$scratch"

# From where this system has its own packages.
make_bare_debian()
{
  local codename mirror
  codename=$(sed -n 's/^VERSION_CODENAME=//p' /etc/os-release)
  mirror=$(apt-get indextargets --format '$(REPO_URI) $(CODENAME) $(SUITE)' |
    awk -v codename="$codename" '$2 == codename || $3 == codename { print $1; exit }')
  debootstrap --variant=minbase "$codename" "$scratch/bare" "${mirror:-http://deb.debian.org/debian}"
  rm -rf "$scratch"/bare/etc/apt/{sources.list,sources.list.d,apt.conf.d,auth.conf.d}
  cp -a /etc/apt/. "$scratch/bare/etc/apt/"
  cp /etc/resolv.conf /etc/hosts "$scratch/bare/etc/"
}

# enter NAME: a copy of the bare Debian, with what is handed to it in /smoke
enter()
{
  cp -a "$scratch/bare" "$scratch/$1"
  mkdir "$scratch/$1/smoke"
  cp "$home/Utilities/run-under-xvfb.sh" "$scratch/$1/smoke"
  cp -r "${@:2}" "$scratch/$1/smoke"
  mount -t proc proc "$scratch/$1/proc"
  mount -t tmpfs tmpfs "$scratch/$1/dev/shm"
}

# inside NAME: runs the standard input there
inside()
{
  env -i PATH=/usr/sbin:/usr/bin:/sbin:/bin LC_ALL=C.UTF-8 HOME=/root DEBIAN_FRONTEND=noninteractive \
    chroot "$scratch/$1" bash -euo pipefail -s
}

echo "== a bare Debian"
make_bare_debian >"$scratch/debootstrap.log" || { tail "$scratch/debootstrap.log"; exit 1; }

echo "== library, development files and Python"
enter vtk "$packages"/libvtk*.deb "$packages"/python3-*.deb "$home"/Examples/LitRoom "$home/Examples/ParaViewState.py"
awk '/^## / { section = $0 } /^```/ { inside = /^```python/; next } inside && section == "## In Python"' \
  "$home/README.md" >"$scratch/vtk/smoke/readme.py"
inside vtk <<'END'
cd /smoke
apt-get -q update >log
apt-get -q install -y --no-install-recommends ./*.deb g++ cmake ninja-build xvfb lintian >>log 2>&1 ||
  { tail -n 30 log; exit 1; }
lintian --allow-root --fail-on error ./*.deb
ldconfig -p | grep libvtkFiltersIrradiance.so.1
python3 readme.py
cmake -G Ninja -S LitRoom -B build -DCMAKE_BUILD_TYPE=Release >>log
cmake --build build >>log
bash run-under-xvfb.sh build/LitRoom
ls -l LitRoom-output/{irradiance.vtm,irradiance.png,ParaViewState.py}
build/LitRoom 2>&1 | grep 'No picture: DISPLAY is not set'
apt-get -q purge -y libvtkfiltersirradiance1 >>log 2>&1
! find /usr -iname '*vtkirradiance*' -o -iname '*FiltersIrradiance*' | grep .
END

plugin=$(find "$packages" -name 'paraview-*.deb')
if [[ ! $plugin ]]; then
  echo "no package of the plugin; ParaView is not tried"
  exit 0
fi
echo "== ParaView"
enter paraview "$plugin" "$home/Testing/Packaging/plugin_smoke.py"
inside paraview <<'END'
cd /smoke
apt-get -q update >log
apt-get -q install -y --no-install-recommends ./*.deb python3-paraview xvfb lintian >>log 2>&1 ||
  { tail -n 30 log; exit 1; }
lintian --allow-root --fail-on error ./*.deb
bash run-under-xvfb.sh pvpython plugin_smoke.py \
  /usr/lib/*/paraview-*/plugins/IrradiancePlugin/IrradiancePlugin.so
END
