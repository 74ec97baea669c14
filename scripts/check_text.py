#!/usr/bin/env python3
"""usage: scripts/check_text.py FILE...

Checks the text of sources and pages: no line is wider than 100 columns, and no comment opens with a
construction that leaves its subject out ("What ...", "Of ...", "Whether it matters ..."). Tables,
links and code of pages may be wider. Prints each fault as FILE:LINE; exits with 1 if there is any.
"""
import pathlib
import re
import sys

WIDTH = 100
COMMENTED = (".h", ".cxx", ".glsl")
# A comment's first words: after its mark, at the start of a block or of a line of its own.
OPENING = re.compile(r"^(?:What|Of|Whether it|Beside)\b")


def find_wide_lines(path, lines):
    """Numbers of lines that are wider than the limit."""
    code = False
    for number, line in enumerate(lines, 1):
        if path.suffix == ".md":
            if line.startswith("```"):
                code = not code
            if code or line.startswith(("|", "    ")) or "](" in line or "://" in line:
                continue
        if len(line) > WIDTH:
            yield number, f"{len(line)} columns, at most {WIDTH}"


def find_openings(lines):
    """Numbers of the lines on which a comment opens badly."""
    before = ""  # the comment's line before, stripped; empty at the start of a comment
    block = False
    for number, line in enumerate(lines, 1):
        text = line.strip()
        start = None
        if block:
            body = re.sub(r"^\*+/?\s?", "", text)
            start = body if before in ("", "/**", "/*") else None
            before = body or ""
            block = "*/" not in text
        elif text.startswith(("/**", "/*")):
            body = re.sub(r"^/\*+\s?", "", text)
            block = "*/" not in text
            before = body if body else "/**"
            start = body
        elif text.startswith("//"):
            body = re.sub(r"^//+<?\s?", "", text)
            start = body if before == "" else None
            before = body
        else:
            before = ""
            trailing = re.search(r"\s(?:///<|//|/\*\*<)\s?(.*)$", line)
            start = trailing.group(1) if trailing else None
        if start and OPENING.match(start):
            yield number, f'a comment that opens with "{start.split()[0]}"'


def main():
    faults = []
    for name in sys.argv[1:]:
        path = pathlib.Path(name)
        lines = path.read_text(encoding="utf-8").splitlines()
        found = list(find_wide_lines(path, lines))
        if path.suffix in COMMENTED:
            found += find_openings(lines)
        faults += [f"{name}:{number}: {fault}" for number, fault in sorted(found)]
    print("\n".join(faults), end="\n" if faults else "")
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
