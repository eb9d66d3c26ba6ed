# SPDX-License-Identifier: BSD-3-Clause
"""What ParaView adds to a step of an animation: the whole step beside the filter's own execution and a render.

    PV_PLUGIN_PATH=FOLDER pvpython BenchmarkParaView.py [WALKS [STEPS]]
"""
import sys
import time

from paraview.simple import (
    Calculator, ColorBy, GetActiveViewOrCreate, GetAnimationScene, LoadDistributedPlugin, Plane, Render, Show, Sphere)
import paraview.simple

LoadDistributedPlugin("IrradiancePlugin", remote=False, ns=vars(paraview.simple))


class Stopwatch:
    """Seconds between StartEvent and EndEvent of an algorithm, which enclose its execution."""

    def __init__(self, algorithm):
        self.seconds = 0
        self.begun = 0
        algorithm.AddObserver("StartEvent", self.begin)
        algorithm.AddObserver("EndEvent", self.end)

    def begin(self, *_):
        self.begun = time.perf_counter()

    def end(self, *_):
        self.seconds += time.perf_counter() - self.begun


def make_light(walks, steps):
    """A floor of 14,400 cells, a lamp above it, and a ball of 8,000 cells that moves between them."""
    floor = Plane(Origin=[-2, -2, 0], Point1=[2, -2, 0], Point2=[-2, 2, 0], XResolution=120, YResolution=120)
    panel = Plane(Origin=[-0.5, -0.5, 2.5], Point1=[-0.5, 0.5, 2.5], Point2=[0.5, -0.5, 2.5])
    lamp = Calculator(Input=panel, AttributeType="Cell Data", ResultArrayName="RadiantExitance", Function="100")
    ball = Sphere(Radius=0.3, ThetaResolution=64, PhiResolution=64)
    ride = paraview.simple.KeyFramedPose(
        Input=ball, Poses=[0, -1, 0, 0.8, 0, 0, 0, steps, -1 + 0.05 * steps, 0, 0.8, 0, 0, 0])
    return paraview.simple.Irradiance(Static=[floor, lamp], Dynamic=[ride], NumberOfWalks=walks)


def main(walks=1000000, steps=20):
    light = make_light(walks, steps)
    view = GetActiveViewOrCreate("RenderView")
    view.ViewSize = [800, 600]
    ColorBy(Show(light, view), ("CELLS", "Irradiance"))
    animation = GetAnimationScene()
    animation.UpdateAnimationUsingDataTimeSteps()
    Render(view)
    stopwatch = Stopwatch(light.SMProxy.GetClientSideObject())
    for step in range(1, steps + 1):
        stopwatch.seconds = 0
        begin = time.perf_counter()
        animation.AnimationTime = step  # updates and renders
        whole = time.perf_counter() - begin
        if not stopwatch.seconds > 0:
            sys.exit(f"the filter did not execute in step {step}")
        begin = time.perf_counter()
        view.SMProxy.StillRender()
        render = time.perf_counter() - begin
        ratio = whole / (stopwatch.seconds + render)
        print(f'"ParaView","a step of an animation / the filter\'s execution and a render","",{ratio:.4g},1.15,1')
        print(f'"ParaView","the filter\'s execution","ms",{1000 * stopwatch.seconds:.4g},nan,nan')
        print(f'"ParaView","a render","ms",{1000 * render:.4g},nan,nan')


if __name__ == "__main__":
    main(*map(int, sys.argv[1:]))
