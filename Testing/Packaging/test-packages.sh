#!/usr/bin/env bash
# Makes the Debian packages and looks at them: what they say of themselves, what they hold, whether this system
# could install them. Then unpacks them into an empty folder, builds Examples/LitRoom with what is there and
# runs it, and the Python lines of the README. Nothing is installed.
#
#   test-packages.sh BUILD_FOLDER SCRATCH_FOLDER     BUILD_FOLDER holds the engine, built
set -euo pipefail

build=$(realpath -e "${1:?usage: test-packages.sh BUILD_FOLDER SCRATCH_FOLDER}")
scratch=$(realpath -m "${2:?usage: test-packages.sh BUILD_FOLDER SCRATCH_FOLDER}")
home=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)
# shellcheck source=check-package.sh
source "$home/Testing/Packaging/check-package.sh"

rm -rf "$scratch"
mkdir -p "$scratch/unpacked"
bash "$home/Packaging/make-packages.sh" --engine "$build" "$scratch/packages"

check_package "" libvtkfiltersirradiance1 'libvtk9\.[0-9]+(t64)? ' 'libc6 ' 'libstdc\+\+6 '
check_package "" libvtkirradiance-dev "libvtkfiltersirradiance1 \(= $version\)" 'libvtk9-dev(,|$)'
check_package "" python3-vtkirradiance "libvtkfiltersirradiance1 \(= $version\)" 'python3-vtk9 ' 'python3 \(<< ' \
  'python3-numpy(,|$)'
dpkg-deb --ctrl-tarfile "$scratch"/packages/python3-vtkirradiance_*.deb | tar -xO ./prerm | grep -q py3clean ||
  fail "what Python compiles would outlive its package"

# A library's package is called as its soname, and its programs are told so.
library=$(echo "$scratch"/unpacked/libvtkfiltersirradiance1/usr/lib/*/libvtkFiltersIrradiance.so.1)
soname=$(readelf -d "$library" | sed -nE 's/.*SONAME.*\[(.*)\]/\1/p')
[[ $soname == libvtkFiltersIrradiance.so.1 ]] || fail "the library's soname is $soname"
dpkg-deb --ctrl-tarfile "$scratch"/packages/libvtkfiltersirradiance1_*.deb | tar -xO ./shlibs |
  grep -qE '^libvtkFiltersIrradiance 1 libvtkfiltersirradiance1' || fail "shlibs does not name the library"

dpkg-deb --ctrl-tarfile "$scratch"/packages/libvtkfiltersirradiance1_*.deb | tar -xO ./triggers |
  grep -qx 'activate-noawait ldconfig' || fail "the cache of libraries is not brought up to date"
# Debian's own checks, where they are installed (Testing/Packaging/chroot-smoke.sh always has them).
if command -v lintian >/dev/null && ! lintian --allow-root --fail-on error "$scratch"/packages/*.deb; then
  fail "lintian finds errors"
fi

# As if installed: all there is to it, and nothing goes.
if ! plan=$(apt-get -s install --no-install-recommends "$scratch"/packages/*.deb 2>&1); then
  fail "apt would not install them: $plan"
elif grep '^Remv' <<<"$plan"; then
  fail "apt would remove these"
fi

# Used from where they are unpacked.
prefix=$scratch/prefix
for package in "$scratch"/packages/*.deb; do
  dpkg-deb -x "$package" "$prefix"
done
LD_LIBRARY_PATH=$(dirname "$(echo "$prefix"/usr/lib/*/libvtkFiltersIrradiance.so.1)")
export LD_LIBRARY_PATH
PYTHONPATH=$prefix/usr/lib/python3/dist-packages bash "$home/Testing/Consumer/check-readme.sh" /usr/bin/python3 ||
  fail "the Python lines of the README do not run"
(
  mkdir "$scratch/consumer"
  cd "$scratch/consumer"
  cmake -G Ninja -DCMAKE_BUILD_TYPE=Release -DCMAKE_PREFIX_PATH="$prefix/usr" "$home/Examples/LitRoom"
  cmake --build .
  ./LitRoom
  [[ -s LitRoom-output/irradiance.vtm && -s LitRoom-output/irradiance.png ]]
) >"$scratch/consumer.log" 2>&1 || fail "LitRoom is not built or does not run: $(tail -n 30 "$scratch/consumer.log")"

if ((failures)); then
  echo "$failures failures"
  exit 1
fi
(cd "$scratch/packages" && ls -- *.deb)
