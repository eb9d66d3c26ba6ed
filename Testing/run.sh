#!/usr/bin/env bash
# Runs every test: installs what is missing; builds build/release and runs all tests and examples there under a
# private X server; fetches Debian's ParaView into build/paraview-sdk, builds build/paraview and tests the plugin
# there; builds build/sanitize with clang's address and undefined-behaviour sanitizers, runs the engine's tests there
# and fuzzes. The last line sums it up; the status is 0 only if nothing
# failed. What this system has no packages for is left out, in a line that says so.
set -euo pipefail

cd "$(dirname "${BASH_SOURCE[0]}")/.."
# shellcheck source=Utilities/packages.sh
source Utilities/packages.sh

passed=0
failed=0

finish()
{
  echo "$passed passed, $failed failed"
  ((failed == 0)) || exit 1
  exit 0
}

# build PRESET [CONFIGURE_OPTION...]: counts one failure if it cannot be built
build()
{
  local preset=$1
  shift
  echo "== $preset: build"
  if cmake --preset "$preset" "$@" && cmake --build --preset "$preset" --parallel "$(nproc)"; then
    return 0
  fi
  echo "$preset could not be built"
  failed=$((failed + 1))
  return 1
}

# count ATTRIBUTE REPORT: a number in the heading of ctest's JUnit report
count()
{
  sed -nE "s/^[[:space:]]*$1=\"([0-9]+)\".*/\\1/p; s/.*<testsuite [^>]*[[:space:]]$1=\"([0-9]+)\".*/\\1/p" "$2" | head -n 1
}

# run_tests PRESET [COMMAND_PREFIX...]
run_tests()
{
  local preset=$1 report=$PWD/build/$1/Testing/report.xml status=0
  shift
  echo "== $preset: tests"
  rm -f "$report"
  "$@" ctest --preset "$preset" --no-tests=error --parallel "$(nproc)" --output-junit "$report" || status=$?

  local total=0 unsuccessful=0 not_run=0
  if [[ -e $report ]]; then
    total=$(count tests "$report")
    unsuccessful=$(count failures "$report")
    not_run=$(($(count skipped "$report") + $(count disabled "$report")))
  fi
  # Something other than a test failed: there is no test at all, a program is missing, or no server starts.
  if ((status != 0 && unsuccessful == 0)); then
    unsuccessful=$((not_run > 0 ? not_run : 1))
    not_run=$((not_run > 0 ? 0 : not_run))
    total=$((total > unsuccessful ? total : unsuccessful))
  fi
  if ((not_run > 0)); then
    echo "$not_run tests were skipped"
    grep -oE 'Skipped: [^<]*' "$report" || true # those that say why
  fi
  passed=$((passed + total - unsuccessful - not_run))
  failed=$((failed + unsuccessful))
}

require_packages build display test fuzz package

if ! fetch_data; then
  echo "The examples' data could not be fetched"
  failed=$((failed + 1))
fi

if build release -DBUILD_TESTING=ON -DVTKIRRADIANCE_BUILD_EXAMPLES=ON; then
  run_tests release Utilities/run-under-xvfb.sh
fi
# The plugin takes the engine from build/release. ParaView comes unpacked: it cannot be installed beside VTK.
sdk=$PWD/build/paraview-sdk
fetched=0
Testing/ParaView/fetch-paraview.sh "$sdk" || fetched=$?
if ((fetched == 0)); then
  if build paraview -DBUILD_TESTING=ON -DVTKIRRADIANCE_ENGINE_DIR="$PWD/build/release" \
    -DVTKIRRADIANCE_DEBIAN_PACKAGES=ON -DCMAKE_INSTALL_PREFIX=/usr \
    -DParaView_DIR="$(echo "$sdk"/usr/lib/*/cmake/paraview-*)"; then
    run_tests paraview Utilities/run-under-xvfb.sh
  fi
elif ((fetched != 3)); then # 3: this system has none, as it has said
  failed=$((failed + 1))
fi
# The leak check looks itself up in /proc, which is missing or another system's in some chroots.
if ! [[ /proc/self/status -ef /proc/$BASHPID/status ]]; then
  echo "Without the search for leaks: /proc belongs to another process."
  export ASAN_OPTIONS=detect_leaks=0
fi
if build sanitize; then
  run_tests sanitize
fi
echo "== fuzz"
if Testing/Fuzzing/run.sh 30; then
  passed=$((passed + 1))
else
  failed=$((failed + 1))
fi
finish
