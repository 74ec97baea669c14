# SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
# SPDX-License-Identifier: BSD-3-Clause
"""Properties, choices and statistics of all classes: setters and getters agree, a change modifies
the object, an equal value does not, and statistics begin at 0."""
import math
import re
import unittest

from meniscus import (vtkRefractedGeometryFilter, vtkRefractionErrorVolume,
                      vtkTetrahedraRayCastMapper, vtkTetrahedraRayIntegral)
from TestNames import classes, own_names
from vtkmodules.vtkCommonDataModel import vtkSphere
from vtkmodules.vtkRenderingCore import vtkCamera

DEFAULTS = {
    "AngularErrors": False, "Backend": 0, "BlendMode": 0, "EarlyTerminationOpacity": 1 - 1 / 131072,
    "ExteriorIndexOfRefraction": 1.0, "Images": 1, "Integration": 0,
    "InteriorIndexOfRefraction": 1.333, "LightDirection": (0, 0, 0), "MembraneModel": 1,
    "OneSided": False, "OpacityModel": 0, "Positional": False, "ReflectanceModel": 0,
    "ViewAspectRatio": 0, "ViewCulling": True, "VirtualNormals": False}


def things():
    """An object of each class that has objects, with the methods that are not VTK's."""
    for kind in classes().values():
        try:
            thing = kind()
        except (TypeError, NotImplementedError):  # abstract
            continue
        yield thing, {method for one in kind.__mro__ if one.__name__ in classes()
                      for method in own_names(one)}


def others_of(value):
    """Values that a property may take as well, one of them within its limits; none for objects."""
    if isinstance(value, bool):
        return [not value]
    if isinstance(value, tuple):
        return [tuple(each + 1 for each in value)]
    if isinstance(value, int):
        return [value + 1, value - 1]
    if isinstance(value, float):
        return [value + 1, value - 1, value + 0.125, value / 2]
    return ["text"] if isinstance(value, str) else []


class TestProperties(unittest.TestCase):
    def check_pair(self, thing, name, value):
        get, change = (getattr(thing, verb + name) for verb in ("Get", "Set"))
        for other in others_of(value):
            change(value)
            before = thing.GetMTime()
            change(other)
            if get() == other:
                break
        self.assertEqual(get(), other)
        self.assertGreater(thing.GetMTime(), before)
        before = thing.GetMTime()
        change(other)
        if not isinstance(other, str):  # VTK's macro for them does not compare
            self.assertEqual(thing.GetMTime(), before)
        change(value)

    def test_pairs(self):
        count = 0
        for thing, methods in things():
            for name in sorted(method[3:] for method in methods if method.startswith("Set")):
                with self.subTest(kind=thing.GetClassName(), name=name):
                    try:
                        value = getattr(thing, "Get" + name)()
                    except (AttributeError, TypeError):  # none, or one for each of several things
                        continue
                    self.assertEqual(value, DEFAULTS.get(name, value))
                    if others_of(value):
                        self.check_pair(thing, name, value)
                        self.assertIn(re.sub(".*IndexOfRefraction", "Interfaces", name) + ":",
                                      str(thing).replace("ExteriorIndexOfRefraction", "Interfaces"))
                        count += 1
        self.assertGreater(count, 130)

    def test_choices(self):
        """Every value of an enumeration has a method that sets it."""
        count = 0
        for thing, methods in things():
            reached = {}
            for method in methods:
                match = re.match(r"Set(\w+?)To(\w+)$", method)
                if match and "Get" + match[1] in methods:
                    getattr(thing, method)()
                    value = getattr(thing, "Get" + match[1])()
                    self.assertTrue([name for name in dir(thing) if name.isupper()
                                     and name.replace("_", "").startswith(match[2].upper())
                                     and getattr(thing, name) == value], method)
                    self.assertNotIn(value, reached.setdefault(match[1], set()), method)
                    reached[match[1]].add(value)
            for name, values in reached.items():
                count += len(values)
                for value in (-9, 999):  # the limits
                    getattr(thing, "Set" + name)(value)
                    self.assertIn(getattr(thing, "Get" + name)(), values, name)
                self.assertEqual(len(values), max(values) - min(values) + 1, name)
        self.assertGreater(count, 60)

    def test_limits(self):
        """A number beyond its limits becomes the nearest limit."""
        mapper = vtkTetrahedraRayCastMapper()
        for name, low, high in (("ColorBias", 0, 0.5), ("Backend", 0, 3), ("DepthWriting", -1, 1),
                                ("PreIntegrationScalarSize", 2, 1024),
                                ("PreIntegrationLengthSize", 1, 128)):
            for value, kept in ((low - 1, low), (high + 1, high)):
                getattr(mapper, "Set" + name)(value)
                self.assertEqual(getattr(mapper, "Get" + name)(), kept, name)

    def check_statistics(self, thing):
        """Each name is in the table once, with a meaning and the value that it has by name; getters
        of the same name agree; unknown names are errors."""
        table = thing.GetStatistics()
        self.assertEqual([table.GetColumnName(i) for i in range(table.GetNumberOfColumns())],
                         ["Name", "Meaning", "Value"])
        listed = set()
        for row in range(table.GetNumberOfRows()):
            name, meaning, value = (table.GetValue(row, column) for column in range(3))
            name, value = name.ToString(), value.ToDouble()
            self.assertNotIn(name, listed)
            listed.add(name)
            self.assertGreater(len(meaning.ToString()), 10)
            self.assertEqual(value, name == "UsedImageSampleDistance", name)
            self.assertEqual(thing.GetStatistic(name), value)
            if hasattr(thing, "Get" + name):
                self.assertEqual(getattr(thing, "Get" + name)(), value)
            self.assertIn(name + ": ", str(thing))
        told = []
        thing.AddObserver("ErrorEvent", lambda *_: told.append(1))
        self.assertTrue(math.isnan(thing.GetStatistic("NumberOfElephants")))
        self.assertTrue(math.isnan(thing.GetStatistic(None)))
        self.assertEqual(len(told), 2)
        return len(listed)

    def test_statistics(self):
        tables = [self.check_statistics(thing) for thing, methods in things()
                  if hasattr(thing, "GetStatistics")]
        self.assertGreater(min(tables), 3)
        self.assertGreater(sum(tables), 60)
        for thing, methods in things():
            for method in methods:
                if re.match(r"GetNumberOf(?!Interfaces$|Items$)\w+$", method) and (
                        "Set" + method[3:] not in methods):
                    self.assertEqual(getattr(thing, method)(), 0, method)

    def test_objects(self):
        """Changes of an object change the time of its owner."""
        for owner, name, thing, change in (
                (vtkRefractedGeometryFilter(), "Camera", vtkCamera(),
                 lambda camera: camera.SetPosition(4, 5, 6)),
                (vtkRefractionErrorVolume(), "ExactMembrane", vtkSphere(),
                 lambda sphere: sphere.SetRadius(7))):
            getattr(owner, "Set" + name)(thing)
            self.assertIs(getattr(owner, "Get" + name)(), thing)
            before = owner.GetMTime()
            change(thing)
            self.assertGreater(owner.GetMTime(), before)
            getattr(owner, "Set" + name)(None)

    def test_arrays(self):
        """The integral is on and the others are off; a change modifies the filter."""
        rays = vtkTetrahedraRayIntegral()
        arrays = rays.GetArraySelection()
        enabled = [arrays.GetArrayName(i) for i in range(arrays.GetNumberOfArrays())
                   if arrays.GetArraySetting(i)]
        self.assertEqual(enabled, ["Integral"])
        before = rays.GetMTime()
        arrays.EnableArray("MaximumDepth")
        self.assertGreater(rays.GetMTime(), before)


if __name__ == "__main__":
    unittest.main()
