# SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
# SPDX-License-Identifier: BSD-3-Clause
"""Runs the code blocks of a page of the documentation, concatenated to one program, in an empty
folder with the data files that the pages read.

Arguments: the page, the language of the blocks, the folder; then the pictures that must exist
afterwards and must not be uniform. With --shown before the page, the page must show each picture,
images/NAME.png next to the documentation, as the program draws it here; with --update it is copied
there. A language `extract:LANGUAGE` only writes the blocks to the folder, to be compiled (cpp,
cmake) or run by another program."""
import math
import os
import re
import shutil
import sys

SUFFIXES = {"python": "py", "pvpython": "py", "pyvista": "py",
            "accessor": "py", "cpp": "cxx", "cmake": "txt"}
# Smallest range of pixel values in a picture, within [0, 255]; that of an empty picture is 0.
LEAST_CONTRAST = 50
# Largest difference of a pixel from the picture that a page shows: processors round differently.
LARGEST_DIFFERENCE = 4
# Points of mesh.vtu along an axis, from -10 to 10.
POINTS = 25


def blocks(page, language):
    with open(page) as file:
        found = re.findall(r"^```%s\n(.*?)^```$" % language, file.read(), re.DOTALL | re.MULTILINE)
    if not found:
        sys.exit("%s has no block of %s" % (page, language))
    return found


def ring_density(x, y, z):
    """Two rings of radius 5 that are linked, each with a Gaussian profile."""
    first = (math.hypot(x + 2.5, y) - 5) ** 2 + z ** 2
    second = (math.hypot(x - 2.5, z) - 5) ** 2 + y ** 2
    return math.exp(-first / 3) + math.exp(-second / 3)


def make_field():
    """The image of ring_density()."""
    from vtkmodules.vtkCommonCore import vtkFloatArray
    from vtkmodules.vtkCommonDataModel import vtkImageData

    field, density = vtkImageData(), vtkFloatArray()
    field.SetDimensions(POINTS, POINTS, POINTS)
    field.SetOrigin(-10.0, -10.0, -10.0)
    field.SetSpacing(*[20.0 / (POINTS - 1)] * 3)
    density.SetName("density")
    for p in range(field.GetNumberOfPoints()):
        density.InsertNextValue(ring_density(*field.GetPoint(p)))
    field.GetPointData().SetScalars(density)
    return field


def make_waves(plane):
    """Adds waves to a plane, with their normals."""
    points, normals = plane.GetPoints(), plane.GetPointData().GetNormals()
    for p in range(points.GetNumberOfPoints()):
        x, y, z = points.GetPoint(p)
        points.SetPoint(p, x, y, z + 0.04 * math.sin(4 * x + y) + 0.03 * math.sin(2 * x - 5 * y))
        along = -0.16 * math.cos(4 * x + y) - 0.06 * math.cos(2 * x - 5 * y)
        across = -0.04 * math.cos(4 * x + y) + 0.15 * math.cos(2 * x - 5 * y)
        length = math.sqrt(along ** 2 + across ** 2 + 1)
        normals.SetTuple3(p, along / length, across / length, 1 / length)


def write_files():
    """Writes mesh.vtu, a field on tetrahedra, object.vtp, a torus, and water.vtp, waves that it
    intersects; in ASCII, for every reader."""
    from vtkmodules.vtkCommonComputationalGeometry import vtkParametricTorus
    from vtkmodules.vtkFiltersGeneral import vtkDataSetTriangleFilter
    from vtkmodules.vtkFiltersSources import vtkParametricFunctionSource, vtkPlaneSource
    from vtkmodules.vtkIOXML import vtkXMLPolyDataWriter, vtkXMLUnstructuredGridWriter

    tetrahedra = vtkDataSetTriangleFilter()
    tetrahedra.SetInputData(make_field())
    torus = vtkParametricFunctionSource()
    torus.SetParametricFunction(vtkParametricTorus())
    water = vtkPlaneSource()
    water.SetOrigin(-2.0, -2.0, 0.2)
    water.SetPoint1(2.0, -2.0, 0.2)
    water.SetPoint2(-2.0, 2.0, 0.2)
    water.SetResolution(80, 80)
    water.Update()
    make_waves(water.GetOutput())
    for name, writer, source in [("mesh.vtu", vtkXMLUnstructuredGridWriter(), tetrahedra),
                                 ("object.vtp", vtkXMLPolyDataWriter(), torus),
                                 ("water.vtp", vtkXMLPolyDataWriter(), water)]:
        writer.SetInputConnection(source.GetOutputPort())
        writer.SetDataModeToAscii()
        writer.SetFileName(name)
        writer.Write()


def read_picture(name):
    """Dimensions and the values of a picture."""
    from vtkmodules.vtkIOImage import vtkPNGReader

    reader = vtkPNGReader()
    reader.SetFileName(name)
    reader.Update()
    image = reader.GetOutput()
    return image.GetDimensions(), bytes(memoryview(image.GetPointData().GetScalars()))


def check_picture(name):
    if not os.path.exists(name):
        sys.exit("There is no %s" % name)
    _, values = read_picture(name)
    low, high = min(values), max(values)
    print("%s: values %g to %g" % (name, low, high))
    if high - low < LEAST_CONTRAST:
        sys.exit("%s shows nothing" % name)


def shown_path(page, name):
    """The file of a picture that a page shows: the README or one of the folder Documentation."""
    folder = os.path.dirname(page)
    if os.path.basename(folder) != "Documentation":
        folder = os.path.join(folder, "Documentation")
    return os.path.join(folder, "images", name)


def check_shown(name, page):
    """Compares a picture with the one of its name that the page shows."""
    shown = shown_path(page, name)
    with open(page) as file:
        if "images/%s)" % name not in file.read():
            sys.exit("%s does not show %s" % (page, name))
    if not os.path.exists(shown):
        sys.exit("There is no %s" % shown)
    (size, values), (shown_size, shown_values) = read_picture(name), read_picture(shown)
    largest = max((abs(a - b) for a, b in zip(values, shown_values)), default=0)
    if size != shown_size or len(values) != len(shown_values) or largest > LARGEST_DIFFERENCE:
        sys.exit("%s differs from %s, by up to %d of 255; compare them, and copy it if it is right"
                 % (os.path.abspath(name), shown, largest))


def save_window(window, name):
    from vtkmodules.vtkIOImage import vtkPNGWriter
    from vtkmodules.vtkRenderingCore import vtkWindowToImageFilter

    window.Render()
    picture = vtkWindowToImageFilter()
    picture.SetInput(window)
    writer = vtkPNGWriter()
    writer.SetInputConnection(picture.GetOutputPort())
    writer.SetFileName(name)
    writer.Write()


def save_instead_of_waiting(program, pictures):
    """Lines that would hand the window to the user save it as the first picture instead."""
    return re.sub(r"^(\w+)\.MakeRenderWindowInteractor\(\)\.Start\(\).*$",
                  lambda line: "save_window(%s, %r)" % (line.group(1), pictures[0]),
                  program, flags=re.MULTILINE)


def main():
    mode = sys.argv.pop(1) if sys.argv[1] in ("--shown", "--update") else None
    page, language, folder, pictures = sys.argv[1], sys.argv[2], sys.argv[3], sys.argv[4:]
    page = os.path.abspath(page)
    extract = language.startswith("extract:")
    language = language.split(":")[-1]
    if not extract:
        shutil.rmtree(folder, ignore_errors=True)
    os.makedirs(folder, exist_ok=True)
    program = "\n".join(blocks(page, language))
    name = os.path.splitext(os.path.basename(page))[0].lower()
    path = os.path.join(folder, "CMakeLists.txt" if language == "cmake"
                        else "%s.%s" % (name, SUFFIXES[language]))
    with open(path, "w") as file:
        file.write(program)
    if extract:
        return
    os.chdir(folder)
    write_files()
    program = save_instead_of_waiting(program, pictures)
    exec(compile(program, path, "exec"), {"__name__": "__main__", "save_window": save_window})
    for picture in pictures:
        check_picture(picture)
        if mode == "--update":
            shutil.copy(picture, shown_path(page, picture))
        elif mode == "--shown":
            check_shown(picture, page)
    print("FINISHED")


if __name__ == "__main__":
    main()
