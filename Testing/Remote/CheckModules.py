# SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
# SPDX-License-Identifier: BSD-3-Clause
"""vtk.module names every VTK module whose headers the classes include, as VTK's own build demands,
where each module has a folder of its own, and Remote/vtk.module names the same.

Arguments: the root of the project, the folder of VTK's hierarchy files, VTK's file of module
properties."""
import glob
import os
import re
import sys

PUBLIC = "DEPENDS"
PRIVATE = "PRIVATE_DEPENDS"


def dependencies(path):
    with open(path) as file:
        lines = file.read().split("\n")
    found = {PUBLIC: [], PRIVATE: []}
    keyword = None
    for line in lines:
        if re.match("[A-Z_]+$", line):
            keyword = line
        elif keyword in found and line.strip():
            found[keyword].append(line.strip())
    return found


def modules_of_headers(folder):
    modules = {}
    for path in glob.glob(os.path.join(folder, "*-hierarchy.txt")):
        with open(path) as file:
            for header, library in re.findall(r"; (vtk\w+\.h) ; vtk(\w+)", file.read()):
                modules[header] = "VTK::" + library
    return modules


def public_dependencies(path):
    pattern = r'TARGET "(VTK::\w+)" PROPERTY "INTERFACE_vtk_module_depends" "([^"]*)"'
    with open(path) as file:
        return {module: names.split(";") for module, names in re.findall(pattern, file.read())}


def reached(modules, depends):
    found = set()
    ahead = list(modules)
    while ahead:
        module = ahead.pop()
        if module and module not in found:
            found.add(module)
            ahead += depends.get(module, [])
    return found


def included(root):
    for folder in ("Filters", "Rendering"):
        for path in sorted(glob.glob(os.path.join(root, folder, "*.*"))):
            with open(path) as file:
                for header in re.findall(r'^#include "(vtk\w+\.h)"', file.read(), re.MULTILINE):
                    yield os.path.basename(path), header


def main():
    root, hierarchies, properties = sys.argv[1:]
    ours = dependencies(os.path.join(root, "vtk.module"))
    faults = []
    if ours != dependencies(os.path.join(root, "Remote", "vtk.module")):
        faults.append("vtk.module and Remote/vtk.module name different modules")
    modules, depends = modules_of_headers(hierarchies), public_dependencies(properties)
    public = reached(ours[PUBLIC], depends)
    everything = reached(ours[PUBLIC] + ours[PRIVATE], depends)
    count = 0
    for name, header in included(root):
        module = modules.get(header)
        count += module is not None
        if header == "vtk_glew.h":
            faults.append("%s includes %s, which VTK 9.4 and later do not have" % (name, header))
        if module and module not in everything:
            faults.append("%s includes %s of %s, which vtk.module does not name"
                          % (name, header, module))
        elif module and re.match(r"vtk\w+\.h$", name) and module not in public:
            faults.append("%s includes %s of %s, which is not public in vtk.module"
                          % (name, header, module))
    print("%d headers of VTK" % count)
    sys.exit("\n".join(faults) if faults or count < 100 else 0)


if __name__ == "__main__":
    main()
