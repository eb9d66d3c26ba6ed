#!/usr/bin/env bash
# Runs a command under a private X server with software OpenGL, and leaves nothing behind.
#
#   run-under-xvfb.sh COMMAND [ARGUMENT...]
#
# The server chooses its own display number and reports it (-displayfd). Looking for a free number first, as
# xvfb-run does, is a race that two runs on one machine can lose. Software OpenGL gives the same pictures
# on every machine. Debian's VTK renders only through X, so a server is needed.
set -euo pipefail

if (($# == 0)); then
  echo "usage: run-under-xvfb.sh COMMAND [ARGUMENT...]" >&2
  exit 2
fi
if ! command -v Xvfb >/dev/null; then
  echo "run-under-xvfb.sh: there is no Xvfb" >&2
  exit 2
fi

server=
command=
scratch=$(mktemp -d)

# shellcheck disable=SC2317 # the trap calls it
clean_up()
{
  trap - EXIT
  trap '' TERM INT HUP
  # The command leads a process group of its own (set -m): what it started ends with it.
  [[ -z $command ]] || kill -TERM -- "-$command" 2>/dev/null || true
  if [[ -n $server ]]; then
    kill "$server" 2>/dev/null || true
    wait "$server" 2>/dev/null || true
  fi
  rm -rf "$scratch"
}
trap clean_up EXIT
trap 'exit 143' TERM
trap 'exit 130' INT
trap 'exit 129' HUP

# Where the system supports it, the server ends even if this script is killed outright.
with_parent=()
if setpriv --pdeathsig TERM true 2>/dev/null; then
  with_parent=(setpriv --pdeathsig TERM)
fi

mkfifo "$scratch/display"
"${with_parent[@]}" Xvfb -displayfd 3 -screen 0 1280x1024x24 -nolisten tcp -noreset \
  3<>"$scratch/display" >"$scratch/log" 2>&1 &
server=$!
if ! read -r -t 60 display <"$scratch/display"; then
  echo "run-under-xvfb.sh: Xvfb did not start" >&2
  cat "$scratch/log" >&2
  exit 1
fi

export DISPLAY=":$display"
unset WAYLAND_DISPLAY XAUTHORITY
export LIBGL_ALWAYS_SOFTWARE=1 GALLIUM_DRIVER=llvmpipe
# A program that could use MPI and runs alone would start a daemon that outlives it.
export OMPI_MCA_ess_singleton_isolated=1

set -m
"$@" <&0 &
command=$!
set +m
status=0
wait "$command" || status=$?
exit "$status"
