#!/usr/bin/env bash
# The C++ lines in the README's section "In your program", and in the example of vtkIrradianceFilter's header, are
# lines of Examples/LitRoom, but for blanks. So a reader copies what is built and run as a test. Says which lines
# are not, and fails if there are any. The lines of the section "In Python" are run. (The lines of the Guide are
# compiled into Testing/FiltersIrradiance/TestGuide.cxx.)
#
#   check-readme.sh [PYTHON]      PYTHON imports vtkIrradiance (default: Debian's, from build/release); "none"
#                                 leaves its lines out
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."

# lines LANGUAGE SECTION: what README.md quotes in a language in a section; none is an error
lines()
{
  awk -v start="^\`\`\`$1" -v wanted="## $2" '
    /^## / { section = $0 } /^```/ { inside = $0 ~ start; next }
    inside && section == wanted { print; found = 1 } END { exit !found }' README.md && return
  echo "README.md quotes no $1 in a section \"$2\"" >&2
  exit 1
}

plain()
{
  sed -E 's/^ +//; s/ +/ /g' "$1"
}

quoted=$(lines cpp "In your program")
example=$(sed -n '/^ \* @code/,/^ \* @endcode/s/^ \* //p' Modules/FiltersIrradiance/vtkIrradianceFilter.h | grep -v '^@')
if missing=$(plain - <<<"$quoted"$'\n'"$example" | grep . | grep -vxFf <(plain Examples/LitRoom/LitRoom.cxx)); then
  printf 'README.md or vtkIrradianceFilter.h, but not LitRoom.cxx, says:\n%s\n' "$missing"
  exit 1
fi

python=${1:-/usr/bin/python3}
[[ $python != none ]] || exit 0
[[ ${PYTHONPATH:-} ]] || PYTHONPATH=$(echo "$PWD"/build/release/lib/python3*/*-packages)
export PYTHONPATH
quoted=$(lines python "In Python")
if ! output=$("$python" -c "$quoted" 2>&1); then
  printf 'The Python lines of README.md end with an error:\n%s\n' "$output"
  exit 1
fi
if ! grep -qE '^[1-9][0-9.]* W/m2' <<<"$output"; then
  printf 'The Python lines of README.md say:\n%s\n' "$output"
  exit 1
fi
