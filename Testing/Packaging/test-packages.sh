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
version=$(sed -nE 's/^project\(vtkIrradiance VERSION ([0-9.]+).*/\1/p' "$home/CMakeLists.txt")
failures=0

fail()
{
  echo "$1"
  failures=$((failures + 1))
}

# expect_field PACKAGE_FILE FIELD PATTERN
expect_field()
{
  local value
  value=$(dpkg-deb -f "$1" "$2")
  grep -qE -- "$3" <<<"$value" || fail "$(basename "$1"): $2 is \"$value\", not /$3/"
}

# check_package NAME DEPENDENCY...: its own words, and files as Debian wants them
check_package()
{
  local name=$1 file dependency
  shift
  file=$(echo "$scratch/packages/${name}"_*.deb)
  if [[ ! -e $file ]]; then
    fail "there is no package $name"
    return
  fi
  expect_field "$file" Package "^$name$"
  expect_field "$file" Version "^$version$"
  expect_field "$file" Architecture "^$(dpkg --print-architecture)$"
  expect_field "$file" Maintainer '^vtkIrradiance contributors'
  expect_field "$file" Description 'W/m2'
  for dependency in "$@"; do
    expect_field "$file" Depends "(^|, )$dependency"
  done
  if dpkg-deb -c "$file" | grep -vE '^(-rw-r--r--|drwxr-xr-x|lrwxrwxrwx) root/root '; then
    fail "$name: these files are not root's, or others may write them"
  fi
  local unpacked=$scratch/unpacked/$name
  dpkg-deb -x "$file" "$unpacked"
  (cd "$unpacked" && dpkg-deb --ctrl-tarfile "$file" | tar -xO ./md5sums | md5sum --quiet -c) || fail "$name: wrong md5sums"
  for document in copyright changelog.gz; do
    [[ -s $unpacked/usr/share/doc/$name/$document ]] || fail "$name has no $document"
  done
  grep -q 'GPL-3' "$unpacked/usr/share/doc/$name/copyright" || fail "$name: its licence is not said"
  if grep -rlF -e "$home/" "$unpacked"; then
    fail "$name: these files point back to the sources"
  fi
  find "$unpacked" -name '*.so*' -type f | while read -r library; do
    ! readelf -d "$library" | grep -E 'R(UN)?PATH' || exit 1
    ! readelf -S "$library" | grep -F .symtab || exit 1
  done || fail "$name: a library has a search path or is not stripped"
}

rm -rf "$scratch"
mkdir -p "$scratch/unpacked"
bash "$home/Packaging/make-packages.sh" --engine "$build" "$scratch/packages"

check_package libvtkfiltersirradiance1 'libvtk9\.1 ' 'libc6 ' 'libstdc\+\+6 '
check_package libvtkirradiance-dev "libvtkfiltersirradiance1 \(= $version\)" 'libvtk9-dev(,|$)'
check_package python3-vtkirradiance "libvtkfiltersirradiance1 \(= $version\)" 'python3-vtk9 ' 'python3 \(<< '
expect_field "$scratch"/packages/python3-vtkirradiance_*.deb Recommends '^python3-numpy$'
dpkg-deb --ctrl-tarfile "$scratch"/packages/python3-vtkirradiance_*.deb | tar -xO ./prerm | grep -q py3clean ||
  fail "what Python compiles would outlive its package"

# A library's package is called as its soname, and its programs are told so.
library=$(echo "$scratch"/unpacked/libvtkfiltersirradiance1/usr/lib/*/libvtkFiltersIrradiance.so.1)
soname=$(readelf -d "$library" | sed -nE 's/.*SONAME.*\[(.*)\]/\1/p')
[[ $soname == libvtkFiltersIrradiance.so.1 ]] || fail "the library's soname is $soname"
dpkg-deb --ctrl-tarfile "$scratch"/packages/libvtkfiltersirradiance1_*.deb | tar -xO ./shlibs |
  grep -qE '^libvtkFiltersIrradiance 1 libvtkfiltersirradiance1' || fail "shlibs does not name the library"

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
  [[ -s irradiance.vtm && -s irradiance.png ]]
) >"$scratch/consumer.log" 2>&1 || fail "LitRoom is not built or does not run: $(tail -n 30 "$scratch/consumer.log")"

if ((failures)); then
  echo "$failures failures"
  exit 1
fi
(cd "$scratch/packages" && ls -- *.deb)
