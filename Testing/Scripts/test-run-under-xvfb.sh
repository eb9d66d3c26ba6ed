#!/usr/bin/env bash
# However run-under-xvfb.sh ends, it must leave no process and no file behind, and pass the command's status
# and streams through.
# shellcheck disable=SC2016 # what stands in single quotes is for the inner shell
set -euo pipefail

runner=$(cd "$(dirname "${BASH_SOURCE[0]}")/../../Utilities" && pwd)/run-under-xvfb.sh
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
mkdir "$scratch/tmp"
failures=0

# Every process that descends from here has this in its environment, even if its parents have ended.
mark=XVFB_TEST_MARK=$$.$RANDOM.$RANDOM

run=(env TMPDIR="$scratch/tmp" "$mark" "$runner")

# Process ids, one a line.
marked_processes()
{
  { grep -lzxF "$mark" /proc/[0-9]*/environ 2>/dev/null || true; } | cut -d / -f 3
}

# describe PROCESS...
describe()
{
  local process
  for process in "$@"; do
    tr '\0' ' ' <"/proc/$process/cmdline" 2>/dev/null || true
    echo
  done
}

complain()
{
  echo "$1"
  failures=$((failures + 1))
}

# wait_for CONDITION...: whether it holds within 20 s
wait_for()
{
  local i
  for ((i = 0; i < 200; ++i)); do
    ! "$@" || return 0
    sleep 0.1
  done
  return 1
}

none_left()
{
  [[ -z $(marked_processes) ]]
}

# expect_nothing_left CASE
expect_nothing_left()
{
  local left
  wait_for none_left && return 0
  mapfile -t left < <(marked_processes)
  complain "$1 leaves behind:"
  describe "${left[@]}"
  kill -KILL "${left[@]}" 2>/dev/null || true
}

expect_no_file_left()
{
  [[ -z $(ls -A "$scratch/tmp") ]] || complain "$1 leaves files behind: $(ls -A "$scratch/tmp")"
}

# start_and_signal SIGNAL: sends it to the runner while its command runs
start_and_signal()
{
  local runner_process
  rm -f "$scratch/started"
  "${run[@]}" bash -c 'touch "$0"; sleep 1000 & sleep 1000' "$scratch/started" &
  runner_process=$!
  if ! wait_for test -e "$scratch/started"; then
    complain "the command did not start"
  fi
  [[ -n $(marked_processes) ]] || complain "the processes are not seen: this test is blind"
  kill "-$1" "$runner_process"
  wait "$runner_process" 2>/dev/null || true
}

status=0
output=$(echo "through" | "${run[@]}" bash -c 'cat; [[ -n $DISPLAY ]] || echo "no display"; exit 7') || status=$?
[[ $status == 7 ]] || complain "the status was 7 and became $status"
[[ $output == through ]] || complain "the output became: $output"
expect_nothing_left "a command that fails"
expect_no_file_left "a command that fails"

"${run[@]}" bash -c 'sleep 1000 & exit 0' </dev/null
expect_nothing_left "a command that leaves a child"

for signal in TERM HUP; do
  start_and_signal "$signal"
  expect_nothing_left "signal $signal"
  expect_no_file_left "signal $signal"
done

# Two runs at a time get two displays.
"${run[@]}" bash -c 'echo "$DISPLAY"; sleep 1' >"$scratch/first" &
first=$!
"${run[@]}" bash -c 'echo "$DISPLAY"; sleep 1' >"$scratch/second"
wait "$first"
! cmp -s "$scratch/first" "$scratch/second" || complain "both got display $(cat "$scratch/first")"
expect_nothing_left "two at a time"

if setpriv --pdeathsig TERM true 2>/dev/null; then
  "${run[@]}" bash -c 'touch "$0"; exec sleep 3' "$scratch/killed" &
  outright=$!
  wait_for test -e "$scratch/killed" || complain "the command did not start"
  kill -KILL "$outright"
  wait "$outright" 2>/dev/null || true
  expect_nothing_left "signal KILL"
fi

if ((failures)); then
  echo "$failures complaints"
  exit 1
fi
echo "nothing is left behind"
