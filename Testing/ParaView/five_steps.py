# SPDX-License-Identifier: BSD-3-Clause
"""The five steps of Documentation/ParaView.md, in ParaView's window, with its trace on; see TestFiveSteps.py.

OUTPUT: where trace.py is written, and the file done at the end.
"""
import os

from paraview import smtrace
from paraview.simple import *  # noqa: F403, what a user's script does

LoadDistributedPlugin("IrradiancePlugin", remote=False, ns=globals())
view = GetActiveViewOrCreate("RenderView")
view.ViewSize = [600, 400]
smtrace.start_trace()

# 1. The floor: 4 x 4 m, cut into cells, because every cell gets one value.
floor = Plane(registrationName="Floor", Origin=[-2, -2, 0], Point1=[2, -2, 0], Point2=[-2, 2, 0],
              XResolution=60, YResolution=60)

# 2. The lamp: a square metre that shines downwards, 100 W/m2. Any cell with a RadiantExitance shines.
panel = Plane(registrationName="Panel", Origin=[-0.5, -0.5, 2.5], Point1=[-0.5, 0.5, 2.5], Point2=[0.5, -0.5, 2.5])
lamp = Calculator(registrationName="Lamp", Input=panel, AttributeType="Cell Data",
                  ResultArrayName="RadiantExitance", Function="100")

# 3. The part, and where it is over time: key frames of time, place and turn.
part = Sphere(registrationName="Part", Radius=0.4, ThetaResolution=32, PhiResolution=32)
pose = KeyFramedPose(registrationName="Ride", Input=part,
                     Poses=[0, -0.7, -0.3, 0.8, 0, 0, 0,
                            1, 1.2, 0.3, 0.8, 0, 0, 0])

# 4. The light.
light = Irradiance(registrationName="Light", Static=[floor, lamp], Dynamic=[pose])

# 5. Look at it.
display = Show(light, view)
ColorBy(display, ("CELLS", "Irradiance"))
display.SetScalarBarVisibility(view, True)
GetAnimationScene().UpdateAnimationUsingDataTimeSteps()
display.RescaleTransferFunctionToDataRange(False, True)
SetActiveSource(light)
view.CameraPosition = [3, -4.5, 4]
view.CameraFocalPoint = [0, 0, 0.9]
view.CameraViewUp = [0, 0, 1]
Render(view)

trace = smtrace.stop_trace()
with open(os.path.join(os.environ["OUTPUT"], "trace.py"), "w", encoding="utf-8") as file:
    file.write(trace)
with open(os.path.join(os.environ["OUTPUT"], "done"), "w", encoding="utf-8"):
    pass
