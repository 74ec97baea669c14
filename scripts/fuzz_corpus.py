#!/usr/bin/env python3
# SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
# SPDX-License-Identifier: BSD-3-Clause
"""Packs and unpacks the corpus of the fuzzers: fuzz_corpus.py unpack|pack TARGET [FOLDER]

Testing/Fuzz/Corpus/TARGET.txt has one input per line, as hexadecimal digits; libFuzzer works on
a folder, by default build-fuzz/corpus/TARGET, with one file per input. Packing minimises the folder
first, to inputs that reach different code (libFuzzer's -set_cover_merge), and keeps some of all
lengths if these are too many.
"""

import pathlib
import subprocess
import sys
import tempfile

# Characters of a packed corpus.
MOST = 24000
ROOT = pathlib.Path(__file__).resolve().parent.parent


def unpack(target, lines, folder):
    """Write each input to a file, named by its number."""
    folder.mkdir(parents=True, exist_ok=True)
    for number, line in enumerate(lines):
        (folder / f"kept-{number}").write_bytes(bytes.fromhex(line))


def pack(target, folder):
    """Return the lines of the inputs that are kept, short ones first."""
    program = ROOT / "build-fuzz" / "bin" / f"meniscus_fuzz_{target}"
    with tempfile.TemporaryDirectory() as name:
        subprocess.run([program, "-set_cover_merge=1", "-timeout=60", name, folder], check=True,
                       stderr=subprocess.DEVNULL)
        inputs = {path.read_bytes() for path in pathlib.Path(name).iterdir()}
    lines = [data.hex() for data in sorted(inputs, key=lambda data: (len(data), data)) if data]
    step = 1
    while sum(len(line) + 1 for line in lines[::step]) > MOST:
        step += 1
    return lines[::step]


def main():
    if len(sys.argv) not in (3, 4) or sys.argv[1] not in ("pack", "unpack"):
        sys.exit(__doc__)
    target = sys.argv[2]
    kept = ROOT / "Testing" / "Fuzz" / "Corpus" / f"{target}.txt"
    folder = ROOT / "build-fuzz" / "corpus" / target
    if len(sys.argv) == 4:
        folder = pathlib.Path(sys.argv[3])
    if sys.argv[1] == "unpack":
        unpack(target, kept.read_text().split(), folder)
    else:
        kept.write_text("".join(line + "\n" for line in pack(target, folder)))


if __name__ == "__main__":
    main()
