#!/usr/bin/env python3
# SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
# SPDX-License-Identifier: BSD-3-Clause
"""Lists the source files that tests have not reached, and fails if there are any.

usage: check_reach.py FOLDER [--table]

FOLDER has the records that test programs write there (Testing/Support/CoverageRecorder.cxx). A
source file of Module/, Filters/ or Rendering/ is reached if one of its functions has run. Headers,
files without functions, and functions that set up static objects do not count. --table prints
functions and blocks of each file.
"""
import collections
import glob
import os
import re
import subprocess
import sys

ROOT = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
LAYERS = ("Module/", "Filters/", "Rendering/")
# Functions that the compiler adds.
SETUP = re.compile(r"_GLOBAL__|__cxx_global_var_init|asan\.|sancov\.")
# Of a function in a source that is compiled together with others, addr2line of binutils 2.40 names
# the generated file.
COMMAND = ["llvm-symbolizer-14", "--functions=linkage", "--no-inlines", "--output-style=GNU", "-e"]
Function = collections.namedtuple("Function", "offset first blocks")


def read_functions(path):
    """The binary, and its functions."""
    with open(path, encoding="utf-8") as file:
        binary = file.readline().rstrip("\n")
        places = [line.split() for line in file]
    begins = [i for i, (_, flags) in enumerate(places) if int(flags) & 1]
    ends = begins[1:] + [len(places)]
    return binary, [Function(places[b][0], b, e - b) for b, e in zip(begins, ends)]


def read_counters(start):
    """A byte for each block, which is not 0 if any process has run it."""
    union = 0
    length = 0
    for path in glob.glob(glob.escape(start) + ".*.counters"):
        with open(path, "rb") as file:
            counters = file.read()
        length = len(counters)
        union |= int.from_bytes(counters, "little")
    return union.to_bytes(length, "little")


def files_of(binary, functions):
    """The source file of each function that counts, relative to the project; None for others."""
    text = subprocess.run(COMMAND + [binary], check=True, capture_output=True,
                          text=True, input="".join(f"0x{f.offset}\n" for f in functions)).stdout
    lines = text.splitlines()
    files = []
    for name, place in zip(lines[::2], lines[1::2]):
        path = os.path.normpath(re.sub(r":[0-9?]+( \(.*\))?$", "", place))
        path = os.path.relpath(path, ROOT)
        counts = path.startswith(LAYERS) and path.endswith(".cxx") and not SETUP.match(name)
        files.append(path if counts else None)
    return files


def read_files(folder):
    """Functions, those reached, blocks, and those reached, of each source file."""
    table = collections.defaultdict(collections.Counter)
    for path in sorted(glob.glob(os.path.join(folder, "*.places"))):
        binary, functions = read_functions(path)
        counters = read_counters(path[:-len(".places")])
        for function, name in zip(functions, files_of(binary, functions)):
            if name:
                blocks = counters[function.first:function.first + function.blocks]
                reached = sum(count > 0 for count in blocks)
                table[name].update(functions=1, reached=reached > 0, blocks=function.blocks,
                                   reached_blocks=reached)
    return table


def main():
    """Prints files that have not been reached, and sums."""
    if len(sys.argv) not in (2, 3):
        sys.exit(__doc__)
    table = read_files(sys.argv[1])
    if "--table" in sys.argv:
        for name, row in sorted(table.items()):
            print(f'{name}: {row["reached"]} of {row["functions"]} functions, '
                  f'{row["reached_blocks"]} of {row["blocks"]} blocks')
    for layer in LAYERS:
        rows = [row for name, row in table.items() if name.startswith(layer)]
        total = sum(rows, collections.Counter())
        print(f'{layer} {sum(row["reached"] > 0 for row in rows)} of {len(rows)} files, '
              f'{total["reached"]} of {total["functions"]} functions, '
              f'{total["reached_blocks"]} of {total["blocks"]} blocks reached')
    missed = [name for name, row in sorted(table.items()) if row["reached"] == 0]
    for name in missed:
        print(f"not reached: {name}")
    sys.exit(1 if missed or not table else 0)


if __name__ == "__main__":
    main()
