# SPDX-License-Identifier: BSD-3-Clause
"""Documentation/Guide.md, "Dragging in ParaView": the box of a Transform is dragged with the mouse, in ParaView's
window with Auto Apply; see TestDragging.py.

OUTPUT: where dragging.png, the window while the mouse is down, is left, then dragging.json.
"""
import json
import os
import sys

from paraview.simple import *  # noqa: F403, what a user's script does

sys.path.append(os.environ["SCRIPTS"])
from grab_screen import grab_screen  # noqa: E402
from qt_events import process_events  # noqa: E402

OUTPUT = os.environ["OUTPUT"]
LoadDistributedPlugin("IrradiancePlugin", remote=False, ns=globals())
view = GetActiveViewOrCreate("RenderView")

floor = Plane(Origin=[-2, -2, 0], Point1=[2, -2, 0], Point2=[-2, 2, 0], XResolution=60, YResolution=60)
panel = Plane(Origin=[-0.5, -0.5, 2.5], Point1=[-0.5, 0.5, 2.5], Point2=[0.5, -0.5, 2.5])
lamp = Calculator(Input=panel, AttributeType="Cell Data", ResultArrayName="RadiantExitance", Function="100")
part = Sphere(Radius=0.4, Center=[0, 0, 0.8], ThetaResolution=32, PhiResolution=32)
move = Transform(registrationName="Move", Input=part)
scene = {"Static": [floor, lamp], "Dynamic": [move], "NumberOfWalks": 4000000}
light = Irradiance(registrationName="Light", **scene, RepairTimeBudget=0.02)
display = Show(light, view)
ColorBy(display, ("CELLS", "Irradiance"))
view.CameraPosition, view.CameraFocalPoint, view.CameraViewUp = [4.9, -7.4, 5.9], [0, 0, 1], [0, 0, 1]
Render(view)
SetActiveSource(move)  # so its box is there
GetSettingsProxy("GeneralSettings").AutoApply = 1
process_events(1)


class Mouse:
    """The left button, with events as the window's widget makes them of the mouse's."""

    def __init__(self, place):
        self.interactor = view.SMProxy.GetInteractor()
        self.x, self.y = place

    def press(self):
        self.interactor.SetEventInformation(self.x, self.y)
        self.interactor.MouseMoveEvent()
        self.interactor.LeftButtonPressEvent()
        process_events(0.1)

    def move(self, right):
        before = executions
        self.x += right
        self.interactor.SetEventInformation(self.x, self.y)
        self.interactor.MouseMoveEvent()
        process_events(5, until=lambda: executions > before)

    def release(self):
        self.interactor.LeftButtonReleaseEvent()
        process_events(0.5)


def pixel_of(point):
    renderer = view.SMProxy.GetRenderer()
    renderer.SetWorldPoint(*point, 1)
    renderer.WorldToDisplay()
    return [round(value) for value in renderer.GetDisplayPoint()[:2]]


def state():
    """Where the part is in the picture's data, and what is not yet right."""
    output = light.SMProxy.GetClientSideObject().GetOutputDataObject(0)
    bounds = output.GetBlock(1).GetBlock(0).GetBounds()
    return {"executions": executions, "handle": list(move.Transform.Translate),
            "part": [(bounds[i] + bounds[i + 1]) / 2 for i in (0, 2, 4)],
            "stale": output.GetFieldData().GetArray("StalePower").GetValue(0)}


def bits(source):
    """The irradiance of the floor and of the part."""
    output = source.SMProxy.GetClientSideObject().GetOutputDataObject(0)
    return [bytes(memoryview(output.GetBlock(i).GetBlock(0).GetCellData().GetArray("Irradiance"))) for i in (0, 1)]


def count(*_):
    global executions
    executions += 1


executions = 0
light.SMProxy.GetClientSideObject().AddObserver("EndEvent", count)
mouse = Mouse(pixel_of([0, 0, 0.8]))
states = [state()]
mouse.press()
for _ in range(8):
    mouse.move(8)
    states.append(state())
grab_screen(1150, 764, os.path.join(OUTPUT, "dragging.png"))
mouse.release()
released = state()
light.RepairTimeBudget = 0
Render(view)
settled = state()
new = Irradiance(**scene)
new.UpdatePipeline()
settled["is exact"] = bits(light) == bits(new)
with open(os.path.join(OUTPUT, "dragging.part"), "w", encoding="utf-8") as file:
    json.dump({"states": states, "released": released, "settled": settled}, file)
os.rename(os.path.join(OUTPUT, "dragging.part"), os.path.join(OUTPUT, "dragging.json"))
