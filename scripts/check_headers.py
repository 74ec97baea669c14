#!/usr/bin/env python3
# SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
# SPDX-License-Identifier: BSD-3-Clause
"""Compiles each header by itself, without precompiled headers: a header includes what it uses.

usage: check_headers.py BUILD... [HEADER.h...]

The flags are those of compile_commands.json in the build folders. The named headers are checked,
or all of Module, Filters and Rendering.
"""
import concurrent.futures
import json
import os
import re
import shlex
import subprocess
import sys

ROOT = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
FOLDERS = ("Module", "Filters", "Rendering")
# Headers for another processor, and lists that are included in the middle of a source.
LEFT_OUT = {"Module/Simd/SimdNEON.h", "Module/Simd/SimdAVX2.h", "Module/Simd/SimdAVX512.h",
            "Module/Simd/SimdRowLoads.h"}


def flags_of_folders(builds):
    """Flags of one source per folder, without the source, the output, and precompiled headers."""
    flags = {}
    for build in builds:
        with open(os.path.join(build, "compile_commands.json"), encoding="utf-8") as file:
            commands = json.load(file)
        for command in commands:
            kept = kept_words(shlex.split(command["command"]))
            for source in sources_of(os.path.join(command["directory"], command["file"])):
                folder = os.path.dirname(os.path.relpath(source, ROOT))
                flags.setdefault(folder, (kept, command["directory"]))
    return flags


def sources_of(path):
    """The file itself, or the sources that CMake's unity build compiles together in it."""
    if not os.path.basename(path).startswith("unity_"):
        return [path]
    with open(path, encoding="utf-8") as file:
        return re.findall(r'^#include "(.*)"$', file.read(), re.MULTILINE)


def kept_words(words):
    """The words of a compiler's command that matter for a header alone."""
    kept = [words[1] if os.path.basename(words[0]) == "ccache" else words[0]]
    i = words.index(kept[0]) + 1
    while i < len(words):
        if words[i] in ("-o", "-MF", "-MT", "-include", "-c", "-Xclang", "-include-pch"):
            i += 2
        elif words[i].startswith(("-MD", "-Winvalid-pch", "-fpch")):
            i += 1
        else:
            kept.append(words[i])
            i += 1
    return kept


def find_flags(flags, folder):
    """Flags of the folder, or of the nearest one above it or below it."""
    above = folder
    while above and above not in flags:
        above = os.path.dirname(above)
    if above:
        return flags[above]
    below = [name for name in flags if name.startswith(folder.split("/")[0] + "/")]
    return flags[min(below)] if below else None


def check(header, flags):
    """The compiler's messages about the header, empty if there are none."""
    command, directory = flags
    result = subprocess.run(
        command + ["-fsyntax-only", "-x", "c++", "-w", os.path.join(ROOT, header)],
        cwd=directory, capture_output=True, text=True, check=False)
    return result.stderr if result.returncode else ""


def headers_among(names):
    """The named headers, or all, without the headers that cannot stand by themselves."""
    if not names:
        names = subprocess.run(
            ["git", "-c", "safe.directory=" + ROOT, "ls-files"] + [f + "/*.h" for f in FOLDERS],
            cwd=ROOT, capture_output=True, text=True, check=True).stdout.split()
    return [name for name in names if name.split("/")[0] in FOLDERS and name not in LEFT_OUT
            and os.path.exists(os.path.join(ROOT, name))]


def main():
    """Checks the headers; returns the number of headers that fail."""
    names = [word for word in sys.argv[1:] if word.endswith(".h")]
    builds = [word for word in sys.argv[1:] if word not in names]
    if not builds:
        sys.exit(__doc__)
    flags = flags_of_folders(builds)
    jobs = [(name, find_flags(flags, os.path.dirname(name))) for name in headers_among(names)]
    jobs = [job for job in jobs if job[1]]
    with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
        messages = list(pool.map(lambda job: check(*job), jobs))
    failed = 0
    for (name, _), message in zip(jobs, messages):
        if message:
            failed += 1
            print(name + " cannot be compiled by itself:\n" + "\n".join(message.splitlines()[:4]))
    print(f"{len(jobs)} headers, {failed} not self-contained")
    return failed


if __name__ == "__main__":
    sys.exit(1 if main() else 0)
