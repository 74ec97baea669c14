# SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
# SPDX-License-Identifier: BSD-3-Clause
"""scripts/bundle lists the files of its archive, meniscus_report reports programs whose results are
known, and scripts/check_report.py finds the gaps of a report. Arguments: the root of the project,
the build tree; skipped (125) where the system lacks a part of the archive."""
import base64
import copy
import json
import os
import pathlib
import struct
import subprocess
import sys
import tempfile
import unittest
import zlib

SKIPPED = 125
BUILD = pathlib.Path(sys.argv.pop(2))
ROOT = pathlib.Path(sys.argv.pop(1))
BACKENDS = ("opengl", "compute", "native")
TESTS = ("numeric, fragment shader", "numeric, compute shader", "numeric, native", "kernel",
         "reference", "filters")
SYSTEM = ("/usr/bin/Xvfb", "/usr/bin/xkbcomp", "/usr/lib/x86_64-linux-gnu/dri/swrast_dri.so",
          "/usr/lib/x86_64-linux-gnu/libEGL_mesa.so.0")
PROGRAMS = ("meniscus_report", "meniscus_benchmark_volume", "meniscus_benchmark_refraction")


def run(*command):
    result = subprocess.run([str(word) for word in command], stdout=subprocess.PIPE,
                            stderr=subprocess.STDOUT, text=True)
    return result.returncode, result.stdout


class Bundle(unittest.TestCase):
    def test_usage(self):
        status, text = run(ROOT / "scripts/bundle", "--help")
        self.assertEqual(status, 0)
        for option in ("--build", "--data", "--output", "--list", "--check"):
            self.assertIn(option, text)
        self.assertEqual(run(ROOT / "scripts/bundle", "--nonsense")[0], 2)

    def test_missing_folders_and_files(self):
        for arguments in (("--data", "/nonexistent", "--list"), ("--check", "/nonexistent"),
                          ("--list", "--build", "/nonexistent")):
            status, text = run(ROOT / "scripts/bundle", "--build", BUILD, *arguments)
            self.assertNotEqual(status, 0, arguments)
            self.assertIn("error: ", text)

    def test_list(self):
        status, text = run(ROOT / "scripts/bundle", "--build", BUILD, "--list")
        self.assertEqual(status, 0, text)
        names = text.split("\n")
        for name in PROGRAMS:
            self.assertIn("bin/" + name, names)
        for start in ("lib/libvtkMeniscus.so.", "lib/libvtkRenderingOpenGL2-", "lib/libX11.so.",
                      "lib/libXext.so.", "lib/libGLX.so.", "gcc/libstdc++.so.", "gcc/libgcc_s.so.",
                      "mesa/libLLVM-", "mesa/libGLX_mesa.so.", "mesa/libglapi.so.",
                      "mesa/dri/swrast_dri.so", "x11/Xvfb", "x11/xkbcomp", "x11/xkb",
                      "x11/lib/libXfont2.so."):
            self.assertTrue([name for name in names if name.startswith(start)], start)
        base = [name.split("/")[-1] for name in names]
        for start in ("libc.so", "libm.so", "ld-linux", "libpthread.so", "libdl.so"):
            self.assertFalse([name for name in base if name.startswith(start)], start)
        libraries = [name for name in base if ".so." in name]
        self.assertEqual(len(libraries), len(set(libraries)), "a library is carried twice")

    def test_start_scripts(self):
        for name in ("run.sh", "unpack.sh"):
            self.assertEqual(run("sh", "-n", ROOT / "Benchmarks/Report" / name)[0], 0)
        status, text = run("sh", ROOT / "Benchmarks/Report/unpack.sh", "--help")
        self.assertEqual(status, 0)
        self.assertIn("unpacks into DIRECTORY", text)

    def test_report_program(self):
        program = BUILD / "bin/meniscus_report"
        status, text = run(program, "--help")
        self.assertEqual(status, 0)
        self.assertIn("--quick", text)
        with tempfile.TemporaryDirectory() as folder:
            (pathlib.Path(folder) / "old").write_text("")
            status, text = run(program, "--output", folder)
            self.assertEqual(status, 1)
            self.assertIn("not empty", text)


def picture(colors):
    """A PNG file of one row of grey pixels."""
    def chunk(kind, data):
        return (struct.pack(">I", len(data)) + kind + data +
                struct.pack(">I", zlib.crc32(kind + data)))
    return (b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">IIBBBBB", 64, 1, 8, 0, 0, 0, 0)) +
            chunk(b"IDAT", zlib.compress(b"\0" + bytes(colors))) + chunk(b"IEND", b""))


# Programs in place of the carried ones, which take a moment. Of the tests one fails, one is skipped
# and one ends its process.
STAND_IN_TESTS = """#!/usr/bin/python3
import os, signal, sys
if "--gtest_list_tests" in sys.argv:
    print("Suite.\\n  Passes\\n  Fails\\n  Skips\\n  Crashes\\n  DISABLED_No\\nOther.  # typed")
    print("  Passes/0  # GetParam() = 3")
    sys.exit()
chosen = [word[15:].split(":") for word in sys.argv if word.startswith("--gtest_filter=")][0]
for name in chosen:
    print("[ RUN      ] " + name, flush=True)
    if "Crashes" in name:
        os.kill(os.getpid(), signal.SIGSEGV)
    if "Skips" in name:
        print("file.cxx:1: Skipped\\nno data")
    mark = "  FAILED  " if "Fails" in name else "  SKIPPED " if "Skips" in name else "       OK "
    print("[" + mark + "] " + name + " (3 ms)", flush=True)
print("[  FAILED  ] Suite.Fails")
sys.exit(1)
"""
STAND_IN_BENCHMARK = """#!/usr/bin/python3
import base64, json, os, sys
words = sys.argv[1:]
if "--device" in words:
    print("GL_RENDERER: stand-in\\nGL_VERSION: 1\\nVTK: 9")
    sys.exit()
if os.environ.get("FAULT", "none") in " ".join(words):
    sys.exit(3)
value = {words[i]: words[i + 1] for i in range(len(words) - 1)}
names = [name.strip("$") for name in value.get("--mappers", "").split(",")]
figures = {"mappers": [{"name": name, "ms_per_frame": 1.0, "error_float": {"max": 1e-6}}
                       for name in names]}
if "--pass" in words:
    rows = [{"mode": "m", "frames_per_second": 1.0}]
    figures = {"well": rows, "pass": rows, "pool": {"pass_ms": 1.0}}
    print("| the pass |")
json.dump(figures, open(value["--json"], "w"))
for key in ("--rows", "--error-rows"):
    if key in value:
        open(value[key], "a").write("| row |\\n")
if "--picture" in value:
    start = value["--picture"]
    ends = [""] if "--pass" in words else ["-" + name.replace("/", "-") + ".png" for name in names]
    for end in ends:
        open(start + end, "wb").write(base64.b64decode("PICTURE"))
"""


def volume(*names):
    return {"figures": {"mappers": [
        {"name": name, "ms_per_frame": 1.0, "error_float": {"max": 1e-6}} for name in names]}}


def complete_report():
    ours = [f"meniscus/{backend}/exact" for backend in BACKENDS]
    frames = {}
    for window in ("512x512", "1920x1080", "3840x2160"):
        for mode in ("composite", "lit", "isosurface", "membrane"):
            names = ours + (["projected"] if mode == "composite" else [])
            frames[f"frames-{window}-{mode}"] = volume(*names)
    machine = ("GL_RENDERER", "GL_VERSION", "processor", "memory, GiB", "VTK", "driver", "date")
    rows = [{"mode": "m", "frames_per_second": 1.0}]
    return {
        "quick": False, "complete": True, "missing": [],
        "machine": {name: "x" for name in machine},
        "left_out": [{"name": f"mesh-30M-{backend}", "reason": "memory"} for backend in BACKENDS],
        "tests": [{"name": name, "tests": 3, "passed": 2, "failed": [], "crashed": [],
                   "skipped": [{"name": "a", "note": ""}], "not_run": 0} for name in TESTS],
        "errors": {"errors-block-smooth": volume(*ours)}, "frames": frames,
        "meshes": {f"mesh-{mesh}-{backend}": volume(f"meniscus/{backend}/exact")
                   for mesh in ("3M", "10M") for backend in BACKENDS},
        "refraction": {"refraction": {"figures": {
            "well": rows, "pass": rows, "pool": {"pass_ms": 1.0}}}}}


class StandIns(unittest.TestCase):
    """meniscus_report with programs whose results are known."""

    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.root = pathlib.Path(self.folder.name)
        benchmark = STAND_IN_BENCHMARK.replace(
            "PICTURE", base64.b64encode(picture(range(64))).decode())
        for name in ("rendering_numeric_tests", "kernel_tests", "volume_reference_tests",
                     "filter_tests", "benchmark_volume", "benchmark_refraction"):
            program = self.root / ("meniscus_" + name)
            program.write_text(STAND_IN_TESTS if name.endswith("tests") else benchmark)
            program.chmod(0o755)
        (self.root / "data").mkdir()
        for name in ("combustor.vtu", "blunt_fin.vtu"):
            (self.root / "data" / name).write_text("")

    def tearDown(self):
        self.folder.cleanup()

    def report(self, fault, *arguments):
        """Exit status, the report's JSON, the faults that its check finds."""
        output = self.root / "out"
        result = subprocess.run(
            [str(BUILD / "bin/meniscus_report"), "--programs", str(self.root), "--data",
             str(self.root / "data"), "--driver", "none", "--output", str(output), *arguments],
            stdout=subprocess.PIPE, stderr=subprocess.STDOUT, env={**os.environ, "FAULT": fault})
        report = json.loads((output / "report.json").read_text())
        faults = run(sys.executable, "-B", ROOT / "scripts/check_report.py", output)[1]
        return result.returncode, report, faults

    def test_all(self):
        status, report, faults = self.report("none")
        self.assertEqual(status, 2)
        self.assertTrue(report["complete"])
        self.assertEqual(report["failed_tests"], 12)
        for entry in report["tests"]:
            self.assertEqual((entry["tests"], entry["passed"], entry["not_run"]), (6, 2, 1))
            self.assertEqual([test["name"] for test in entry["failed"]], ["Suite.Fails"])
            self.assertEqual([test["name"] for test in entry["crashed"]], ["Suite.Crashes"])
            self.assertEqual(entry["crashed"][0]["note"], "ended by signal 11")
            self.assertEqual([test["note"] for test in entry["skipped"]],
                             ["file.cxx:1: Skipped no data"])
        # The check names the failures, and the test that is disabled; nothing else is amiss.
        self.assertEqual({line.split(": ")[1].split(" ")[0] for line in faults.strip().split("\n")},
                         {"Suite.Fails", "Suite.Crashes", "1"})
        self.assertIn("errors-blunt_fin-smooth", report["errors"])
        page = (self.root / "out/report.md").read_text()
        self.assertLess(page.index("| the pass |"), page.index("pictures/pool.png"))

    def test_quick(self):
        status, report, faults = self.report("none", "--quick")
        self.assertEqual((status, faults), (0, ""))
        self.assertEqual([entry["not_run"] for entry in report["tests"]], [5] * 6)
        left_out = [entry["name"] for entry in report["left_out"]]
        self.assertIn("frames-3840x2160-composite", left_out)
        self.assertIn("frames-1920x1080-composite", report["frames"])

    def test_part_that_fails(self):
        status, report, faults = self.report("--pass", "--quick")
        self.assertEqual(status, 1)
        self.assertFalse(report["complete"])
        self.assertEqual([entry["name"] for entry in report["missing"]],
                         ["refraction", "picture pool.png"])
        self.assertEqual(report["missing"][0]["reason"], "exit status 3")
        self.assertIn("missing: refraction: exit status 3", faults)


class Report(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.root = pathlib.Path(self.folder.name)
        (self.root / "pictures").mkdir()
        names = [f"pictures/{i}.png" for i in range(13)]
        for name in names:
            (self.root / name).write_bytes(picture(range(64)))
        self.page = "# Report\n" + "".join(f"\n## {heading}\n" for heading in (
            "Machine", "Tests", "Errors", "Frames", "Large meshes", "Refraction", "Left out",
            "Missing")) + "".join(f"![]({name})\n" for name in names)

    def tearDown(self):
        self.folder.cleanup()

    def check(self, report, page=None):
        (self.root / "report.json").write_text(json.dumps(report))
        (self.root / "report.md").write_text(self.page if page is None else page)
        return run(sys.executable, "-B", ROOT / "scripts/check_report.py", self.root)

    def expect_fault(self, part, change):
        report = copy.deepcopy(complete_report())
        change(report)
        status, text = self.check(report)
        self.assertEqual(status, 1, part)
        self.assertIn(part, text)

    def test_complete(self):
        self.assertEqual(self.check(complete_report()), (0, ""))

    def test_gaps(self):
        self.expect_fault("machine: no GL_RENDERER", lambda r: r["machine"].pop("GL_RENDERER"))
        self.expect_fault("no tests: numeric, native", lambda r: r["tests"].pop(2))
        self.expect_fault("outcomes", lambda r: r["tests"][0].update(tests=4))
        self.expect_fault("no test passed", lambda r: r["tests"][1].update(passed=0, tests=1))
        self.expect_fault("were not run", lambda r: r["tests"][3].update(not_run=1, tests=4))
        self.expect_fault("b failed: c", lambda r: r["tests"][0].update(
            failed=[{"name": "b", "note": "c"}], tests=4))
        self.expect_fault("no errors", lambda r: r["errors"].clear())
        self.expect_fault("no frames-3840x2160-lit", lambda r: r["frames"].pop(
            "frames-3840x2160-lit"))
        self.expect_fault("no ms_per_frame of projected", lambda r: r["frames"].update(
            {"frames-512x512-composite": volume("meniscus/opengl/exact", "meniscus/native/exact",
                                                "meniscus/compute/exact")}))
        self.expect_fault("no mesh-30M-native", lambda r: r["left_out"].pop())
        self.expect_fault("out of memory", lambda r: r["meshes"].update(
            {"mesh-3M-native": {"missing": "out of memory"}}))
        self.expect_fault("no frames of pass", lambda r: r["refraction"]["refraction"][
            "figures"].pop("pass"))
        self.expect_fault("missing: x: y", lambda r: r["missing"].append(
            {"name": "x", "reason": "y"}))
        self.expect_fault("incomplete", lambda r: r.update(complete=False))
        self.expect_fault("cannot be read", lambda r: r.pop("tests"))

    def test_pictures_and_headings(self):
        (self.root / "pictures/3.png").write_bytes(picture([7] * 64))
        self.assertIn("pictures/3.png", self.check(complete_report())[1])
        (self.root / "pictures/3.png").unlink()
        self.assertEqual(self.check(complete_report())[0], 1)
        status, text = self.check(complete_report(), self.page.replace("## Tests", "## Proofs"))
        self.assertEqual(status, 1)
        self.assertIn("no heading Tests", text)


if __name__ == "__main__":
    lacking = [name for name in SYSTEM if not pathlib.Path(name).exists()]
    lacking += [name for name in PROGRAMS if not (BUILD / "bin" / name).exists()]
    if lacking:
        print("skipped: there is no " + ", ".join(lacking))
        sys.exit(SKIPPED)
    unittest.main()
