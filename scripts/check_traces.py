#!/usr/bin/env python3
"""usage: scripts/check_traces.py [ROOT]

Checks the traces of ARCHITECTURE.md, numbered steps of the form "1. `file`, `function`: ...": each
file has the function, and each step has the next number. Prints each fault; exits with 1 if there
is any, or if a trace is missing.
"""
import pathlib
import re
import sys

STEP = re.compile(r"^(\d+)\. `([^`]+)`, `([^`]+)`:", re.MULTILINE)
TRACES = ("From a scalar to a pixel", "From a membrane vertex to a virtual vertex")


def section(text, title):
    """The text between a heading and the next one."""
    pattern = r"^## " + re.escape(title) + r"\n(.*?)(?=^## |\Z)"
    found = re.search(pattern, text, re.MULTILINE | re.DOTALL)
    return found.group(1) if found else ""


def trace_faults(root, title, text):
    steps = STEP.findall(text)
    if len(steps) < 2:
        yield f'{title}: a trace without steps'
    for place, (number, name, function) in enumerate(steps, 1):
        where = f"{title}, step {number}"
        if int(number) != place:
            yield f"{where}: {place} was expected"
        file = root / name
        if not file.is_file():
            yield f"{where}: no file {name}"
        elif not re.search(r"\b" + re.escape(function.split("::")[-1]) + r"\s*\(",
                           file.read_text(encoding="utf-8")):
            yield f"{where}: {name} has no {function}"


def main():
    root = pathlib.Path(sys.argv[1] if len(sys.argv) > 1 else ".")
    text = (root / "ARCHITECTURE.md").read_text(encoding="utf-8")
    faults = [fault for title in TRACES
              for fault in trace_faults(root, title, section(text, title))]
    print("\n".join(faults), end="\n" if faults else "")
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
