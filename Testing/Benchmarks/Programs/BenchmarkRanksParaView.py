# SPDX-License-Identifier: BSD-3-Clause
"""What processes of pvbatch gain, one thread in each: seconds of the filter's first execution and of an update after a
motion, and memory of each process, as a table. The scene is that of BenchmarkParaView.py. Runs with 1, 2, 3
processes take turns; of several the fastest counts. Before any time counts, all have to have the same bits.

    PV_PLUGIN_PATH=FOLDER python3 BenchmarkRanksParaView.py PVBATCH [WALKS [ROUNDS [MOST_PROCESSES]]]

It calls itself, as the script of pvbatch: BenchmarkRanksParaView.py WALKS. No display is needed, as nothing is drawn.
"""
import hashlib
import os
import statistics
import subprocess
import sys
import time

STEPS = 10

# On each process: what it has, in MB.
TELL_PEAK = """
import re
from vtkmodules.vtkParallelCore import vtkMultiProcessController
rank = vtkMultiProcessController.GetGlobalController().GetLocalProcessId()
with open("/proc/self/status", encoding="ascii") as file:
    peak = int(re.search(r"VmHWM:\\s*(\\d+) kB", file.read())[1])
print("{what}", rank, peak * 1024 / 1e6, flush=True)
"""
TELL_HISTORY = """
from vtkmodules.vtkParallelCore import vtkMultiProcessController
rank = vtkMultiProcessController.GetGlobalController().GetLocalProcessId()
history = self.GetInputDataObject(0, 0).GetFieldData().GetArray("HistoryBytes").GetValue(0)
print("History", rank, history / 1e6, flush=True)
"""
# Only the whole output has field data on each process.
ASK_FOR_ALL = """
from vtkmodules.vtkCommonExecutionModel import vtkStreamingDemandDrivenPipeline
request = self.GetInputInformation(0, 0)
request.Set(vtkStreamingDemandDrivenPipeline.UPDATE_PIECE_NUMBER(), 0)
request.Set(vtkStreamingDemandDrivenPipeline.UPDATE_NUMBER_OF_PIECES(), 1)
"""


def bits(data):
    """Of the irradiance of all cells of a composite data set."""
    found = hashlib.sha256()
    iterator = data.NewIterator()
    while not iterator.IsDoneWithTraversal():
        found.update(memoryview(iterator.GetCurrentDataObject().GetCellData().GetArray("Irradiance")))
        iterator.GoToNextItem()
    return found.hexdigest()


def measure(walks):
    """In pvbatch: prints names, the process and numbers."""
    from paraview.simple import ProgrammableFilter, Sphere
    from BenchmarkParaView import make_light

    def on_each_process(source, script, at, **scripts):
        teller = ProgrammableFilter(Input=source, OutputDataSetType="vtkPolyData", Script=script, **scripts)
        teller.SMProxy.UpdatePipeline(at)

    on_each_process(Sphere(), TELL_PEAK.format(what="Before"), 0)
    light = make_light(walks, STEPS)
    for part in (*light.Static, *light.Dynamic):
        part.SMProxy.UpdatePipeline(0)
    seconds = []
    for step in range(STEPS + 1):
        begin = time.perf_counter()
        light.SMProxy.UpdatePipeline(step)
        seconds.append(time.perf_counter() - begin)
    print("First", 0, seconds[0])
    print("Update", 0, statistics.median(seconds[1:]))
    print("Bits", 0, bits(light.SMProxy.GetClientSideObject().GetOutputDataObject(0)), flush=True)
    on_each_process(light, TELL_PEAK.format(what="Peak"), STEPS)
    on_each_process(light, TELL_HISTORY, STEPS, RequestUpdateExtentScript=ASK_FOR_ALL)


def run(pvbatch, processes, walks):
    """What `measure` prints, as {name: values by process}."""
    script = os.path.abspath(__file__)
    environment = {**os.environ, "PYTHONDONTWRITEBYTECODE": "1", "PYTHONPATH": os.path.dirname(script),
                   "VTK_SMP_BACKEND_IN_USE": "Sequential", "OMPI_ALLOW_RUN_AS_ROOT": "1",
                   "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1", "OMPI_MCA_rmaps_base_oversubscribe": "1",
                   "OMPI_MCA_plm": "isolated", "OMPI_MCA_btl": "self,vader",
                   "OMPI_MCA_btl_vader_single_copy_mechanism": "none"}
    log = subprocess.run(["mpirun", "--timeout", "600", "-n", str(processes), pvbatch, script, str(walks)],
                         env=environment, capture_output=True, text=True, check=False)
    found = {}
    for line in log.stdout.splitlines():
        name, *values = line.split()[:3] or [""]
        if name in ("Before", "First", "Update", "Bits", "Peak", "History"):
            found.setdefault(name, {})[int(values[0])] = values[1] if name == "Bits" else float(values[1])
    if len(found) != 6 or len(found["History"]) != processes:
        sys.exit(f"{processes} processes failed:\n{log.stdout}{log.stderr}")
    return found


def compare(pvbatch, walks=1000000, rounds=5, most=3):
    runs = {processes: [] for processes in range(1, most + 1)}
    for _ in range(rounds):
        for processes, found in runs.items():
            found.append(run(pvbatch, processes, walks))
            if found[-1]["Bits"] != runs[1][0]["Bits"]:
                sys.exit(f"{processes} processes have other bits")
    print(f"{walks} walks; the fastest of {rounds} runs, of an update the median of {STEPS} in a run; memory of each "
          "process, and its peak before there was a scene\n")
    print("| processes | first frame, s | 1 / n | update, ms | 1 / n | stored walks, MB | peak, MB | before, MB |")
    print("|---|---|---|---|---|---|---|---|")
    fastest = {processes: [min(each[name][0] for each in found) for name in ("First", "Update")]
               for processes, found in runs.items()}
    for processes, (first, update) in fastest.items():
        memory = [", ".join(f"{min(each[name][rank] for each in runs[processes]):.0f}" for rank in range(processes))
                  for name in ("History", "Peak", "Before")]
        print("|", " | ".join([str(processes), f"{first:.2f}", f"{fastest[1][0] / first:.2f}", f"{1000 * update:.0f}",
                               f"{fastest[1][1] / update:.2f}", *memory]), "|")


if __name__ == "__main__":
    if sys.argv[1:] and not sys.argv[1].isdigit():
        compare(sys.argv[1], *map(int, sys.argv[2:]))
    elif len(sys.argv) == 2:
        measure(int(sys.argv[1]))
    else:
        sys.exit(__doc__)
