# SPDX-License-Identifier: BSD-3-Clause
"""Properties of the panels: what they are set to, and what they show."""
import pathlib
import re
import unittest

from paraview.simple import Calculator, IntegrateVariables, Plane, Sphere

import plugin


MODULES = pathlib.Path(__file__).parents[2] / "Modules"
SETTER = re.compile(r"^  vtkSet\w*Macro\((\w+)", re.MULTILINE)


class Panel(unittest.TestCase):
    def test_every_property_of_the_filters_is_there(self):
        headers = [header for header in sorted((MODULES / "FiltersIrradiance").glob("vtk*.h"))
                   if SETTER.search(header.read_text())]
        panels = {panel.stem: panel.read_text() for panel in (MODULES / "ParaViewPlugin").glob("*.xml")}
        self.assertGreaterEqual(len(headers), 5)
        for header in headers:
            panel = next(text for text in panels.values() if f'class="{header.stem}"' in text)
            absent = [name for name in SETTER.findall(header.read_text()) if f'command="Set{name}"' not in panel]
            self.assertEqual(absent, [], header.stem)

    def test_defaults_are_those_of_the_filter(self):
        source = plugin.paraview.simple.Irradiance(Static=[Plane()])
        with open(f"{plugin.FOLDER}/defaults.txt", encoding="utf-8") as file:
            text = file.read()  # as the C++ filter prints itself
        for name in ("NumberOfWalks", "Seed", "TraversalMode", "UpdateMode", "CacheStaticHits", "SeparateSides",
                     "Method", "NumberOfSpreadPhotons", "NumberOfRays", "ComputeStandardError",
                     "NumberOfReplicates", "DefaultDiffuseReflectance"):
            value = source.SMProxy.GetProperty(name).GetElement(0)
            self.assertIn(f"  {name}: {value}\n", text)

    def test_a_calculator_makes_a_lamp(self):
        """1 m2 of 100 W/m2 1 m above the ground: all that does not escape is absorbed."""
        ground = Plane(Origin=[-5, -5, 0], Point1=[5, -5, 0], Point2=[-5, 5, 0], XResolution=20, YResolution=20)
        panel = Plane(Origin=[-0.5, -0.5, 1], Point1=[-0.5, 0.5, 1], Point2=[0.5, -0.5, 1])
        lamp = Calculator(Input=panel, AttributeType="Cell Data", ResultArrayName="RadiantExitance", Function="100")
        source = plugin.paraview.simple.Irradiance(
            Static=[ground, lamp], NumberOfWalks=20000, DefaultDiffuseReflectance=0)
        source.UpdatePipeline()
        self.assertAlmostEqual(plugin.figure(source, "EmittedPower"), 100, delta=1e-6)
        absorbed = plugin.figure(source, "AbsorbedPower")
        self.assertAlmostEqual(absorbed + plugin.figure(source, "EscapedPower"), 100, delta=1e-6)
        total = IntegrateVariables(Input=source)
        total.UpdatePipeline()
        self.assertAlmostEqual(total.CellData["Irradiance"].GetRange()[0], absorbed, delta=1e-6)
        self.assertEqual(plugin.figure(source, "NumberOfWalks"), 0)  # nothing reflects
        source.RadiantExitanceArray = "None"
        self.assertIn("no light", plugin.messages_of(source.UpdatePipeline))

    def test_methods(self):
        source = plugin.make_scene(NumberOfWalks=5000, Method="Walks")
        shot = plugin.bits(plugin.fetch(source))["1 Irradiance"]
        source.Method = "Gathered"
        gathered = plugin.bits(plugin.fetch(source))["1 Irradiance"]
        self.assertNotEqual(gathered, shot)
        probe = plugin.paraview.simple.IrradianceProbe(Sensors=Sphere(Center=[0, 0, 0], Radius=0.01), Source=source)
        self.assertEqual(plugin.messages_of(probe.UpdatePipeline), "")
        self.assertGreater(probe.PointData["Irradiance"].GetNumberOfComponents(), 0)
        source.Method = "Walks"
        self.assertEqual(plugin.bits(plugin.fetch(source))["1 Irradiance"], shot)
        old = plugin.make_scene(NumberOfWalks=5000)
        text = plugin.messages_of(lambda: setattr(old, "DirectLight", "Gathered"))
        self.assertIn("set Method", text)
        old.CellEstimate = "Gathered"
        self.assertEqual(plugin.bits(plugin.fetch(old))["1 Irradiance"], gathered)

    def test_light_groups(self):
        source = plugin.make_scene(NumberOfWalks=5000, ComputeLightGroups=1)
        full = plugin.bits(plugin.fetch(source))
        self.assertEqual(full["1 Irradiance_Static"], full["1 Irradiance"])
        values = memoryview(full["1 Irradiance"]).cast("d").tolist()
        self.assertGreater(sum(values), 0)
        source.LightGroupFactors = ["Static", "0.25"]
        dimmed = memoryview(plugin.bits(plugin.fetch(source))["1 Irradiance"]).cast("d").tolist()
        self.assertEqual(dimmed, [0.25 * value for value in values])  # a power of two changes no digit
        source.LightGroupFactors = []
        self.assertEqual(plugin.bits(plugin.fetch(source))["1 Irradiance"], full["1 Irradiance"])

    def test_old_states_load(self):
        """A state of before has the old names, and no Method."""
        source = plugin.make_scene(NumberOfWalks=5001, Method="Walks")  # no other source has as many
        expected = plugin.bits(plugin.fetch(source))["1 Irradiance"]
        source.Method = "Automatic"
        state = f"{plugin.OUTPUT}/old.pvsm"
        plugin.paraview.simple.SaveState(state)
        with open(state, encoding="utf-8") as file:
            text = file.read()
        text = re.sub(r'<Property name="Method".*?</Property>', "", text, flags=re.DOTALL)
        for name in ("DirectLight", "CellEstimate"):
            text, count = re.subn(rf'(<Property name="{name}" [^>]*>\s*<Element index="0" value=)"-1"', r'\1"0"', text)
            self.assertGreater(count, 0, name)
        with open(state, "w", encoding="utf-8") as file:
            file.write(text)
        before = set(plugin.paraview.simple.GetSources())
        plugin.paraview.simple.LoadState(state)
        loaded = next(proxy for name, proxy in plugin.paraview.simple.GetSources().items()
                      if name not in before and proxy.SMProxy.GetXMLName() == "Irradiance"
                      and proxy.NumberOfWalks == 5001)
        self.assertEqual(plugin.bits(plugin.fetch(loaded))["1 Irradiance"], expected)

    def test_parts_come_and_go(self):
        source = plugin.make_scene(NumberOfWalks=1000)
        self.assertEqual(plugin.fetch(source).GetBlock(1).GetNumberOfBlocks(), 1)
        source.Dynamic = [plugin.make_pose(), plugin.make_pose(OutsideOfKeys="Hold")]
        self.assertEqual(plugin.fetch(source).GetBlock(1).GetNumberOfBlocks(), 2)
        source.Dynamic = []
        self.assertEqual(plugin.fetch(source).GetBlock(1).GetNumberOfBlocks(), 0)

    def test_what_looks_at_the_light(self):
        source = plugin.make_scene(NumberOfWalks=20000)
        radiance = plugin.paraview.simple.OutgoingRadiance(Input=source, EyePosition=[0, 0, 1.5])
        self.assertGreater(radiance.SMProxy.UpdatePipeline(0.0) or radiance.CellData["Radiance"].GetRange()[1], 0)
        points = plugin.paraview.simple.PointIrradiance(Input=source, NumberOfRays=4)
        points.SMProxy.UpdatePipeline(0.0)
        self.assertGreater(points.PointData["PointIrradiance"].GetRange()[1], 0)
        probe = plugin.paraview.simple.IrradianceProbe(
            Sensors=Sphere(Center=[0, 0, 0], Radius=0.01), Source=source, Estimate="Nearest")
        probe.SMProxy.UpdatePipeline(0.0)
        self.assertEqual(probe.PointData["NumberOfPhotons"].GetRange()[1], 50)
        walks = plugin.paraview.simple.PhotonWalks(Input=source, NumberOfWalks=7)
        walks.UpdatePipeline(0.0)
        self.assertEqual(walks.GetDataInformation().GetNumberOfCells(), 7)
        dose = plugin.paraview.simple.RadiantExposure(Input=source)
        dose.UpdatePipeline()
        whole = dose.CellData["RadiantExposure"].GetRange()[1]
        dose.StartTime, dose.EndTime = "0.5", "1"
        dose.UpdatePipeline()
        part = dose.CellData["RadiantExposure"].GetRange()[1]
        self.assertTrue(0 < part < 0.5 * whole, f"{part} of {whole}")

    def test_a_probe_follows_the_time(self):
        source = plugin.make_scene(NumberOfWalks=20000)
        probe = plugin.paraview.simple.IrradianceProbe(
            Sensors=Sphere(Center=[0, 0, 0], Radius=0.01), Source=source)
        values = {}
        for time in (0.0, 1.0, 2.0, 1.0, 0.0):
            array = plugin.fetch(probe, time).GetPointData().GetArray("Irradiance")
            self.assertEqual(values.setdefault(time, bytes(memoryview(array))), bytes(memoryview(array)))
        self.assertEqual(len(set(values.values())), 3, "the part moves")

    def test_poses_of_composite_data(self):
        part = plugin.make_pose().Input
        blocks = plugin.paraview.simple.GroupDatasets(Input=[part, Sphere(Center=[0, 0, 1], Radius=0.2)])
        source = plugin.make_scene(NumberOfWalks=20000, Dynamic=[plugin.make_pose(Input=blocks)])
        leaves = {}
        for time in (0.0, 2.0, 0.0):
            dynamic = list(plugin.leaves(plugin.fetch(source, time).GetBlock(1)))
            self.assertEqual(len(dynamic), 2)
            leaves.setdefault(time, [leaf.GetCenter() for leaf in dynamic])
        self.assertNotEqual(leaves[0.0][0], leaves[2.0][0])
        self.assertNotEqual(leaves[0.0][1], leaves[2.0][1])

    def test_an_abort_leaves_nothing_behind(self):
        source = plugin.make_scene()
        filter = source.SMProxy.GetClientSideObject()
        seen = []

        def stop(caller, event):
            seen.append(caller.GetProgress())
            caller.SetAbortExecute(1)

        observer = filter.AddObserver("ProgressEvent", stop)
        self.assertEqual(plugin.fetch(source).GetNumberOfPoints(), 0)
        self.assertTrue(seen)
        filter.RemoveObserver(observer)
        filter.SetAbortExecute(0)
        filter.Modified()
        expected = plugin.bits(plugin.fetch(plugin.make_scene()))
        source.SMProxy.MarkModified(source.SMProxy)
        ours = plugin.bits(plugin.fetch(source))
        self.assertEqual(ours["1 Irradiance"], expected["1 Irradiance"])


if __name__ == "__main__":
    unittest.main()
