#!/usr/bin/env bash
# What all examples print for --help: their name and purpose, options with what they take and their defaults, and in
# the last line where the results go.
#
#   check-help.sh PROGRAM...
#
# PYTHON runs those that end in .py; default python3.
set -euo pipefail

failures=0
for program in "$@"; do
  name=$(basename "$program" .py)
  run=("$program")
  [[ $program != *.py ]] || run=("${PYTHON:-python3}" "$program")
  help=$("${run[@]}" --help) || { echo "$name --help ends with an error"; failures=1; continue; }
  grep -qE "^$name: .+\.( It has no options\.)?$" <(head -n 1 <<<"$help") || { echo "$name: no purpose"; failures=1; }
  tail -n 1 <<<"$help" | grep -qE "^Results: \./$name-output: .+" || { echo "$name: no results"; failures=1; }
  # Two blanks before an option and a default behind it.
  if grep -E '^ *--' <<<"$help" | grep -vE '^  --[a-z-]+ .*\([^()]+\)$'; then
    echo "$name: these options have another form"
    failures=1
  fi
  if ! grep -q 'It has no options' <<<"$help" && (($(grep -cE '^  --(output|help) ' <<<"$help") != 2)); then
    echo "$name: --output or --help is missing"
    failures=1
  fi
  if ls -d "$name-output" 2>/dev/null; then
    echo "$name --help makes a folder"
    failures=1
  fi
done
exit "$failures"
