# SPDX-License-Identifier: BSD-3-Clause
"""Lamps from files, beams, and sun and sky: from the file or the panel to the light on the ground."""
import math
import os
import unittest

from paraview.simple import (
    Delete, GetActiveViewOrCreate, GetAnimationScene, OpenDataFile, Plane, Render, Show, Transform)

import plugin

# 1000 cd in all directions of the lower half.
LAMP = """IESNA:LM-63-2002
TILT=NONE
1 -1 1 2 1 1 2 0 0 0
1 1 10
0 90
0
1000 1000
"""
DHI, HEIGHT = 50, 0.8  # W/m2; of the bench, m
DAY = [("06:00", 300, DHI), ("09:00", 700, DHI), ("12:00", 800, DHI), ("16:00", 600, DHI), ("22:00", 0, 0)]


def write(name, text):
    path = os.path.join(plugin.OUTPUT, name)
    with open(path, "w", encoding="ascii") as file:
        file.write(text)
    return path


def light_on(source, block, time=0.0):
    """Of each cell of a static input, W/m2."""
    array = plugin.fetch(source, time).GetBlock(0).GetBlock(block).GetCellData().GetArray("Irradiance")
    return [array.GetValue(i) for i in range(array.GetNumberOfTuples())]


def light_below(*lights, side=0.05):
    """On a small square that is black, in the origin."""
    square = Plane(Origin=[-side, -side, 0], Point1=[side, -side, 0], Point2=[-side, side, 0])
    source = plugin.paraview.simple.Irradiance(
        Static=[square, *lights], Method="Gathered", NumberOfRays=256, DefaultDiffuseReflectance=0)
    return light_on(source, 0)[0]


class Lamps(unittest.TestCase):
    def test_a_file_of_a_lamp_opens_and_shines(self):
        for name in ("Lamp.ies", "LAMP.IES"):
            reader = OpenDataFile(write(name, LAMP))
            self.assertEqual(reader.SMProxy.GetXMLName(), "LuminaireReader")
        self.assertIn("LuminousEfficacy", plugin.messages_of(reader.UpdatePipeline))
        reader.LuminousEfficacy = 250
        lamp = Transform(Input=reader)
        lamp.Transform.Translate = [0, 0, 2]
        self.assertAlmostEqual(light_below(lamp), 1000 / 250 / 2**2, delta=0.01)
        lamp.Transform.Rotate = [180, 0, 0]
        self.assertEqual(light_below(lamp), 0)

    def test_a_beam(self):
        lamp = plugin.paraview.simple.BeamLight(Flux=12, BeamFrom="Cosine Power", Exponent=1, Center=[0, 0, 2])
        self.assertAlmostEqual(light_below(lamp), 12 / math.pi / 2**2, delta=0.01)
        lamp.BeamFrom, lamp.BeamAngle, lamp.FieldAngle = "Angles", 20, 40
        self.assertGreater(light_below(lamp), 5)
        lamp.NumberOfLamps, lamp.RingRadius = 6, 1
        self.assertLess(light_below(lamp), 0.5)
        lamp.Tilt = math.degrees(math.atan(1 / 2))
        self.assertGreater(light_below(lamp), 5)


class SunAndSky(unittest.TestCase):
    def test_a_free_plane(self):
        sky = plugin.paraview.simple.SunAndSky(
            SkyModel="Uniform", DirectNormalIrradiance=500, DiffuseHorizontalIrradiance=100, SunAltitude=30, Ground=0)
        self.assertAlmostEqual(light_below(sky), 500 / 2 + 100, delta=2)
        sky.SkyModel, sky.DirectNormalIrradiance = "CIE Clear", 0
        self.assertAlmostEqual(light_below(sky), 100, delta=2)

    def test_a_day_in_a_greenhouse_is_played(self):
        """Glass is left out. The bench casts a shadow, which goes from west to east."""
        weather = write("Day.csv", "time,DNI,DHI\n" + "".join(
            f"2024-06-21 {time},{direct},{diffuse}\n" for time, direct, diffuse in DAY))
        sky = plugin.paraview.simple.SunAndSky(
            SkyModel="Uniform", WeatherFileName=weather, Latitude=48.1, Longitude=11.6, TimeZone=1, Ground=0)
        floor = Plane(Origin=[-6, -4, 0], Point1=[6, -4, 0], Point2=[-6, 4, 0], XResolution=48, YResolution=32)
        bench = Plane(Origin=[-1.5, -1, HEIGHT], Point1=[1.5, -1, HEIGHT], Point2=[-1.5, 1, HEIGHT])
        source = plugin.paraview.simple.Irradiance(
            Static=[floor, bench, sky], Method="Gathered", NumberOfRays=64, DefaultDiffuseReflectance=0)
        view = GetActiveViewOrCreate("RenderView")
        self.addCleanup(Delete, view)
        Show(source, view)
        Render(view)
        scene = GetAnimationScene()
        scene.UpdateAnimationUsingDataTimeSteps()
        self.assertEqual(scene.PlayMode, "Snap To TimeSteps")
        played, shadows = [], []

        def look(*_):
            time = scene.TimeKeeper.Time
            played.append(time)
            fields = plugin.fetch(sky, time).GetFieldData()
            towards = fields.GetArray("SunDirection").GetTuple(0)
            sun = fields.GetArray("SunIrradiance").GetValue(0)
            on_floor = light_on(source, 0, time)
            diffuse = DAY[len(played) - 1][2]
            if sun == 0:
                self.assertEqual(max(on_floor), 0)
                return
            free = diffuse + sun * towards[2]
            self.assertAlmostEqual(light_on(source, 1, time)[0], free, delta=0.02 * free)
            shadow = [-HEIGHT * part / towards[2] for part in towards[:2]]
            cell = int((shadow[1] + 4) / 0.25) * 48 + int((shadow[0] + 6) / 0.25)
            self.assertLess(on_floor[cell], diffuse)
            self.assertAlmostEqual(on_floor[0], free, delta=0.05 * free)
            shadows.append(shadow[0])

        player = scene.SMProxy.GetClientSideObject()
        observer = player.AddObserver("AnimationCueTickEvent", look)
        scene.Play()
        player.RemoveObserver(observer)
        self.assertEqual(played, [0, 3 * 3600, 6 * 3600, 10 * 3600, 16 * 3600])
        self.assertEqual(shadows, sorted(shadows))
        self.assertLess(shadows[0], -1)
        self.assertGreater(shadows[-1], 0.5)


if __name__ == "__main__":
    unittest.main()
