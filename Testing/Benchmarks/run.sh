#!/usr/bin/env bash
# Every benchmark from nothing: installs what is missing, fetches the meshes, builds in build/benchmark, runs
# the programs one after another and writes the pages of Documentation that they measure, with their
# pictures. The results stay in build/benchmark/results. Nothing else should run meanwhile.
#
#   run.sh [--quick] [performance | accuracy]
#
#   performance   Performance.md alone; half an hour
#   accuracy      SpeedAndAccuracy.md alone; three quarters of an hour
#   --quick       few rays, walks and rounds, to see that all runs; the pages go to the results' folder
set -euo pipefail

cd "$(dirname "${BASH_SOURCE[0]}")/../.."
# shellcheck source=Utilities/packages.sh
source Utilities/packages.sh

home=$PWD
build=$PWD/build/benchmark
report=$PWD/Testing/Benchmarks/Report
documentation=$PWD/Documentation
quick=no
if [[ ${1:-} == --quick ]]; then
  quick=yes
  documentation=$build/results
  shift
fi
part=${1:-all}
if (($# > 1)) || [[ $part != all && $part != performance && $part != accuracy ]]; then
  echo "usage: run.sh [--quick] [performance | accuracy]" >&2
  exit 2
fi

require_packages build benchmark display
fetch_data
if [[ $part != accuracy ]]; then
  # npm may have come by another way than Debian's package.
  has_command npm || (require_packages meshes) || true
  Data/fetch-benchmark-meshes.sh || echo "The scenes of these meshes are left out."
fi
python=$(python_with matplotlib)

echo "Building in $build ..."
if ! log=$(cmake -S . -B "$build" -G Ninja -DCMAKE_BUILD_TYPE=Release -DBUILD_TESTING=OFF \
  -DVTKIRRADIANCE_BUILD_EXAMPLES=ON -DVTKIRRADIANCE_BUILD_BENCHMARKS=ON -DVTKIRRADIANCE_WRAP_PYTHON=ON 2>&1); then
  echo "$log"
  exit 1
fi
cmake --build "$build" --parallel "$(nproc)"

# The plugin takes the engine from this build.
sdk=$build/paraview-sdk
if [[ $part != accuracy ]]; then
  Testing/ParaView/fetch-paraview.sh "$sdk"
  if ! log=$(cmake -S . -B "$build/paraview" -G Ninja -DCMAKE_BUILD_TYPE=Release -DBUILD_TESTING=OFF \
    -DVTKIRRADIANCE_BUILD_PARAVIEW_PLUGIN=ON -DVTKIRRADIANCE_ENGINE_DIR="$build" \
    -DParaView_DIR="$(echo "$sdk"/usr/lib/*/cmake/paraview-*)" 2>&1); then
    echo "$log"
    exit 1
  fi
  cmake --build "$build/paraview" --parallel "$(nproc)"
fi

# measure PROGRAM ARGUMENTS QUICK_ARGUMENTS: runs a program, or a script of Debian's Python or of ParaView's; its
# results go to PROGRAM.csv, as tables to the screen and a file
measure()
{
  local arguments=$2 program=("$build/bin/$1")
  [[ $quick == no ]] || arguments=$3
  echo "== $1"
  [[ -e ${program[0]} ]] || program=(/usr/bin/python3 -B "$home/Testing/Benchmarks/Programs/$1.py")
  # Debian's ParaView computes on one thread unless it is told otherwise.
  [[ $1 != BenchmarkParaView ]] ||
    program=(env VTK_SMP_BACKEND_IN_USE=STDThread "PV_PLUGIN_PATH=$(echo "$build"/paraview/lib/paraview-*/plugins)"
      "$home/Utilities/run-under-xvfb.sh" "$sdk/usr/bin/pvpython" "${program[@]:2}")
  # One thread, and a display for the picture.
  [[ $1 != BenchmarkMethods ]] ||
    program=(env VTK_SMP_BACKEND_IN_USE=Sequential "$home/Utilities/run-under-xvfb.sh" "${program[@]}")
  # As root in a container, without a shell to other machines.
  [[ $1 != BenchmarkRanks ]] ||
    program=(env OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1 OMPI_MCA_rmaps_base_oversubscribe=1
      OMPI_MCA_plm=isolated 'OMPI_MCA_btl=self,vader' OMPI_MCA_btl_vader_single_copy_mechanism=none
      mpirun -n 2 "${program[@]}")
  # shellcheck disable=SC2086 # several words
  PYTHONPATH=$(echo "$build"/lib/python3*/*-packages) "${program[@]}" $arguments >"$1.csv"
  "$python" "$report/results.py" "$1.csv" | tee "$1.txt"
}

# write_page NAME PROGRAM...: the page of Documentation from its template and the results of the programs
write_page()
{
  "$python" "$report/page.py" "$report/$1.md.in" "$documentation/$1.md" \
    "$build/Testing/Benchmarks/versions.md" "${@:2}"
  echo "$documentation/$1.md"
}

rm -rf "$build/results"
mkdir -p "$build/results"
cd "$build/results"
if [[ $part != accuracy ]]; then
  measure BenchmarkRayCasting "300000 5" "10000 2"
  measure BenchmarkMovingTeapot "1000000 5" "20000 2 2"
  measure BenchmarkShooting "" "20000 2"
  measure BenchmarkGathering "" "20000 2 16 64"
  measure BenchmarkSensors "" "20000 2 200 64 1"
  measure BenchmarkLamps "" "20000 2 4 16 64"
  measure BenchmarkChanges "" "20000 2"
  measure BenchmarkRanks "" "20000 2"
  measure BenchmarkPhotonStores "" "20000 2 1000"
  measure BenchmarkPython "" "2 20"
  measure BenchmarkParaView "" "20000 3"
  write_page Performance Benchmark{RayCasting,Shooting,Gathering,Sensors,Lamps,Changes,MovingTeapot,Ranks,PhotonStores,Python,ParaView}.csv
fi
if [[ $part != performance ]]; then
  measure BenchmarkMethods "15 $documentation/pictures/DirectLight.png $documentation/pictures/CellsInTheSameTime.png" "2"
  measure BenchmarkDefault "" "20000 1 0 3"
  measure BenchmarkAccuracy "" "65536 1"
  measure BenchmarkCellEstimates "" "100000 1 400000"
  write_page SpeedAndAccuracy Benchmark{Methods,Default,Accuracy,CellEstimates}.csv
fi
