# SPDX-License-Identifier: BSD-3-Clause
"""Errors that come and go again while several processes draw together. For pvbatch; see TestRanks.py."""
from paraview.simple import GetActiveViewOrCreate, Render, Show, Sphere

import plugin

view = GetActiveViewOrCreate("RenderView")
source = plugin.make_scene(NumberOfWalks=10000)
radiance = plugin.paraview.simple.OutgoingRadiance(Input=source, EyePosition=[0, -1.9, 1.5])
probe = plugin.paraview.simple.IrradianceProbe(
    Sensors=Sphere(Radius=1, Center=[0, 0, 1]), Source=source, MaximumDistance=100)
for shown in (source, radiance, probe):
    Show(shown, view)
Render(view)
for proxy, name, wrong, right in ((source, "DefaultDiffuseReflectance", 2, 0.5), (probe, "MaximumRadius", -1, 0)):
    setattr(proxy, name, wrong)
    Render(view)
    setattr(proxy, name, right)
    Render(view)
    print("RESULT", name, radiance.GetDataInformation().GetNumberOfCells(),
          probe.GetDataInformation().GetNumberOfPoints())
