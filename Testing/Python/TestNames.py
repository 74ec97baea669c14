# SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
# SPDX-License-Identifier: BSD-3-Clause
"""Few public names: those that each class adds to its superclass are counted, and enumerations that
mean the same have the same numbers."""
import unittest

import meniscus

# Largest numbers of names of classes.
LIMITS = {
    "vtkTetrahedraRayCastMapper": 100,
    "vtkTetrahedraRayIntegral": 70,
    "vtkRefractedGeometryFilter": 70,
}
LIMIT_OF_OTHERS = 55


def classes():
    return {name: kind for name, kind in vars(meniscus).items()
            if name.startswith("vtk") and isinstance(kind, type)}


def own_names(kind):
    inherited = set(dir(kind.__mro__[1]))
    return [name for name in dir(kind) if name not in inherited and callable(getattr(kind, name))]


class TestNames(unittest.TestCase):
    def test_count(self):
        for name, kind in classes().items():
            names = own_names(kind)
            self.assertLessEqual(
                len(names), LIMITS.get(name, LIMIT_OF_OTHERS), "%s: %s" % (name, names))

    def test_no_limits_of_numbers(self):
        """Setters limit their numbers without methods for the limits."""
        for name, kind in classes().items():
            for method in own_names(kind):
                self.assertNotRegex(method, r"^Get\w+M(in|ax)Value$", name)

    def test_equal_numbers(self):
        """Constants of one name have one number, except in states of points, which are values of
        arrays."""
        numbers = {}
        for name, kind in classes().items():
            for constant, value in vars(kind).items():
                if constant.isupper() and isinstance(value, int) and constant != "NOT_FINITE":
                    numbers.setdefault(constant, {})[name] = int(value)
        self.assertGreater(len(numbers), 30)
        for constant, found in numbers.items():
            if constant != "PARALLEL":  # rays of an image, and rays without a common point
                self.assertEqual(len(set(found.values())), 1, (constant, found))

    def test_equal_places(self):
        """Depths that frames write are places of the picker."""
        mapper, picker = meniscus.vtkTetrahedraRayCastMapper, meniscus.vtkTetrahedraVolumePicker
        self.assertEqual(mapper.FIRST_VISIBLE_DEPTH, picker.FIRST_VISIBLE)
        self.assertEqual(mapper.OPACITY_DEPTH, picker.OPACITY_REACHED)


if __name__ == "__main__":
    unittest.main()
