#!/usr/bin/env bash
# Doxygen makes the site without a warning; every public class is on it, and no link leads nowhere. In a copy
# of a header each of some mistakes is found.
#
#   check-site.sh DOXYFILE SCRATCH_FOLDER
set -euo pipefail

doxyfile=${1:?usage: check-site.sh DOXYFILE SCRATCH_FOLDER}
scratch=${2:?usage: check-site.sh DOXYFILE SCRATCH_FOLDER}
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
headers=$here/../../Modules/FiltersIrradiance
site=$scratch/html
failures=0

fail()
{
  echo "$1"
  failures=$((failures + 1))
}

# run_doxygen [LINE...]: with these lines added to the file
run_doxygen()
{
  {
    cat "$doxyfile"
    printf '%s\n' "OUTPUT_DIRECTORY = \"$scratch\"" "$@"
  } | doxygen - 2>&1
}

rm -rf "$scratch"
mkdir -p "$scratch/wrong"
run_doxygen || fail "Doxygen warns"
for header in "$headers"/vtk*.h; do
  class=$(basename "$header" .h)
  [[ -s $site/class$class.html ]] || fail "$class is not on the site"
done

# local_links PAGE: the files that it wants
local_links()
{
  grep -oE '(href|src)="[^"#]+' "$1" | sed -E 's/^[a-z]+="//' | grep -vE '^[a-z]+:' | sort -u || true
}
for page in "$site"/*.html; do
  while read -r link; do
    [[ -e $site/$link ]] || fail "$(basename "$page"): nothing is at $link"
  done < <(local_links "$page")
done

# find_mistake LINE: it must be found in the comment of a class
find_mistake()
{
  sed "0,/^ \* @class/s//$1\n&/" "$headers/vtkIrradianceFilter.h" >"$scratch/wrong/vtkIrradianceFilter.h"
  if run_doxygen "INPUT = \"$scratch/wrong\"" "USE_MDFILE_AS_MAINPAGE =" >/dev/null; then
    fail "not found: $1"
  fi
}
find_mistake ' * @ref NoSuchThing'
find_mistake ' * @copydoc NoSuchClass'
find_mistake ' * @nosuchcommand'

if ((failures)); then
  echo "$failures failures"
  exit 1
fi
echo "$(find "$site" -name '*.html' | wc -l) pages"
