# SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
# SPDX-License-Identifier: BSD-3-Clause
"""usage: make_menagerie.py [FOLDER]
Writes small files in the manner of many programs into a folder (default: Testing/Data/Menagerie),
and expected.csv, a table of what each contains or of the error that it must cause.

The files are part of the repository: tests need neither this script nor its requirements, numpy,
h5py and netCDF4. It writes the same bytes in every run with the same versions of these."""
import csv
import os
import sys

import numpy

import other_files
import vtk_files
from meshes import (
    HEXAHEDRAL, LINE, MESHES, MIXED, QUAD, SURFACE, TETRA, TETRAHEDRAL, HEXAHEDRON, Mesh, join)

FOLDER = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "Data", "Menagerie")
BOX = (0, 2, 0, 1, 0, 1)
LEFT, RIGHT = HEXAHEDRAL.part([0]), HEXAHEDRAL.part([1])
ALL = "point T, point U, cell p"
# Columns of expected.csv. arrays: the arrays of the mesh. steps: number of time steps. error: a
# part of the command's message. needs: a Python package, a version of VTK or a feature of the
# mapper without which a file is not tested. mapper: yes if the test in C++ reads the file as well,
# damaged if it reads cells that must be left out.
COLUMNS = ("file", "volume", "bounds", "arrays", "steps", "error", "needs", "mapper")
# A feature of the mapper without which files are not tested yet.
LAGRANGE = ""
UTM = (512345.25, 5403210.5, 412.0)


class Menagerie:
    """Files in a folder and the rows of their table."""

    def __init__(self, folder):
        self.folder = folder
        self.rows = []

    def write(self, name, data):
        """Writes bytes or text to a file that other files use."""
        path = os.path.join(self.folder, name)
        os.makedirs(os.path.dirname(path), exist_ok=True)
        with open(path, "wb") as file:
            file.write(data.encode() if isinstance(data, str) else data)

    def path(self, name):
        """Path of a file or folder that a function will write."""
        path = os.path.join(self.folder, name)
        os.makedirs(os.path.dirname(path), exist_ok=True)
        return path

    def expect(self, file, volume=2, bounds=BOX, arrays=ALL, steps=1, needs="", mapper=""):
        """Adds a row for a mesh."""
        if not mapper:
            mapper = "yes" if file.endswith((".vtu", ".vtk", ".vti", ".vtr", ".vts", ".vtm",
                                             ".pvtu")) else "no"
        self.rows.append((file, "%.15g" % volume, " ".join("%.15g" % x for x in bounds), arrays,
                          steps, "", needs, mapper))

    def refuse(self, file, error, mapper="no"):
        """Adds a row for a file that cannot be drawn."""
        self.rows.append((file, 0, "", "", 0, error, "", mapper))

    def add(self, file, data, **expected):
        self.write(file, data)
        self.expect(file, **expected)

    def add_bad(self, file, data, error, mapper="no"):
        self.write(file, data)
        self.refuse(file, error, mapper)

    def save(self):
        with open(os.path.join(self.folder, "expected.csv"), "w", newline="") as file:
            table = csv.writer(file, delimiter="|", quoting=csv.QUOTE_NONE, lineterminator="\n")
            table.writerows([COLUMNS, *self.rows])


def add_cells(menagerie):
    """Each type of cell."""
    for name, mesh in MESHES.items():
        menagerie.add(f"cells/{name}.vtu", vtk_files.vtu(
            mesh, version="2.2", encoding="base64", header="Q"),
            needs=LAGRANGE if "lagrange" in name else "")
    menagerie.add("cells/mixed.vtu", vtk_files.vtu(MIXED))
    menagerie.add("cells/no-arrays.vtu", vtk_files.vtu(HEXAHEDRAL.with_arrays()),
                  arrays="cell uniform", mapper="no")
    unused = HEXAHEDRAL.with_points([(-7, 0, 0), (0, 0, 50)])
    menagerie.add("cells/unused-points.vtu", vtk_files.vtu(unused))


def add_encodings(menagerie):
    """Each encoding of VTK's files."""
    mesh = TETRAHEDRAL
    for name, options in {
            "ascii": {}, "base64": {"encoding": "base64"}, "raw": {"encoding": "raw"},
            "appended-base64": {"encoding": "appended base64"},
            "raw-64-bit-header": {"encoding": "raw", "header": "Q"},
            "raw-zlib": {"encoding": "raw", "compressor": "vtkZLibDataCompressor"},
            "base64-zlib": {"encoding": "base64", "compressor": "vtkZLibDataCompressor"},
            "raw-lz4": {"encoding": "raw", "compressor": "vtkLZ4DataCompressor", "header": "Q"},
            "appended-base64-lzma": {"encoding": "appended base64",
                                     "compressor": "vtkLZMADataCompressor"},
            "raw-big-endian": {"encoding": "raw", "big": True},
            "base64-big-endian-64-bit": {"encoding": "base64", "big": True, "header": "Q"},
            "raw-zlib-big-endian": {"encoding": "raw", "big": True,
                                    "compressor": "vtkZLibDataCompressor"},
            "32-bit-indices-float-points": {"ids": "i4", "points": "f4"}}.items():
        menagerie.add(f"encodings/{name}.vtu", vtk_files.vtu(mesh, **options))
    arrays = {"mass": numpy.arange(12, dtype="i4"), "flag": numpy.arange(12, dtype="u1") % 2}
    menagerie.add("encodings/integers.vtu", vtk_files.vtu(mesh.with_arrays({}, arrays)),
                  arrays="cell mass, cell flag")
    for name, options in {"ascii": {}, "binary": {"binary": True}, "version-5": {
            "version": "5.1"}, "version-5-binary": {"version": "5.1", "binary": True}}.items():
        menagerie.add(f"encodings/legacy-{name}.vtk", vtk_files.legacy(mesh, **options))
    menagerie.add("encodings/legacy-scalars.vtk", vtk_files.legacy(HEXAHEDRAL, scalars="T"))


def add_structured(menagerie):
    for ending, kind in ((".vti", "ImageData"), (".vtr", "RectilinearGrid"),
                         (".vts", "StructuredGrid")):
        menagerie.add("structured/box" + ending, vtk_files.structured(kind, encoding="base64"),
                      arrays="point T, cell p")
    menagerie.add("structured/hidden-half.vts", vtk_files.structured(
        "StructuredGrid", ghosts=[0, 32]), volume=1, bounds=(0, 1, 0, 1, 0, 1),
        arrays="point T, cell p")
    menagerie.add_bad("structured/flat.vti", vtk_files.structured("ImageData", (3, 2, 1)),
                      "no cells with a volume; its cells are: 2 Pixel")


def add_programs(menagerie):
    """Files in the manner of programs."""
    # dolfinx: Lagrange cells of all orders, a .pvd of .pvtu files, numbers as text.
    for order in (1, 2, 3):
        mesh = MESHES[f"lagrange-tetrahedra-{order}"].with_arrays(
            {"T": MESHES[f"lagrange-tetrahedra-{order}"].point_data["T"],
             "vtkOriginalPointIds": numpy.arange(len(MESHES[
                 f"lagrange-tetrahedra-{order}"].points))},
            {"vtkGhostType": numpy.zeros(12, "u1")})
        name = f"dolfinx{order}"
        menagerie.write(f"dolfinx/{name}_p0_000000.vtu", vtk_files.vtu(mesh, version="2.2"))
        menagerie.write(f"dolfinx/{name}_000000.pvtu",
                        vtk_files.pvtu(mesh, [f"{name}_p0_000000.vtu"]))
        menagerie.add(f"dolfinx/{name}.pvd", vtk_files.collection(
            [{"timestep": 0, "part": 0, "file": f"{name}_000000.pvtu"}]), arrays="point T",
            needs=LAGRANGE)
    # MFEM: a folder per cycle, one piece per process, Lagrange hexahedra.
    for number, half in enumerate((LEFT, RIGHT)):
        mesh = Mesh(half.points, half.cells, [72]).with_arrays(
            {"T": half.point_data["T"]}, {"attribute": numpy.array([1 + number], "i4")})
        menagerie.write(f"mfem/Cycle000000/proc00000{number}.vtu", vtk_files.vtu(
            mesh, encoding="base64", version="2.2"))
    menagerie.write("mfem/Cycle000000/data.pvtu", vtk_files.pvtu(
        mesh, ["proc000000.vtu", "proc000001.vtu"]))
    menagerie.add("mfem/mfem.pvd", vtk_files.collection(
        [{"timestep": 0, "group": "", "part": 0, "file": "Cycle000000/data.pvtu"}]),
        arrays="point T, cell attribute", needs=LAGRANGE)
    gmsh = HEXAHEDRAL.with_cells(SURFACE.cells, QUAD)
    menagerie.add("gmsh/box.msh", other_files.gmsh(gmsh),
                  arrays="point T, cell gmsh:physical, cell gmsh:geometrical", needs="meshio")
    menagerie.add("gmsh/box.vtk", vtk_files.legacy(gmsh.with_cells([[0, 1]], LINE).with_arrays(
        {"T": HEXAHEDRAL.point_data["T"]}, {"CellEntityIds": numpy.ones(15, "i4")})),
        arrays="point T, cell CellEntityIds")
    menagerie.add("abaqus/box.inp", other_files.abaqus(HEXAHEDRAL), arrays="cell BOX",
                  needs="meshio")
    menagerie.add("xdmf/mesh.xdmf", other_files.xdmf(TETRAHEDRAL), arrays="point T",
                  needs="meshio h5py")
    menagerie.add("xdmf/steps.xdmf", other_files.xdmf(TETRAHEDRAL, (0.0, 0.5, 2.0)),
                  arrays="point T", steps=3, needs="meshio")
    menagerie.add("avs/box.inp", other_files.avs(HEXAHEDRAL),
                  arrays="point T, cell Material Id, cell p")
    menagerie.expect("openfoam/case.foam", arrays="point U, point p", steps=2)
    other_files.openfoam(menagerie.path("openfoam"), HEXAHEDRAL, (0, 1))
    for binary in (False, True):
        folder = "ensight-binary" if binary else "ensight"
        other_files.ensight(menagerie.path(folder), "box", HEXAHEDRAL, (0, 0.5, 2), binary)
        menagerie.expect(f"{folder}/box.case", steps=3)
    other_files.climate(menagerie.path("netcdf/air.nc"))
    menagerie.expect("netcdf/air.nc", arrays="point T, point q")


def add_exodus(menagerie):
    def write(name, mesh, blocks, times=(0.0, 1.0, 2.5)):
        x, y, z = mesh.points.T
        other_files.exodus(menagerie.path(name), blocks, mesh.points, {
            "T": lambda time: x + 2 * y + 3 * z + time, "s": lambda time: time * x}, {
            "p": lambda time, block: time + block}, times)

    wedges = MESHES["wedges"]
    both = join([LEFT, wedges.part([2, 3])])
    write("exodus/blocks.e", both, [(HEXAHEDRON, both.cells[:1]), (wedges.types[0],
                                                                   both.cells[1:])])
    menagerie.expect("exodus/blocks.e", arrays="point T, point s, cell p", steps=3)
    quadratic = MESHES["quadratic-tetrahedra"]
    write("exodus/quadratic.exo", quadratic, [(quadratic.types[0], quadratic.cells)], (0.0,))
    menagerie.expect("exodus/quadratic.exo", arrays="point T, point s, cell p")
    for number, half in enumerate((LEFT, RIGHT)):
        write(f"exodus/decomposed.e.2.{number}", half, [(HEXAHEDRON, half.cells)])
    menagerie.expect("exodus/decomposed.e.2.0", arrays="point T, point s, cell p", steps=3)


def add_hdf(menagerie):
    other_files.cgns(menagerie.path("cgns/cells.cgns"),
                     {"Base": other_files.cgns_hexahedra(HEXAHEDRAL)})
    menagerie.expect("cgns/cells.cgns", arrays="cell Pressure, cell Density, cell Temperature")
    other_files.cgns(menagerie.path("cgns/bases.cgns"), {
        "Left": other_files.cgns_structured(0.0), "Right": other_files.cgns_structured(1.0)})
    menagerie.expect("cgns/bases.cgns", arrays="point Pressure")
    other_files.vtkhdf(menagerie.path("vtkhdf/pieces.vtkhdf"), [LEFT, RIGHT])
    menagerie.expect("vtkhdf/pieces.vtkhdf")
    other_files.vtkhdf_image(menagerie.path("vtkhdf/image.vtkhdf"))
    menagerie.expect("vtkhdf/image.vtkhdf", arrays="point T")
    other_files.vtkhdf(menagerie.path("vtkhdf/version-2.vtkhdf"), [TETRAHEDRAL], (2, 0))
    menagerie.expect("vtkhdf/version-2.vtkhdf", needs="VTK 9.3")
    other_files.vtkhdf_steps(menagerie.path("vtkhdf/steps.vtkhdf"), HEXAHEDRAL, (0.0, 1.0, 4.0))
    menagerie.expect("vtkhdf/steps.vtkhdf", arrays="point T, cell p", steps=3, needs="VTK 9.3")


def add_collections(menagerie):
    """Time steps and parts, in .pvd and .series files."""
    for name, mesh in (("left", LEFT), ("right", RIGHT), ("whole", HEXAHEDRAL)):
        menagerie.write(f"collections/parts/{name}.vtu", vtk_files.vtu(mesh))
    files = {name: f"parts/{name}.vtu" for name in ("left", "right", "whole")}

    def pvd(name, entries, **expected):
        menagerie.add(f"collections/{name}.pvd", vtk_files.collection(entries), **expected)

    def entry(file, **attributes):
        return {**attributes, "file": files.get(file, file)}

    pvd("parts", [entry("left", timestep=0, part=0), entry("right", timestep=0, part=1)])
    pvd("parts-and-times", [entry(file, timestep=time, part=part) for time in (0.5, 2)
                            for part, file in enumerate(("left", "right"))], steps=2)
    pvd("parts-by-part", [entry(file, timestep=time, part=part)
                          for part, file in enumerate(("left", "right"))
                          for time in (2, 0.5)], steps=2)
    pvd("parts-without-number", [entry("left", timestep=0), entry("right", timestep="0.0")])
    pvd("parts-by-group", [entry("left", timestep=0, group="a", part=0),
                           entry("right", timestep=0, group="b", part=0)])
    pvd("no-times", [entry("left", part=0), entry("right", part=1)])
    pvd("static-part", [entry("left"), entry("right", timestep=1), entry("right", timestep=2)],
        steps=2)
    pvd("same-file-twice", [entry("whole", timestep=0)] * 2)
    pvd("unordered", [entry("whole", timestep=time) for time in ("1e1", "2.5", "-1")], steps=3)
    pvd("backslashes", [entry("parts\\whole.vtu", timestep=0)])
    pvd("nested", [entry("parts-and-times.pvd", timestep=0),
                   entry("parts-and-times.pvd", timestep=2)], steps=2)
    pvd("nested-without-times", [entry("left-times.pvd"), entry("right-times.pvd")], steps=2)
    for side in ("left", "right"):
        menagerie.write(f"collections/{side}-times.pvd", vtk_files.collection(
            [entry(side, timestep=time) for time in (1, 2)]))
    pvd("of-blocks", [entry("parts/blocks.vtm", timestep=0)])
    menagerie.write("collections/parts/blocks.vtm", vtk_files.blocks(["left.vtu", "right.vtu"]))
    pvd("of-series", [entry("plain.vtu.series")], steps=2)

    def bad(name, entries, error):
        menagerie.add_bad(f"collections/{name}", vtk_files.collection(entries), error)

    bad("missing-part.pvd", [entry("left", timestep=0, part=0), entry("gone.vtu", timestep=0,
                                                                      part=1)],
        "gone.vtu: there is no such file")
    bad("bad-time.pvd", [entry("left", timestep="now")], "the time 'now' is not a number")
    bad("endless.pvd", [entry("endless.pvd", timestep=0)], "the collection is a part of itself")
    bad("empty.pvd", [], "the collection names no files")
    bad("no-file.pvd", [{"timestep": 0}], "names no file")
    series = '{"file-series-version": "1.0", "files": [%s]}\n'
    for name, files_and_times, steps in (
            ("plain", [("whole", 0), ("whole", 0.5)], 2), ("no-times", [("whole", None)] * 3, 3),
            ("parts", [("left", 1), ("right", 1)], 1)):
        menagerie.add(f"collections/{name}.vtu.series", series % ", ".join(
            '{"name": "%s"%s}' % (files[file], "" if time is None else ', "time": %s' % time)
            for file, time in files_and_times), steps=steps)
    menagerie.add_bad("collections/missing.series", series % '{"name": "gone.vtu", "time": 0}',
                      "gone.vtu: there is no such file")
    menagerie.add_bad("collections/broken.series", "{", "broken.series: ")
    menagerie.add_bad("collections/no-list.series", "{}", "no list 'files'")
    menagerie.add("collections/blocks.vtm", vtk_files.blocks(
        [["parts/left.vtu"], ["parts/right.vtu", "parts/surface.vtu"]]))
    menagerie.write("collections/parts/surface.vtu", vtk_files.vtu(SURFACE.with_arrays()))
    menagerie.add("collections/pieces.pvtu", vtk_files.pvtu(LEFT, [files["left"], files["right"]]))
    menagerie.add("collections/partitions.vtpd", vtk_files.XMLWriter().file(
        "vtkPartitionedDataSet", '<DataSet index="0" file="parts/left.vtu"/>\n'
        '<DataSet index="1" file="parts/right.vtu"/>\n'))


def add_places(menagerie):
    """Coordinates and cells that are not drawn."""
    utm = HEXAHEDRAL.moved(UTM)
    bounds = [BOX[i] + UTM[i // 2] for i in range(6)]
    menagerie.add("places/utm.vtu", vtk_files.vtu(utm, encoding="raw"), bounds=bounds)
    menagerie.add("places/utm-unused-point.vtu", vtk_files.vtu(utm.with_points([(0, 0, 0)])),
                  bounds=bounds)
    menagerie.add("places/utm-float.vtu", vtk_files.vtu(utm.moved((-0.25, -0.5, 0)), points="f4"),
                  bounds=[x - (0.25, 0.5, 0)[i // 2] for i, x in enumerate(bounds)])
    half = (0, 1, 0, 1, 0, 1)

    def ghosts(*flags):
        return HEXAHEDRAL.with_arrays({"T": HEXAHEDRAL.point_data["T"]},
                                      {"vtkGhostType": numpy.array(flags, "u1")})

    menagerie.add("places/duplicate-half.vtu", vtk_files.vtu(ghosts(0, 1)), volume=1, bounds=half,
                  arrays="point T")
    menagerie.add("places/hidden-half.vtu", vtk_files.vtu(ghosts(0, 32)), volume=1, bounds=half,
                  arrays="point T")
    menagerie.add_bad("places/all-hidden.vtu", vtk_files.vtu(ghosts(32, 32)), "hidden")
    menagerie.add("places/far-surface.vtu", vtk_files.vtu(HEXAHEDRAL.with_points(
        [(90, 0, 0), (99, 0, 0), (90, 9, 0)]).with_cells([[12, 13, 14]], 5)))


def add_damaged(menagerie):
    """Files that cannot be drawn, and values that are not finite."""
    mesh = HEXAHEDRAL
    ids = [point for cell in mesh.cells for point in cell]

    def changed(place, value):
        return ids[:place] + [value] + ids[place + 1:]

    def bad(name, data, error, mapper="no"):
        menagerie.add_bad(f"damaged/{name}", data, error, mapper)

    bad("index-too-large.vtu", vtk_files.vtu(mesh, connectivity=changed(3, 100000)),
        "uses point 100000, but there are 12 points", "damaged")
    bad("index-negative.vtu", vtk_files.vtu(mesh, connectivity=changed(3, -1)),
        "uses point -1", "damaged")
    bad("all-indices-too-large.vtu", vtk_files.vtu(mesh, connectivity=[i + 100 for i in ids]),
        "but there are 12 points")
    tetrahedra = [point for cell in TETRAHEDRAL.cells for point in cell]
    bad("tetrahedra-index-too-large.vtu", vtk_files.vtu(
        TETRAHEDRAL, connectivity=tetrahedra[:-1] + [12], encoding="raw"),
        "uses point 12, but there are 12 points", "damaged")
    bad("offsets-descend.vtu", vtk_files.vtu(mesh, offsets=[8, 4]), "offsets")
    bad("offsets-too-large.vtu", vtk_files.vtu(mesh, offsets=[8, 99]), "")
    faces = [[list(face) for face in cell] for cell in MESHES["polyhedra"].faces]
    faces[1][2][1] = 77
    bad("polyhedron-index-too-large.vtu", vtk_files.vtu(
        Mesh(mesh.points, mesh.cells, [42, 42], faces)), "uses point 77")
    bad("array-too-short.vtu", vtk_files.vtu(mesh.with_arrays(
        {"T": numpy.arange(5.0)})), "")
    whole = vtk_files.vtu(mesh)
    bad("cut-off.vtu", whole[:len(whole) // 2], "cut-off.vtu")
    raw = vtk_files.vtu(mesh, encoding="raw")
    bad("cut-off-raw.vtu", raw[:raw.index(b"_") + 200], "cut-off-raw.vtu")
    packed = vtk_files.vtu(mesh, encoding="raw", compressor="vtkZLibDataCompressor")
    start = packed.index(b"\n_") + 40
    bad("broken-zlib.vtu", packed[:start] + bytes(60) + packed[start + 60:], "broken-zlib.vtu")
    bad("empty-file.vtu", "", "empty-file.vtu")
    bad("not-xml.vtu", "TITLE = box\n", "not-xml.vtu")
    bad("no-cells.vtu", vtk_files.vtu(Mesh(mesh.points, [], [])), "no cells")
    bad("nothing.vtu", vtk_files.vtu(Mesh([], [], [])), "no cells")
    bad("surface.vtu", vtk_files.vtu(SURFACE), "its cells are: 12 Quad")
    bad("lines-and-triangles.vtu", vtk_files.vtu(Mesh(mesh.points, [[0, 1], [0, 1, 2]], [3, 5])),
        "its cells are: 1 Line, 1 Triangle")
    bad("missing-piece.pvtu", vtk_files.pvtu(mesh, ["gone.vtu"]), "missing-piece.pvtu")
    bad("missing-block.vtm", vtk_files.blocks(["gone.vtu"]), "missing-block.vtm")
    text = vtk_files.legacy(mesh)
    bad("cut-off.vtk", text[:len(text) // 2], "cut-off.vtk")
    bad("index-too-large.vtk", vtk_files.legacy(Mesh(mesh.points, [changed(3, 500)[:8]], [12])),
        "uses point 500", "damaged")
    bad("not-vtk.vtk", "solid box\n", "not-vtk.vtk")
    bad("not-gmsh.msh", "text\n", "not-gmsh.msh")
    bad("cut-off.xdmf", other_files.xdmf(TETRAHEDRAL)[:400], "cut-off.xdmf")
    bad("not-hdf.vtkhdf", "text\n", "not-hdf.vtkhdf")
    bad("not-exodus.e", "text\n", "not-exodus.e")
    bad("not-cgns.cgns", "text\n", "not-cgns.cgns")
    with open(menagerie.path("cgns/cells.cgns"), "rb") as file:
        bad("cut-off.cgns", file.read(3000), "cut-off.cgns")
    with open(menagerie.path("vtkhdf/pieces.vtkhdf"), "rb") as file:
        bad("cut-off.vtkhdf", file.read(3000), "cut-off.vtkhdf")
    bad("not-netcdf.nc", "text\n", "not-netcdf.nc")
    bad("no-geometry.case", "FORMAT\ntype: ensight gold\nGEOMETRY\nmodel: gone.geo\n",
        "no-geometry.case")
    bad("no-case.foam", "", "no-case.foam")
    nan = float("nan")
    bad("no-finite-values.vtu", vtk_files.vtu(mesh.with_arrays({"T": numpy.full(12, nan)})),
        "no finite values")
    holes = TETRAHEDRAL.point_data["T"].copy()
    holes[0] = nan
    # All tetrahedra of the left half have the point.
    menagerie.add("damaged/some-values-not-finite.vtu", vtk_files.vtu(TETRAHEDRAL.with_arrays(
        {"T": holes})), volume=1, arrays="point T")
    for name, value in (("not-finite", nan), ("infinite", float("inf")), ("huge", 1e300)):
        # All tetrahedra of the right half have the point.
        moved = TETRAHEDRAL.moved((0, 0, 0))
        moved.points[(moved.points == (2, 1, 1)).all(axis=1)] = value
        data = vtk_files.vtu(moved, encoding="base64")
        if name == "huge":
            bad("point-huge.vtu", data, "shows nothing of the mesh")
        else:
            menagerie.add(f"damaged/point-{name}.vtu", data, volume=1, bounds=(0, 1, 0, 1, 0, 1))
    menagerie.add("damaged/flat-cell.vtu", vtk_files.vtu(mesh.with_cells(
        [[0, 1, 2, 3], [5, 5, 5, 5]], TETRA)))


def make(folder):
    menagerie = Menagerie(folder)
    for add in (add_cells, add_encodings, add_structured, add_programs, add_exodus, add_hdf,
                add_collections, add_places, add_damaged):
        add(menagerie)
    menagerie.save()


if __name__ == "__main__":
    make(sys.argv[1] if len(sys.argv) > 1 else FOLDER)
