#!/usr/bin/env bash
# Utilities/packages.sh without dpkg: it accepts what is installed, names what is missing, and then ends the
# script with status 2.
set -euo pipefail

# shellcheck source=Utilities/packages.sh
source "$(cd "$(dirname "${BASH_SOURCE[0]}")/../../Utilities" && pwd)/packages.sh"
has_dpkg=no
failures=0

# This test runs in a build, so all that a build needs is installed.
if ! report=$(require_packages build test fuzz package) || [[ -n $report ]]; then
  printf '%s\n' "all is there, and it says:" "$report"
  failures=$((failures + 1))
fi

# shellcheck disable=SC2317 # packages.sh calls both
has_command() { return 1; }
# shellcheck disable=SC2317
has_config() { return 1; }
unset VTK_DIR CGAL_DIR Eigen3_DIR GTest_DIR
status=0
report=$(require_packages build display test fuzz package) || status=$?
if ((status != 2)); then
  echo "nothing is there, and the status is $status"
  failures=$((failures + 1))
fi
for role in build display test fuzz package; do
  for package in $(packages_of "$role"); do
    if ! grep -qF "(Debian's $package)" <<<"$report"; then
      echo "$package is not there and is not named"
      failures=$((failures + 1))
    fi
  done
done

if ((failures)); then
  echo "$failures failures"
  exit 1
fi
