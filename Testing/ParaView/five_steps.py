# SPDX-License-Identifier: BSD-3-Clause
"""The five steps of Documentation/ParaView.md, in ParaView's window, with its trace on; see TestFiveSteps.py.

OUTPUT: where the window is left after each step, as step1.png to step5.png, then trace.py, and the file done at
the end.
"""
import os
import sys

from paraview import smtrace
from paraview.simple import *  # noqa: F403, what a user's script does

sys.path.append(os.environ["SCRIPTS"])
from grab_screen import grab_screen  # noqa: E402
from qt_events import process_events  # noqa: E402


def leave_window(step, active):
    """With the panel of what was made last."""
    SetActiveSource(active)
    view.CameraPosition, view.CameraFocalPoint, view.CameraViewUp = [4.9, -7.4, 5.9], [0, 0, 1], [0, 0, 1]
    Render(view)
    process_events(2)  # on a busy machine the window takes its time
    grab_screen(1150, 764, os.path.join(os.environ["OUTPUT"], f"step{step}.png"))


LoadDistributedPlugin("IrradiancePlugin", remote=False, ns=globals())
view = GetActiveViewOrCreate("RenderView")
view.ViewSize = [600, 400]
smtrace.start_trace()

# 1. The floor: 4 x 4 m, cut into cells, because every cell gets one value.
floor = Plane(registrationName="Floor", Origin=[-2, -2, 0], Point1=[2, -2, 0], Point2=[-2, 2, 0],
              XResolution=60, YResolution=60)
Show(floor, view)
leave_window(1, floor)

# 2. The lamp: a square metre that shines downwards, 100 W/m2. Any cell with a RadiantExitance shines.
panel = Plane(registrationName="Panel", Origin=[-0.5, -0.5, 2.5], Point1=[-0.5, 0.5, 2.5], Point2=[0.5, -0.5, 2.5])
lamp = Calculator(registrationName="Lamp", Input=panel, AttributeType="Cell Data",
                  ResultArrayName="RadiantExitance", Function="100")
Show(lamp, view)
leave_window(2, lamp)

# 3. The part, and where it is over time: key frames of time, place and turn.
part = Sphere(registrationName="Part", Radius=0.4, ThetaResolution=32, PhiResolution=32)
pose = KeyFramedPose(registrationName="Ride", Input=part,
                     Poses=[0, -0.7, -0.3, 0.8, 0, 0, 0,
                            1, 1.2, 0.3, 0.8, 0, 0, 0])
Show(pose, view)
leave_window(3, pose)

# 4. The light.
light = Irradiance(registrationName="Light", Static=[floor, lamp], Dynamic=[pose])
for source in (floor, lamp, pose):
    Hide(source, view)
display = Show(light, view)
leave_window(4, light)

# 5. Look at it.
ColorBy(display, ("CELLS", "Irradiance"))
display.SetScalarBarVisibility(view, True)
GetAnimationScene().UpdateAnimationUsingDataTimeSteps()
display.RescaleTransferFunctionToDataRange(False, True)
leave_window(5, light)

trace = smtrace.stop_trace()
with open(os.path.join(os.environ["OUTPUT"], "trace.py"), "w", encoding="utf-8") as file:
    file.write(trace)
with open(os.path.join(os.environ["OUTPUT"], "done"), "w", encoding="utf-8"):
    pass
