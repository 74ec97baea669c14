# SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
# SPDX-License-Identifier: BSD-3-Clause
"""The rivals of the papers win and lose where Documentation/refraction-measurements.md and
volume-measurements.md say. Errors are the same on every machine; processor times are compared in
one run, where the pages' figures differ by a factor of two at least. Arguments: the build tree, a
mesh (blunt_fin.vtu). Skipped (125) without a display or the mesh."""
import json
import os
import pathlib
import re
import subprocess
import sys
import tempfile
import unittest

SKIPPED = 125
MESH = pathlib.Path(sys.argv.pop(2))
PROGRAMS = pathlib.Path(sys.argv.pop(1)) / "bin"
ROUNDING = 0.0015  # RMS error of a picture that is rounded to 8 bits


def run(*command):
    result = subprocess.run([str(word) for word in command], stdout=subprocess.PIPE,
                            stderr=subprocess.PIPE, text=True)
    if result.returncode:
        raise RuntimeError(result.stdout + result.stderr)
    return result.stdout


class Refraction(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        with tempfile.TemporaryDirectory() as folder:
            text = run(PROGRAMS / "meniscus_benchmark_refraction", "--rivals", folder)
            cls.charts = sorted(os.listdir(folder))
        cls.scenes = {}
        scene = None
        for line in text.splitlines():
            title = re.match(r"The well below (\w+)", line)
            scene = title.group(1) if title else scene
            words = line.split(" | ")
            if len(words) == 5:
                points = cls.scenes.setdefault(scene, {}).setdefault(words[0], [])
                points.append((words[1], float(words[2]), float(words[3]), int(words[4])))

    def errors(self, scene, rival):
        return [point[2] for point in self.scenes[scene][rival]]

    def time_to(self, scene, rival, error):
        """Least processor time of a setting whose error is at most that."""
        return min(point[1] for point in self.scenes[scene][rival] if point[2] <= error)

    def test_charts(self):
        self.assertEqual(self.charts, ["rivals-flat.png", "rivals-pool.png"])

    def test_facets_do_not_help_maps(self):
        for rival, error in (("refraction mapping", 150.0), ("warped backdrop", 10.0)):
            errors = self.errors("waves", rival)
            self.assertGreater(min(errors), error, rival)
            self.assertLess(max(errors) / min(errors), 1.1, rival)

    def test_maps_cover_other_pixels(self):
        for scene in ("waves", "flat"):
            for rival in ("refraction mapping", "warped backdrop"):
                for point in self.scenes[scene][rival]:
                    self.assertGreater(point[3], 0.07 * 512 * 512, (scene, rival))

    def test_matrix(self):
        """The cheapest way; wrong below waves, and by half a pixel below flat water."""
        (waves,), (flat,) = (self.errors(scene, "one matrix (Diefenbach)")
                             for scene in ("waves", "flat"))
        self.assertTrue(9.0 < waves < 11.0, waves)
        self.assertTrue(0.5 < flat < 0.7, flat)
        for rival in set(self.scenes["waves"]) - {"one matrix (Diefenbach)"}:
            least = min(point[1] for point in self.scenes["waves"][rival])
            self.assertLess(self.scenes["waves"]["one matrix (Diefenbach)"][0][1], least, rival)

    def test_curved_patches_beat_flat_facets(self):
        curved = self.errors("waves", "curved, first image")
        flat = self.errors("waves", "flat facets")
        for few, many in zip(curved[1:3], flat[2:4]):
            self.assertLess(many, few)  # four times the facets are enough
        for same_curved, same_flat in zip(curved[1:4], flat[1:4]):
            self.assertLess(same_curved, 0.6 * same_flat)
        self.assertLess(max(self.errors("flat", "curved, first image")), 2e-3)
        self.assertGreater(min(self.errors("flat", "flat facets")), 0.3)

    def test_tracer(self):
        """Virtual geometry is cheaper at half a pixel; the tracer is the most accurate."""
        for error in (2.0, 0.4):
            self.assertLess(self.time_to("waves", "curved, first image", error),
                            self.time_to("waves", "Embree tracer", error), error)
        best = min(self.errors("waves", "Embree tracer"))
        for rival in set(self.scenes["waves"]) - {"Embree tracer"}:
            self.assertGreater(min(self.errors("waves", rival)), best, rival)
        self.assertLess(self.errors("flat", "Embree tracer")[0], 1e-4)


class Volume(unittest.TestCase):
    @classmethod
    def measure(cls, *options):
        with tempfile.TemporaryDirectory() as folder:
            file = pathlib.Path(folder) / "figures.json"
            run(PROGRAMS / "meniscus_benchmark_volume", "--views", "1", "--error-views", "1",
                "--repetitions", "2", "--set-up", "0", "--json", file, *options)
            with open(file) as opened:
                return {f["name"]: f for f in json.load(opened)["mappers"] if "fate" not in f}

    @classmethod
    def setUpClass(cls):
        cls.figures = cls.measure(
            "--mesh", MESH, "--size", "128", "--probe-seconds", "0", "--mappers",
            "projected,raycast/linear,raycast/homogeneous,raycast/pre,resampled,"
            "native/exact$,native/pre-integrated")

    def rms(self, name):
        return self.figures[name]["error_8_bit"]["rms"]

    def test_rivals_are_wrong_by_more_than_rounding(self):
        self.assertLess(self.rms("meniscus/native/exact"), 1.1 * ROUNDING)
        for name in self.figures:
            if not name.startswith("meniscus"):
                self.assertGreater(self.rms(name), 2.0 * ROUNDING, name)

    def test_tables_converge_to_the_exact_integral(self):
        names = [f"meniscus/native/{name}" for name in (
            "pre-integrated/64x16", "pre-integrated", "pre-integrated/512x64", "exact")]
        errors = [self.figures[name]["error_float"]["rms"] for name in names]
        for coarse, fine in zip(errors, errors[1:]):
            self.assertLess(fine, 0.5 * coarse, errors)
        # The segments are so short that a table without lengths is as good.
        plain = self.figures["meniscus/native/pre-integrated/256x1"]["error_float"]["rms"]
        self.assertLess(plain, 1.5 * errors[1])

    def test_more_points_of_an_image_do_not_help_in_the_end(self):
        self.assertGreater(self.rms("resampled/256"), self.rms("resampled/128"))

    def test_native_frames_take_less_time(self):
        ours = self.figures["meniscus/native/exact"]["cpu_ms"]
        for name in ("projected", "raycast/linear", "raycast/pre-integration",
                     "raycast/homogeneous"):
            self.assertGreater(self.figures[name]["cpu_ms"], 2.0 * ours, name)

    def test_z_sweep(self):
        figures = self.measure("--cubes", "8", "--size", "64", "--zsweep", "--mappers",
                               "zsweep,native/exact$")
        self.assertIn("zsweep", figures)
        self.assertGreater(figures["zsweep"]["error_8_bit"]["rms"], 10.0 * ROUNDING)
        self.assertLess(figures["meniscus/native/exact"]["error_8_bit"]["rms"], 1.1 * ROUNDING)


class Paper(unittest.TestCase):
    def test_views_and_steps(self):
        """Figs. 7 and 8 of Weiler et al.: frames take as long as their steps, and the mapper takes
        the steps that the reference counts."""
        with tempfile.TemporaryDirectory() as folder:
            text = run(PROGRAMS / "meniscus_benchmark_volume", "--paper", folder, "--mesh", MESH,
                       "--function", "opaque", "--size", "256", "--repetitions", "8")
            self.assertEqual(sorted(os.listdir(folder)), ["paper-steps.png", "paper-views.png"])
        self.assertGreater(float(re.search(r"correlation ([\d.]+)", text).group(1)), 0.8, text)
        counts = re.findall(r"([\d.e+]+) (?:steps of the reference )?\(mapper: ([\d.e+]+)\)", text)
        self.assertEqual(len(counts), 2, text)
        for reference, mapper in counts:
            # Rays that graze an edge may take a step more.
            self.assertLess(abs(float(mapper) / float(reference) - 1.0), 1e-4, text)
        whole, early = (float(mapper) for _, mapper in counts)
        self.assertLess(early, 0.5 * whole)


if __name__ == "__main__":
    if "DISPLAY" not in os.environ or not MESH.exists():
        print("SKIPPED: no display, or no mesh")
        sys.exit(SKIPPED)
    unittest.main()
