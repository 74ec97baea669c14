# SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
# SPDX-License-Identifier: BSD-3-Clause
"""Runs the code blocks of a page of the documentation, concatenated to one program, in an empty
folder with the data files that the pages read.

Arguments: the page, the language of the blocks, the folder; then the pictures that must exist
afterwards and must not be uniform. A language `extract:LANGUAGE` only writes the blocks to the
folder, to be compiled (cpp, cmake) or run by another program."""
import os
import re
import shutil
import sys

SUFFIXES = {"python": "py", "pvpython": "py", "pyvista": "py",
            "accessor": "py", "cpp": "cxx", "cmake": "txt"}
# Smallest range of pixel values in a picture, within [0, 255]; that of an empty picture is 0.
LEAST_CONTRAST = 50


def blocks(page, language):
    with open(page) as file:
        found = re.findall(r"^```%s\n(.*?)^```$" % language, file.read(), re.DOTALL | re.MULTILINE)
    if not found:
        sys.exit("%s has no block of %s" % (page, language))
    return found


def write_files():
    """Writes mesh.vtu, a field on tetrahedra, object.vtp, a torus, and water.vtp, a plane that it
    intersects; in ASCII, for every reader."""
    from vtkmodules.vtkCommonComputationalGeometry import vtkParametricTorus
    from vtkmodules.vtkFiltersGeneral import vtkDataSetTriangleFilter
    from vtkmodules.vtkFiltersSources import vtkParametricFunctionSource, vtkPlaneSource
    from vtkmodules.vtkIOXML import vtkXMLPolyDataWriter, vtkXMLUnstructuredGridWriter
    from vtkmodules.vtkImagingCore import vtkRTAnalyticSource

    field = vtkRTAnalyticSource()
    tetrahedra = vtkDataSetTriangleFilter()
    tetrahedra.SetInputConnection(field.GetOutputPort())
    torus = vtkParametricFunctionSource()
    torus.SetParametricFunction(vtkParametricTorus())
    water = vtkPlaneSource()
    water.SetOrigin(-2.0, -2.0, 0.2)
    water.SetPoint1(2.0, -2.0, 0.2)
    water.SetPoint2(-2.0, 2.0, 0.2)
    for name, writer, source in [("mesh.vtu", vtkXMLUnstructuredGridWriter(), tetrahedra),
                                 ("object.vtp", vtkXMLPolyDataWriter(), torus),
                                 ("water.vtp", vtkXMLPolyDataWriter(), water)]:
        writer.SetInputConnection(source.GetOutputPort())
        writer.SetDataModeToAscii()
        writer.SetFileName(name)
        writer.Write()


def check_picture(name):
    from vtkmodules.vtkIOImage import vtkPNGReader

    reader = vtkPNGReader()
    reader.SetFileName(name)
    reader.Update()
    low, high = reader.GetOutput().GetScalarRange()
    print("%s: values %g to %g" % (name, low, high))
    if high - low < LEAST_CONTRAST:
        sys.exit("%s shows nothing" % name)


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
    page, language, folder, pictures = sys.argv[1], sys.argv[2], sys.argv[3], sys.argv[4:]
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
    print("FINISHED")


if __name__ == "__main__":
    main()
