# SPDX-License-Identifier: BSD-3-Clause
"""ParaView loads the plugin; a lamp shines on a ball, and no power is lost.

    pvpython plugin_smoke.py IrradiancePlugin.so
"""
import sys

from paraview import servermanager
from paraview.simple import Calculator, LoadPlugin, Plane, Sphere
import paraview.simple

LoadPlugin(sys.argv[1], remote=False, ns=vars(paraview.simple))
lamp = Calculator(Input=Plane(), AttributeType="Cell Data", Function="100", ResultArrayName="RadiantExitance")
irradiance = paraview.simple.Irradiance(Static=[lamp], Dynamic=[Sphere(Center=[0, 0, 1])])
irradiance.UpdatePipeline()
output = servermanager.Fetch(irradiance)
emitted, absorbed, escaped = (output.GetFieldData().GetArray(name + "Power").GetValue(0)
                              for name in ("Emitted", "Absorbed", "Escaped"))
print(f"{emitted} W emitted, {absorbed} W absorbed, {escaped} W escaped")
if abs(emitted - 100) > 1e-9 or not absorbed > 0 or abs(absorbed + escaped - emitted) > 1e-9:
    sys.exit("the power does not balance")
