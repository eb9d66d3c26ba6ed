#!/usr/bin/env bash
# Every benchmark from nothing: installs what is missing, fetches the meshes, builds in build/benchmark, runs
# the programs one after another and writes the pages of Documentation that they measure, with their
# pictures. The results stay in build/benchmark/results. Nothing else should run meanwhile.
#
#   run.sh [--quick] [performance | accuracy]
#
#   performance   Performance.md alone; twenty minutes
#   accuracy      SpeedAndAccuracy.md alone; six minutes
#   --quick       few rays, walks and rounds, to see that all runs; the pages go to the results' folder
set -euo pipefail

cd "$(dirname "${BASH_SOURCE[0]}")/../.."
# shellcheck source=Utilities/packages.sh
source Utilities/packages.sh

root=$PWD
build=build/benchmark
results=$root/$build/results
documentation=$root/Documentation
ray_casting=(300000 5) modes=() scan=() far=() signs=() teapot=(1000000 5) budget=()
accuracy=() pilots=() stale=()
if [[ ${1:-} == --quick ]]; then
  ray_casting=(10000 2 123 1) modes=(10000 2) scan=(1 2) far=(5000 1) signs=(100) teapot=(20000 2 2) budget=(20000 2)
  accuracy=(65536 1) pilots=(8192 2) stale=(8192 2)
  documentation=$results
  shift
fi
part=${1:-all}
if (($# > 1)) || [[ $part != all && $part != performance && $part != accuracy ]]; then
  echo "usage: run.sh [--quick] [performance | accuracy]" >&2
  exit 2
fi

require_packages build display benchmark
fetch_data
if [[ $part != accuracy ]]; then
  # npm may have come by another way than Debian's package.
  has_command npm || (require_packages meshes) || true
  Data/fetch-benchmark-meshes.sh || echo "The scenes of these meshes are left out."
fi

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

# write_page NAME PROGRAM...: the page of Documentation from its template and the results of the programs
write_page()
{
  "$root/Utilities/run-under-xvfb.sh" ../bin/BenchmarkReport "$root/Testing/Benchmarks/$1.md.in" \
    "$documentation/$1.md" "$documentation/pictures" "${@:2}"
  echo "$documentation/$1.md"
}

rm -rf "$results"
mkdir -p "$results" "$documentation/pictures"
cd "$results"
if [[ $part != accuracy ]]; then
  measure BenchmarkRayCasting "${ray_casting[@]}"
  measure BenchmarkTraversalModes "${modes[@]}"
  measure BenchmarkSegmentScan "${scan[@]}"
  measure BenchmarkFarAndMany "${far[@]}"
  measure BenchmarkSigns "${signs[@]}"
  measure BenchmarkMovingTeapot "${teapot[@]}"
  measure BenchmarkRepairBudget "${budget[@]}"
  write_page Performance Benchmark{RayCasting,TraversalModes,SegmentScan,FarAndMany,Signs,MovingTeapot,RepairBudget}.csv
fi
if [[ $part != performance ]]; then
  measure BenchmarkAccuracy "${accuracy[@]}"
  measure BenchmarkPilotPhotons "${pilots[@]}"
  measure BenchmarkStaleError "${stale[@]}"
  write_page SpeedAndAccuracy Benchmark{Accuracy,PilotPhotons,StaleError}.csv
fi
