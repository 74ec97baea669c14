# SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
# SPDX-License-Identifier: BSD-3-Clause
"""Compares the sizes of VTK's classes that Meniscus uses and their virtual function tables, by
their headers and in the libraries of a wheel, so that no program is built with headers of another
version or configuration. Tables must have the same length and the same functions at the same
places; functions that a library does not export are not compared. A member that fits into the
padding of its class is not noticed.

Arguments: the folder of the wheel's libraries; a file with the compiler's options for the headers.
"""
import glob
import os
import re
import struct
import subprocess
import sys
import tempfile

# Modules that Meniscus builds on (vtk.module), and RenderingCore, from which it derives.
MODULES = ("CommonCore", "CommonDataModel", "CommonExecutionModel", "CommonMath",
           "CommonTransforms", "RenderingCore", "RenderingOpenGL2", "RenderingVolume")
# `mov $size,%edi`, the argument of `operator new`, and at most this many bytes later its call.
ARGUMENT = re.compile(rb"\xbf(....)", re.DOTALL)
DISTANCE = 24
# Classes that Meniscus neither derives from nor calls behind this function of their tables, which
# may differ from there on: vtkAbstractCellLocator got another FindCell() in VTK 9.7.2. The calls
# are those of Filters/Mesher/SurfaceExtraction.cxx.
LAST_CALLED = {"vtkAbstractCellLocator": "FindClosestPoint",
               "vtkStaticCellLocator": "FindClosestPoint"}


def run(*command):
    return subprocess.run(command, check=True, stdout=subprocess.PIPE, text=True).stdout


def symbols(library):
    """Yields (name, address, size) of the symbols that a library defines."""
    for line in run("nm", "-D", "-S", "--defined-only", library).splitlines():
        fields = line.split()
        if len(fields) == 4:
            yield fields[3], int(fields[0], 16), int(fields[1], 16)


def tables(library):
    """Virtual function tables of VTK's classes: names of the functions, None for those that the
    library does not export."""
    exported = {address: name for name, address, _ in symbols(library)}
    entries = {}
    for line in run("readelf", "-rW", library).splitlines():
        fields = line.split()
        if len(fields) >= 4 and fields[2] == "R_X86_64_RELATIVE":
            entries[int(fields[0], 16)] = exported.get(int(fields[3], 16))
        elif len(fields) >= 5 and fields[2] == "R_X86_64_64":
            entries[int(fields[0], 16)] = fields[4]
    found = {name: [entries.get(place) for place in range(address, address + size, 8)]
             for name, address, size in symbols(library) if re.match(r"_ZTV\d+vtk", name)}
    mangled = sorted({name for table in found.values() for name in table if name})
    plain = subprocess.run(["c++filt"], input="\n".join(mangled), check=True, text=True,
                           stdout=subprocess.PIPE).stdout.splitlines()
    names = {name: short_name(text) for name, text in zip(mangled, plain)}
    return {name: [names.get(entry) for entry in table] for name, table in found.items()}


def short_name(text):
    """Name of a function without its class, which is another one where a class overrides it, and
    `~` for destructors; None for other symbols."""
    match = re.search(r"^[^ (]*::(~|\w+)", text)
    return match.group(1) if match else None


def differs(name, ours, theirs):
    """Whether two tables of a class differ where Meniscus may call them."""
    last = LAST_CALLED.get(re.sub(r"_ZTV\d+", "", name))
    if last:
        end = 1 + max(i for i, entry in enumerate(ours) if entry == last)
        ours, theirs = ours[:end], theirs[:end]
    return len(ours) != len(theirs) or any(a and b and a != b for a, b in zip(ours, theirs))


def code_offset(library):
    """Offset in the file less the address of the code."""
    for line in run("readelf", "-lW", library).splitlines():
        fields = line.split()
        if fields[:1] == ["LOAD"] and "E" in fields[6:8]:
            return int(fields[1], 16) - int(fields[2], 16)
    raise ValueError("%s has no code" % library)


def address_of_new(library):
    """Address that code of a library calls as `operator new`."""
    output = run("objdump", "-d", "-j", ".plt", "--no-show-raw-insn", library)
    return int(re.search(r"^([0-9a-f]+) <_Znwm@plt>:", output, re.MULTILINE).group(1), 16)


def allocated_size(code, address, new):
    """Argument of the only call of `operator new` in a function's code; None if there are others
    or none."""
    found = []
    for call in re.finditer(rb"\xe8", code):
        end = call.end() + 4
        target = address + end + int.from_bytes(code[call.end():end], "little", signed=True)
        if target == new:
            found += ARGUMENT.findall(code[max(0, call.start() - DISTANCE):call.start()])[-1:]
    return int.from_bytes(found[0], "little") if len(found) == 1 else None


def allocated_sizes(library):
    """Bytes per object that the functions New() of a library's classes allocate, by class."""
    found = {}
    offset, new = code_offset(library), address_of_new(library)
    with open(library, "rb") as file:
        for name, address, size in symbols(library):
            match = re.match(r"_ZN\d+(vtk\w+?)3NewEv$", name)
            if match:
                file.seek(address + offset)
                found[match.group(1)] = allocated_size(file.read(size), address, new)
    return {name: size for name, size in found.items() if size}


def included_classes():
    """Classes of VTK whose headers the sources of Meniscus include."""
    found = set()
    root = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..")
    for name in glob.glob(root + "/Filters/**", recursive=True) + glob.glob(
            root + "/Rendering/**", recursive=True):
        if name.endswith((".h", ".cxx")):
            with open(name) as file:
                found.update(re.findall(r"#include [\"<](vtk\w+)\.h", file.read()))
    return found


def has_old_strings(library):
    """Whether a library is built with the old std::string of libstdc++, which has another size."""
    return not any("__cxx11" in name for name, _, _ in symbols(library))


def compile_headers(names, headers, old_strings):
    """Sizes of classes by their headers, and their virtual function tables. Nothing is linked: the
    sizes are read from an object file, the tables from what gcc prints."""
    includes = "".join("#include <%s.h>\n" % name for name in names)
    sizes = ", ".join("sizeof(%s)" % name for name in names)
    with tempfile.TemporaryDirectory() as folder:
        source, code, data, dump = (os.path.join(folder, name)
                                    for name in ("s.cxx", "s.o", "s.bin", "s.class"))
        with open(source, "w") as file:
            file.write("#include <cstdint>\n%s__attribute__((section(\"sizes\"), used))\n"
                       "const std::uint64_t Sizes[] = { %s };\n" % (includes, sizes))
        run("g++", "-std=c++17", "-w", "-c", "-D_GLIBCXX_USE_CXX11_ABI=%d" % (not old_strings),
            "-fdump-lang-class=" + dump, "@" + headers, source, "-o", code)
        run("objcopy", "-O", "binary", "--only-section=sizes", code, data)
        with open(data, "rb") as file:
            found = dict(zip(names, struct.unpack("<%dQ" % len(names), file.read())))
        with open(dump) as file:
            printed = re.findall(r"^\w+::(_ZTV\w+): \d+ entries\n((?:\d+ .*\n)*)", file.read(),
                                 re.MULTILINE)
    return found, {name: [short_name(line.split(")")[-1]) for line in lines.splitlines()]
                   for name, lines in printed}


def main():
    wheel, headers = sys.argv[1:]
    theirs, allocated = {}, {}
    for module in MODULES:
        library = "%s/libvtk%s.so" % (wheel, module)
        theirs.update(tables(library))
        allocated.update(allocated_sizes(library))
    names = sorted(included_classes() & set(allocated))
    old_strings = has_old_strings("%s/libvtkCommonCore.so" % wheel)
    sizes, ours = compile_headers(names, headers, old_strings)
    common = sorted(set(ours) & set(theirs))
    print("%d virtual function tables and %d classes compared" % (len(common), len(names)))
    wrong = ["%s: %d bytes, in the wheel %d" % (name, sizes[name], allocated[name])
             for name in names if sizes[name] != allocated[name]]
    wrong += ["%s: other functions in the wheel" % name
              for name in common if differs(name, ours[name], theirs[name])]
    if wrong:
        sys.exit("\n".join(wrong))
    if len(common) < 100 or len(names) < 30:
        sys.exit("too few to compare")


if __name__ == "__main__":
    main()
