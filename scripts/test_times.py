#!/usr/bin/env python3
# SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
# SPDX-License-Identifier: BSD-3-Clause
"""Writes Testing/TestTimes.txt or SanitizerTimes.txt: the usual seconds of tests that take long.

usage: test_times.py BUILD

BUILD is a build folder in which ctest has run all tests on an idle machine. Tests of the list have
processes of their own (CMake/MeniscusTests.cmake), which fail if they take ten times as long. If
BUILD has a sanitizer, the list has the tests that scripts/sanitize leaves out. The tests that it
runs are measured again, and the others keep their times.
"""
import glob
import json
import math
import os
import re
import sys

ROOT = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
# Tests below this are not listed.
SHORT = 3.0
# The backends that programs are run with.
PREFIXES = ("Native.", "OpenGL.")
HEADER = "# Usual seconds of the tests that take {short:g} s and longer{where}, by {script}.\n"


def times_of_ctest(folder):
    """Mean seconds of ctest's tests, from its own records."""
    times = {}
    with open(os.path.join(folder, "CTestCostData.txt"), encoding="utf-8") as file:
        for line in file:
            if line.startswith("---"):
                break
            name, _, seconds = line.rsplit(" ", 2)
            times[name] = float(seconds)
    return times


def times_of_processes(folder):
    """The processes of GoogleTest programs, and the seconds of each of their tests."""
    processes = set()
    times = {}
    paths = glob.glob(os.path.join(folder, "Times", "**", "*.json"), recursive=True)
    # The last record of a test counts, if its process has changed.
    for path in sorted(paths, key=os.path.getmtime):
        name = os.path.relpath(path, os.path.join(folder, "Times"))[:-len(".json")]
        processes.add(name)
        with open(path, encoding="utf-8") as file:
            suites = json.load(file)["testsuites"]
        for suite in suites:
            # The process has the name of the suite without parameters, or of a test, with a prefix.
            start = name.split(".")[0] + "."
            prefix = start if start in PREFIXES else ""
            for test in suite["testsuite"]:
                times[f'{prefix}{suite["name"]}.{test["name"]}'] = float(test["time"].rstrip("s"))
    return processes, times


def has_sanitizer(build):
    """True if the tests of the build folder run with a sanitizer."""
    with open(os.path.join(build, "CMakeCache.txt"), encoding="utf-8") as file:
        return any(re.match(r"MENISCUS_SANITIZER:\w+=.", line) for line in file)


def read_times(path):
    """The times that the file has now."""
    if not os.path.exists(path):
        return {}
    with open(path, encoding="utf-8") as file:
        rows = [line.rstrip("\n").split(" ", 1) for line in file if not line.startswith("#")]
    return {name: float(seconds) for seconds, name in rows}


def main():
    """Writes the file."""
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    folder = os.path.join(sys.argv[1], "Testing", "Temporary")
    processes, times = times_of_processes(folder)
    for name, seconds in times_of_ctest(folder).items():
        if name not in processes:
            times[name] = seconds
    sanitized = has_sanitizer(sys.argv[1])
    target = os.path.join(ROOT, "Testing", f'{"Sanitizer" if sanitized else "Test"}Times.txt')
    if sanitized:
        times = {**read_times(target), **times}
    with open(target, "w", encoding="utf-8") as file:
        file.write(HEADER.format(short=SHORT, script="scripts/test_times.py",
                                 where=" with sanitizers" if sanitized else ""))
        for name in sorted(times):
            if times[name] >= SHORT:
                file.write(f"{math.ceil(times[name])} {name}\n")


if __name__ == "__main__":
    main()
