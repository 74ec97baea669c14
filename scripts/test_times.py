#!/usr/bin/env python3
# SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
# SPDX-License-Identifier: BSD-3-Clause
"""Writes Testing/TestTimes.txt: the usual seconds of the tests that take long.

usage: test_times.py BUILD

BUILD is a build folder in which ctest has run on an idle machine. A test fails if it takes ten
times as long as it usually does (CMake/MeniscusTests.cmake), so that a hang is seen.
"""
import math
import os
import sys

ROOT = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
# Tests below this are not listed.
SHORT = 3.0
HEADER = "# Usual seconds of the tests that take {short:g} s and longer, by {script}.\n"


def times_of(build):
    """Mean seconds of each test, from ctest's own records."""
    path = os.path.join(build, "Testing", "Temporary", "CTestCostData.txt")
    times = {}
    with open(path, encoding="utf-8") as file:
        for line in file:
            if line.startswith("---"):
                break
            name, _, seconds = line.rsplit(" ", 2)
            times[name] = float(seconds)
    return times


def main():
    """Writes the file."""
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    times = times_of(sys.argv[1])
    target = os.path.join(ROOT, "Testing", "TestTimes.txt")
    with open(target, "w", encoding="utf-8") as file:
        file.write(HEADER.format(short=SHORT, script="scripts/test_times.py"))
        for name in sorted(times):
            if times[name] >= SHORT:
                file.write(f'{math.ceil(times[name])} {name}\n')


if __name__ == "__main__":
    main()
