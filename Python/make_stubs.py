# SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
# SPDX-License-Identifier: BSD-3-Clause
"""Writes vtkMeniscus.pyi, type stubs of the classes for editors and type checkers, from the
signatures in the doc strings of VTK's wrappers. (Debian's VTK has no vtkmodules.generate_pyi.)

Argument: the file to write. The package must be importable."""
import re
import sys

import meniscus.vtkMeniscus as module

SIGNATURE = re.compile(r"^(\w+)\((.*?)\)(?: -> (.*))?$")


def signatures(doc):
    """Yields the Python signatures of a doc string; its other lines are C++ and comments."""
    for line in re.sub(r"\n +", " ", doc or "").split("\n"):
        if SIGNATURE.match(line):
            yield line


def parameters(text):
    """Parameters in the syntax of stubs; arrays become sequences."""
    text = re.sub(r":(?=\S)", ": ", text)
    text = re.sub(r": \[[^]]*\]", ": MutableSequence[Any]", text)
    text = re.sub(r": \([^)]*\)", ": Sequence[Any]", text)
    return re.sub(r"\b(from|in|is|lambda|with|as|not|or|and|pass|class|def)\b(?=:)", r"\1_", text)


def method_lines(name, method):
    found = [SIGNATURE.match(line) for line in signatures(method.__doc__)]
    overloads = [match for match in found if match.group(1) == name]
    for match in overloads:
        static = not match.group(2).startswith("self")
        if len(overloads) > 1:
            yield "    @overload"
        if static:
            yield "    @staticmethod"
        result = re.sub(r"^\((.*)\)$", r"Tuple[\1]", match.group(3) or "Any")
        yield "    def %s(%s) -> %s: ..." % (name, parameters(match.group(2)), result)


def class_lines(name, kind):
    base = kind.__mro__[1]
    yield ""
    yield "class %s(%s):" % (name, base.__name__)
    for key, value in sorted(vars(kind).items()):
        if isinstance(value, int):
            yield "    %s: int" % key
        elif isinstance(value, type) and issubclass(value, int):
            yield "    class %s(int): ..." % key
        elif callable(value) or isinstance(value, staticmethod):
            yield from method_lines(key, getattr(kind, key))


def main():
    classes = [(name, kind) for name, kind in sorted(vars(module).items())
               if isinstance(kind, type)]
    body = [line for name, kind in classes for line in class_lines(name, kind)]
    names = set(re.findall(r"\bvtk\w+", "\n".join(body))) - {name for name, _ in classes}
    theirs = {name: loaded for loaded in sorted(sys.modules) if loaded.startswith("vtkmodules.vtk")
              for name in names & set(vars(sys.modules[loaded]))}
    lines = ["from typing import (",
             "    Any, Callable, Mapping, MutableSequence, Sequence, Tuple, overload)", ""]
    lines += ["from %s import %s" % (theirs[name], name) for name in sorted(theirs)]
    lines += ["%s = Any" % name for name in sorted(names - set(theirs))]
    lines += ["Callback = Callable[..., Any]", "Pointer = Any", "Buffer = Any"]
    with open(sys.argv[1], "w") as file:
        file.write("\n".join(lines + body) + "\n")


if __name__ == "__main__":
    main()
