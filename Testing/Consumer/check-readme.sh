#!/usr/bin/env bash
# The C++ lines in the README's section "In your program" are lines of Examples/LitRoom, but for blanks. So a
# reader copies what is built and run as a test. Says which lines are not, and fails if there are any.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."

plain()
{
  sed -E 's/^ +//; s/ +/ /g' "$1"
}

quoted=$(awk '/^## / { section = $0 } /^```/ { cpp = /^```cpp/; next } cpp && section == "## In your program"' README.md)
if [[ ! $quoted ]]; then
  echo "README.md quotes no C++ in a section \"In your program\""
  exit 1
fi
if missing=$(plain - <<<"$quoted" | grep . | grep -vxFf <(plain Examples/LitRoom/LitRoom.cxx)); then
  printf 'README.md, but not LitRoom.cxx, says:\n%s\n' "$missing"
  exit 1
fi
