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
    """Seconds between StartEvent and EndEvent, which enclose an algorithm's execution and a window's render."""

    def __init__(self, watched):
        self.seconds = 0
        self.begun = 0
        watched.AddObserver("StartEvent", self.begin)
        watched.AddObserver("EndEvent", self.end)

    def begin(self, *_):
        self.begun = time.perf_counter()

    def end(self, *_):
        self.seconds += time.perf_counter() - self.begun


def make_room():
    """4 x 4 x 2.6 m, of 9,600 cells."""
    low, high = [-2, -2, 0], [2, 2, 2.6]
    for corner, ends in ((low, ([2, -2, 0], [-2, 2, 0])), (low, ([2, -2, 0], [-2, -2, 2.6])),
                         (low, ([-2, 2, 0], [-2, -2, 2.6])), (high, ([-2, 2, 2.6], [2, -2, 2.6])),
                         (high, ([-2, 2, 2.6], [2, 2, 0])), (high, ([2, -2, 2.6], [2, 2, 0]))):
        yield Plane(Origin=corner, Point1=ends[0], Point2=ends[1], XResolution=40, YResolution=40)


def make_light(walks, steps):
    """A closed room that reflects half, a lamp in it, and a ball of 8,000 cells that moves."""
    panel = Plane(Origin=[-0.5, -0.5, 2.5], Point1=[-0.5, 0.5, 2.5], Point2=[0.5, -0.5, 2.5])
    lamp = Calculator(Input=panel, AttributeType="Cell Data", ResultArrayName="RadiantExitance", Function="100")
    ball = Sphere(Radius=0.3, ThetaResolution=64, PhiResolution=64)
    ride = paraview.simple.KeyFramedPose(
        Input=ball, Poses=[0, -1, 0, 0.8, 0, 0, 0, steps, -1 + 0.05 * steps, 0, 0.8, 0, 0, 0])
    return paraview.simple.Irradiance(Static=[*make_room(), lamp], Dynamic=[ride], NumberOfWalks=walks)


def main(walks=1000000, steps=20):
    light = make_light(walks, steps)
    view = GetActiveViewOrCreate("RenderView")
    view.ViewSize = [800, 600]
    ColorBy(Show(light, view), ("CELLS", "Irradiance"))
    animation = GetAnimationScene()
    animation.UpdateAnimationUsingDataTimeSteps()
    Render(view)
    execution = Stopwatch(light.SMProxy.GetClientSideObject())
    render = Stopwatch(view.SMProxy.GetRenderWindow())
    for step in range(1, steps + 1):
        execution.seconds = render.seconds = 0
        begin = time.perf_counter()
        animation.AnimationTime = step  # updates and renders
        whole = time.perf_counter() - begin
        if not (execution.seconds > 0 and render.seconds > 0):
            sys.exit(f"the filter or the view did not execute in step {step}")
        ratio = whole / (execution.seconds + render.seconds)
        print(f'"ParaView","a step of an animation / the filter\'s execution and the render","",{ratio:.4g},1.15,1')
        for name, seconds in (("the filter's execution", execution.seconds), ("the render", render.seconds),
                              ("all else in the step", whole - execution.seconds - render.seconds)):
            print(f'"ParaView","{name}","ms",{1000 * seconds:.4g},nan,nan')


if __name__ == "__main__":
    main(*map(int, sys.argv[1:]))
