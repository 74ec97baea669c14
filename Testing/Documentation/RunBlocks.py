# SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
# SPDX-License-Identifier: BSD-3-Clause
"""Runs the code blocks of a page of the documentation, concatenated to one program, in an empty
folder with the files of Examples/Python/guide_files.py.

Arguments: the page, the language of the blocks, the folder; then the pictures that must exist
afterwards and must not be uniform. With --shown before the page, the page must show each picture,
images/NAME.png next to the documentation, as the program draws it here; with --update it is copied
there. A language `extract:LANGUAGE` only writes the blocks to the folder, to be compiled (cpp,
cmake) or run by another program."""
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
# The folder of the script that writes the files of the guides.
EXAMPLES = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..", "Examples",
                        "Python")


def blocks(page, language):
    with open(page) as file:
        found = re.findall(r"^```%s\n(.*?)^```$" % language, file.read(), re.DOTALL | re.MULTILINE)
    if not found:
        sys.exit("%s has no block of %s" % (page, language))
    return found


def write_files():
    """Writes mesh.vtu, object.vtp and water.vtp, as a reader of the guides does."""
    sys.path.insert(0, EXAMPLES)
    import guide_files
    sys.path.remove(EXAMPLES)
    guide_files.write_files()


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
