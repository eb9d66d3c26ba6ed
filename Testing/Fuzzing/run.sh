#!/usr/bin/env bash
# Fuzzes every target from its corpus, all at once; the status is 0 if nothing was found.
#
#   run.sh [SECONDS]       for each target (default 30)
#
# Builds them in build/sanitize. What the fuzzers learn stays in build/sanitize/Corpus, what they find goes to
# build/sanitize/found. A finding that has been fixed moves to Corpus/ here, under a name that says what it was.
set -euo pipefail

seconds=${1:-30}
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
cd "$here/../.."

cmake --preset sanitize >/dev/null
cmake --build --preset sanitize --target Fuzzers --parallel "$(nproc)"

# The leak check looks itself up in /proc, which is missing or another system's in some chroots.
[[ /proc/self/status -ef /proc/$BASHPID/status ]] || export ASAN_OPTIONS=detect_leaks=0

# fuzz CORPUS: says how many inputs its target ran, or what it found
fuzz()
{
  local name=${1##*/}
  local learned=build/sanitize/Corpus/$name found=build/sanitize/found/$name- log=build/sanitize/$name.log status=0
  mkdir -p "$learned" "${found%/*}"
  "build/sanitize/bin/Fuzz$name" "$learned" "$1" -max_total_time="$seconds" -timeout=60 \
    -max_len=3000 -len_control=0 -print_final_stats=1 -artifact_prefix="$found" >"$log" 2>&1 || status=1
  if ((status == 0)); then
    echo "$name: $(grep executed_units "$log")"
  else
    tail -n 60 "$log"
  fi
  return "$status"
}

targets=()
for corpus in "$here"/Corpus/*; do
  fuzz "$corpus" &
  targets+=($!)
done
status=0
for target in "${targets[@]}"; do
  wait "$target" || status=1
done
exit "$status"
