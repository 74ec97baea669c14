#!/usr/bin/env python3
"""usage: Benchmarks/compare.py BEFORE AFTER [--rounds N] [--part PART] [--json FILE]

Compares the benchmarks of two build trees on one machine. BEFORE and AFTER are build folders; their
programs run in turns, in alternating order, and each row takes the smallest processor time of all
rounds, because disturbances only add time. Prints a table in Markdown and exits with 1 if a row of
AFTER is more than 3 % slower. PART is one of these; default: all.

  volume      frames and set-up, also behind waves
  changes     turning at 1920 x 1080, shadows and opacity that change, first frames, divided cells
  steps       time steps
  refraction  filters
  picture     the command `meniscus` from its start to the end of a picture, if both trees have the
              Python package; it needs a Python with their VTK

Parts that a tree is too old for are left out. Meshes are taken from the folder that
MENISCUS_DATA_DIR names, or from ../shared/data next to the clone; without them only a generated
block or the demo is used. Needs a display.
"""
import argparse
import json
import os
import pathlib
import resource
import subprocess
import sys
import tempfile

SLOWER = 1.03
PARTS = ("volume", "changes", "steps", "refraction", "picture")
ROOT = pathlib.Path(__file__).resolve().parent.parent
BACKENDS = "meniscus/native/exact,meniscus/opengl/exact,meniscus/compute/exact"
# Rows of the growth of the refraction benchmark. Those of brute force take minutes and measure no
# code of ours.
PER_MEMBRANE = (
    "shape_s", "eye_s", "us_per_vertex_grid_order", "us_per_vertex_random_order", "curved_shape_s",
    "curved_deform_s", "curved_eye_s", "curved_us_per_vertex_one_image",
    "curved_us_per_vertex_all_images")


def run(command):
    """Runs a program of a build tree and returns the JSON that it writes."""
    with tempfile.TemporaryDirectory() as folder:
        name = os.path.join(folder, "figures.json")
        result = subprocess.run(
            [*command, "--json", name],
            stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True)
        if result.returncode != 0 or not os.path.exists(name):
            sys.exit("failed: " + " ".join(command) + "\n" + result.stderr)
        with open(name, encoding="utf-8") as file:
            return json.load(file)


def find_meshes():
    """Files of the data meshes, by name."""
    data = pathlib.Path(os.environ.get("MENISCUS_DATA_DIR", ROOT.parent / "shared" / "data"))
    files = {name: data / (name + ".vtu") for name in ("blunt_fin", "combustor")}
    return {name: str(file) for name, file in files.items() if file.exists()}


def volume_meshes():
    """Arguments of the volume benchmark per mesh."""
    return [("block", []), *((name, ["--mesh", file]) for name, file in find_meshes().items())]


def volume_cases():
    """Arguments of the volume benchmark per case."""
    for mesh, arguments in volume_meshes():
        for function in ("smooth", "opaque", "sparse"):
            yield f"{mesh}, {function}", [*arguments, "--function", function]
        yield f"{mesh}, behind waves", [*arguments, "--mode", "membrane"]


def writes_times(build):
    """True if the volume benchmark of a build tree writes times of changes and steps."""
    program = str(build / "bin/meniscus_benchmark_volume")
    usage = subprocess.run([program, "--help"], stdout=subprocess.PIPE, text=True).stdout
    return "--changes" in usage


def measure_times(build, option, *arguments):
    """Processor milliseconds by row, of an option of the volume benchmark that prints them."""
    rows = {}
    for mesh, of_mesh in volume_meshes():
        figures = run([str(build / "bin/meniscus_benchmark_volume"), option, *of_mesh, *arguments])
        rows.update({f"{mesh}: {name} (ms)": value for name, value in figures.items()})
    return rows


def measure_volume(build, arguments):
    """Processor milliseconds per frame by mapper; the least of all frames' views."""
    figures = run([
        str(build / "bin/meniscus_benchmark_volume"), *arguments, "--mappers", BACKENDS,
        "--views", "4", "--repetitions", "3", "--error-views", "0"])
    rows = {}
    for mapper in figures["mappers"]:
        if mapper["name"].endswith("/exact"):
            rows[mapper["name"] + " (ms)"] = mapper["cpu_ms"]
            rows[mapper["name"] + ", set-up (ms)"] = mapper["set_up_ms"]
    return rows


def measure_refraction(build):
    """Times by number of facets."""
    figures = run([str(build / "bin/meniscus_benchmark_refraction"), "--growth"])
    rows = {}
    for row in figures["growth"]:
        for name in PER_MEMBRANE:
            rows[f"{row['facets']} facets: {name}"] = row[name]
    for row in figures["vertices"]:
        name = "curved_us_per_vertex_one_image"
        rows[f"{row['vertices']} vertices: {name}"] = row[name]
    return rows


def package_of(build):
    """Folder of the Python package of a build tree."""
    return build.resolve() / "lib/python3/dist-packages"


def measure_pictures(build):
    """Processor seconds of the command for a picture of 1920 x 1080, from a file or the demo."""
    rows = {}
    environment = {**os.environ, "PYTHONPATH": str(package_of(build))}
    for name, mesh in {"demo": "demo", **find_meshes()}.items():
        with tempfile.TemporaryDirectory() as folder:
            before = resource.getrusage(resource.RUSAGE_CHILDREN)
            result = subprocess.run(
                [sys.executable, "-m", "meniscus", mesh, "--size", "1920x1080", "--output",
                 os.path.join(folder, "picture.png")],
                env=environment, stdout=subprocess.DEVNULL)
            if mesh == "demo" and result.returncode != 0:
                continue  # a tree from before the demo
            result.check_returncode()
            after = resource.getrusage(resource.RUSAGE_CHILDREN)
        rows[f"{name}: first picture (s)"] = (
            after.ru_utime - before.ru_utime + after.ru_stime - before.ru_stime)
    return rows


def compare(measure, before, after, rounds):
    """Smallest time of each row, of both trees."""
    best = ({}, {})
    for number in range(rounds):
        pair = [(0, before), (1, after)]
        for index, build in pair if number % 2 == 0 else reversed(pair):
            for name, value in measure(build).items():
                best[index][name] = min(value, best[index].get(name, value))
    return {name: (value, best[1][name]) for name, value in best[0].items() if name in best[1]}


def main():
    parser = argparse.ArgumentParser(usage=__doc__.replace("%", "%%"))
    parser.add_argument("before", type=pathlib.Path)
    parser.add_argument("after", type=pathlib.Path)
    parser.add_argument("--rounds", type=int, default=3)
    parser.add_argument("--part", choices=PARTS)
    parser.add_argument("--json")
    options = parser.parse_args()
    parts = [options.part] if options.part else PARTS
    rows = {}
    if "volume" in parts:
        for title, arguments in volume_cases():
            measured = compare(
                lambda build, a=arguments: measure_volume(build, a), options.before, options.after,
                options.rounds)
            rows.update({f"{title}: {name}": value for name, value in measured.items()})
    for part, arguments in (("changes", ["--size", "1920x1080"]), ("steps", [])):
        if part in parts and all(writes_times(tree) for tree in (options.before, options.after)):
            rows.update(compare(
                lambda build, p=part, a=arguments: measure_times(build, "--" + p, *a),
                options.before, options.after, options.rounds))
    if "refraction" in parts:
        rows.update(compare(measure_refraction, options.before, options.after, options.rounds))
    if "picture" in parts and all(
            package_of(build).exists() for build in (options.before, options.after)):
        rows.update(compare(measure_pictures, options.before, options.after, options.rounds))
    print("| row | before | after | after / before |\n|---|---|---|---|")
    slower = 0
    for name, (old, new) in rows.items():
        ratio = new / old if old > 0.0 else float("nan")
        slower += ratio > SLOWER
        mark = "**" if ratio > SLOWER else ""
        print(f"| {name} | {old:.4g} | {new:.4g} | {mark}{ratio:.3f}{mark} |")
    print(f"\n{slower} of {len(rows)} rows are more than 3 % slower.")
    if options.json:
        with open(options.json, "w", encoding="utf-8") as file:
            json.dump(rows, file, indent=1)
    return 1 if slower else 0


if __name__ == "__main__":
    sys.exit(main())
