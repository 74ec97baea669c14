#!/usr/bin/env python3
# SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
# SPDX-License-Identifier: BSD-3-Clause
"""Validates every variant of the shaders by glslangValidator: check_shaders.py PROGRAM

PROGRAM (meniscus_shader_sources) writes the complete sources. Exits with 125, which CTest counts as
skipped, if there is no glslangValidator.
"""

import concurrent.futures
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile

SKIPPED = 125
# Files per call; the validator takes longer to start than to check a file.
BATCH = 100


def validate(validator, files):
    """Return the validator's messages on the files of one call that it rejects."""
    result = subprocess.run([validator, *map(str, files)], stdout=subprocess.PIPE,
                            stderr=subprocess.STDOUT, text=True)
    if result.returncode == 0:
        return []
    faults = []
    name = ""
    for line in result.stdout.splitlines():
        name = pathlib.Path(line).name if line in map(str, files) else name
        faults += [f"{name}: {line}"] if line.startswith("ERROR: ") else []
    return faults or [f"{validator} ended with {result.returncode}"]


def find_faults(validator, files):
    """Return the validator's messages on the files that it rejects."""
    batches = [files[begin:begin + BATCH] for begin in range(0, len(files), BATCH)]
    with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
        return sum(pool.map(lambda batch: validate(validator, batch), batches), [])


def rejects_faults(validator, folder):
    """Return True if the validator finds the fault in a shader that has one."""
    faulty = folder / "faulty.frag"
    faulty.write_text("#version 150\nout vec4 color;\nvoid main() { color = missing; }\n")
    found = bool(find_faults(validator, [faulty]))
    faulty.unlink()
    return found


def main():
    validator = shutil.which("glslangValidator")
    if not validator:
        print("skipped: no glslangValidator (Debian: glslang-tools)")
        return SKIPPED
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        if not rejects_faults(validator, folder):
            print("the validator accepts a shader with a fault")
            return 1
        subprocess.run([sys.argv[1], name], check=True)
        files = sorted(path for path in folder.iterdir())
        unreplaced = [path.name for path in files
                      if any(line.startswith("//VTK::") for line in path.read_text().splitlines())]
        faults = [f"{name}: a tag was not replaced" for name in unreplaced]
        faults += find_faults(validator, files)
        print(f"{len(files)} shaders, {len(faults)} faults")
        print("\n".join(faults[:40]))
        return 1 if faults or not files else 0


if __name__ == "__main__":
    sys.exit(main())
