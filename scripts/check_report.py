#!/usr/bin/env python3
"""usage: scripts/check_report.py FOLDER

Checks that a report of scripts/bundle's archive is complete: every test has an outcome and none
failed, every measurement is there or named as left out, and every picture exists and shows
something. Prints the faults and exits with 1 if there are any.
"""
import json
import math
import pathlib
import re
import struct
import sys
import zlib

BACKENDS = ("opengl", "compute", "native")
TESTS = ("numeric, fragment shader", "numeric, compute shader", "numeric, native", "kernel",
         "reference", "filters")
WINDOWS = ("512x512", "1920x1080", "3840x2160")
MODES = ("composite", "lit", "isosurface", "membrane")
MESHES = ("3M", "10M", "30M")
MACHINE = ("GL_RENDERER", "GL_VERSION", "processor", "memory, GiB", "VTK", "driver", "date")
# Fewer different bytes are those of a picture of one colour.
LEAST_BYTES = 16


def is_positive(value):
    return isinstance(value, (int, float)) and math.isfinite(value) and value > 0


def test_faults(report):
    """Faults of the tests' counts."""
    found = {entry["name"]: entry for entry in report["tests"]}
    for name in TESTS:
        if name not in found:
            yield "no tests: " + name
            continue
        entry = found[name]
        ran = entry["passed"] + sum(len(entry[key]) for key in ("failed", "skipped", "crashed"))
        if entry["tests"] != ran + entry["not_run"]:
            yield f"{name}: {entry['tests']} tests, but {ran} + {entry['not_run']} outcomes"
        if entry["passed"] < 1:
            yield name + ": no test passed"
        if entry["not_run"] and not report["quick"]:
            yield f"{name}: {entry['not_run']} tests were not run"
        for key in ("failed", "crashed"):
            for test in entry[key]:
                yield f"{name}: {test['name']} {key}: {test['note']}"


def mapper_faults(name, entry, wanted, key):
    """Faults of one run of the volume benchmark, whose mappers must have a figure."""
    if "figures" not in entry:
        yield f"{name}: {entry.get('missing', 'no figures')}"
        return
    mappers = {mapper["name"]: mapper for mapper in entry["figures"]["mappers"]}
    for mapper in wanted:
        figure = mappers.get(mapper, {})
        value = figure.get(key)
        value = value.get("max") if isinstance(value, dict) else value
        if not is_positive(value):
            yield f"{name}: no {key} of {mapper} ({figure.get('fate', 'not in the list')})"


def ours(*backends):
    return [f"meniscus/{backend}/exact" for backend in backends]


def measurement_faults(report):
    """Faults of errors, frames and meshes; what is left out must be named."""
    left_out = {entry["name"] for entry in report["left_out"]}
    if not report["errors"]:
        yield "no errors"
    for name, entry in report["errors"].items():
        yield from mapper_faults(name, entry, ours(*BACKENDS), "error_float")
    for window in WINDOWS:
        for mode in MODES:
            name = f"frames-{window}-{mode}"
            wanted = ours(*BACKENDS) + (["projected"] if mode == "composite" else [])
            if name in report["frames"]:
                yield from mapper_faults(name, report["frames"][name], wanted, "ms_per_frame")
            elif name not in left_out:
                yield "no " + name
    for mesh in MESHES:
        for backend in BACKENDS:
            name = f"mesh-{mesh}-{backend}"
            if name in report["meshes"]:
                yield from mapper_faults(
                    name, report["meshes"][name], ours(backend), "ms_per_frame")
            elif name not in left_out:
                yield "no " + name


def refraction_faults(report):
    figures = report["refraction"].get("refraction", {}).get("figures", {})
    for key in ("well", "pass"):
        rows = figures.get(key, [])
        if not rows or not all(is_positive(row["frames_per_second"]) for row in rows):
            yield f"refraction: no frames of {key}"
    if not is_positive(figures.get("pool", {}).get("pass_ms")):
        yield "refraction: no picture of the pool"


def shows_something(data):
    """True for a PNG file of more than one colour."""
    if not data.startswith(b"\x89PNG\r\n\x1a\n"):
        return False
    at = 8
    packed = b""
    while at + 8 <= len(data):
        length, kind = struct.unpack(">I4s", data[at:at + 8])
        if kind == b"IDAT":
            packed += data[at + 8:at + 8 + length]
        at += 12 + length
    return len(set(zlib.decompress(packed))) >= LEAST_BYTES


def page_faults(folder):
    page = (folder / "report.md").read_text(encoding="utf-8")
    for heading in ("Machine", "Tests", "Errors", "Frames", "Large meshes", "Refraction",
                    "Left out", "Missing"):
        if f"\n## {heading}\n" not in page:
            yield "report.md: no heading " + heading
    pictures = re.findall(r"\]\((pictures/[^)]+)\)", page)
    if len(pictures) < len(MODES) * len(BACKENDS) + 1:
        yield f"report.md: {len(pictures)} pictures"
    for name in pictures:
        if not (folder / name).exists() or not shows_something((folder / name).read_bytes()):
            yield f"{name} does not exist or shows nothing"


def faults(folder):
    report = json.loads((folder / "report.json").read_text(encoding="utf-8"))
    for name in MACHINE:
        if not report["machine"].get(name):
            yield "machine: no " + name
    yield from (f"missing: {entry['name']}: {entry['reason']}" for entry in report["missing"])
    if not report["complete"]:
        yield "the report calls itself incomplete"
    yield from test_faults(report)
    yield from measurement_faults(report)
    yield from refraction_faults(report)
    yield from page_faults(folder)


def main():
    if len(sys.argv) != 2 or sys.argv[1].startswith("-"):
        sys.exit(__doc__)
    try:
        found = list(faults(pathlib.Path(sys.argv[1])))
    except (OSError, ValueError, KeyError, TypeError) as error:
        found = [f"the report cannot be read: {error!r}"]
    for fault in found:
        print(fault)
    sys.exit(1 if found else 0)


if __name__ == "__main__":
    main()
