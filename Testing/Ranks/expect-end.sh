#!/usr/bin/env bash
# expect-end.sh WORDS COMMAND...: the command fails by itself within a minute and says WORDS, and none of the processes
# that it names in lines "pid NUMBER" is left.
set -uo pipefail

words=$1
shift
log=$(mktemp)
trap 'rm -f "$log"' EXIT
timeout 60 "$@" >"$log" 2>&1
status=$?
cat "$log"
echo "status $status"
if ((status == 0 || status == 124)); then
  echo "it has not failed by itself" >&2
  exit 1
fi
if ! grep -qF -- "$words" "$log"; then
  echo "it does not say \"$words\"" >&2
  exit 1
fi
# Somebody has yet to take notice of a process that has ended.
sed -n 's/.*pid \([0-9]*\)$/\1/p' "$log" | while read -r pid; do
  for ((tenths = 0; tenths < 100; ++tenths)); do
    kill -0 "$pid" 2>/dev/null || continue 2
    sleep 0.1
  done
  echo "process $pid is left" >&2
  exit 1
done
