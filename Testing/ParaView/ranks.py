# SPDX-License-Identifier: BSD-3-Clause
"""What several processes make of a scene together. For pvbatch; see TestRanks.py.

    pvbatch ranks.py PICTURE     prints sums over all cells
"""
import sys

from paraview.simple import IntegrateVariables, SaveScreenshot, Sphere, XMLPolyDataReader

import plugin

source = plugin.make_scene(NumberOfOutputWalks=20)
radiance = plugin.paraview.simple.OutgoingRadiance(Input=source, EyePosition=[0, -1.9, 1.5])
probe = plugin.paraview.simple.IrradianceProbe(Sensors=Sphere(Radius=1, Center=[0, 0, 1]), Source=source,
                                               MaximumDistance=100)
dose = plugin.paraview.simple.RadiantExposure(Input=source)
for name, result, attributes, array in (("irradiance", source, "CellData", "Irradiance"),
                                        ("radiance", radiance, "CellData", "Radiance"),
                                        ("sensors", probe, "PointData", "SearchRadius"),
                                        ("dose", dose, "CellData", "RadiantExposure")):
    result.SMProxy.UpdatePipeline(1.0)
    total = IntegrateVariables(Input=result)
    total.SMProxy.UpdatePipeline(1.0)
    information = result.GetDataInformation()
    print("RESULT", name, information.GetNumberOfCells(), information.GetNumberOfPoints(),
          getattr(total, attributes)[array].GetRange())
walks = plugin.servermanager.OutputPort(source, 1)
print("RESULT walks", walks.GetDataInformation().GetNumberOfCells())

view = plugin.show(source, 200)
view.ViewTime = 1
SaveScreenshot(sys.argv[1], view, ImageResolution=[200, 200])
