# shellcheck shell=bash
# For bash to source: what every Debian package has to fulfil. The caller sets `home` (the sources) and `scratch`
# (packages are in scratch/packages, and are unpacked to scratch/unpacked).
# shellcheck disable=SC2154

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

# check_package SEARCH_PATH NAME DEPENDENCY...: its own words, and files as Debian wants them. SEARCH_PATH is the only
# one that its libraries may have.
check_package()
{
  local search_path=$1 name=$2 file dependency
  shift 2
  file=$(echo "$scratch/packages/${name}"_*.deb)
  if [[ ! -e $file ]]; then
    fail "there is no package $name"
    return
  fi
  expect_field "$file" Package "^$name$"
  expect_field "$file" Version "^$version$"
  expect_field "$file" Architecture "^$(dpkg --print-architecture)$"
  expect_field "$file" Maintainer '^vtkIrradiance contributors <[^@ ]+@[^@ ]+>$'
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
  for document in copyright changelog.gz CHANGELOG.md.gz; do
    [[ -s $unpacked/usr/share/doc/$name/$document ]] || fail "$name has no $document"
  done
  # As dpkg-parsechangelog reads it.
  [[ $(zcat "$unpacked/usr/share/doc/$name/changelog.gz" | dpkg-parsechangelog -l - -S Version) == "$version" ]] ||
    fail "$name: changelog.gz is not Debian's, or of another version"
  grep -q 'GPL-3' "$unpacked/usr/share/doc/$name/copyright" || fail "$name: its licence is not said"
  # Not the folder alone: whatever it is called may well stand in a package, as vtkIrradiance does.
  if grep -rlF -e "$home/Modules" -e "$home/CMake" -e "$home/Packaging" -e "$home/build" "$unpacked"; then
    fail "$name: these files point back to the sources"
  fi
  find "$unpacked" -name '*.so*' -type f | while read -r library; do
    ! readelf -d "$library" | grep -E 'R(UN)?PATH' | grep -vF "[$search_path]" || exit 1
    ! readelf -S "$library" | grep -F .symtab || exit 1
  done || fail "$name: a library has a search path or is not stripped"
}
