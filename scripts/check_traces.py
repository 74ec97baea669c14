#!/usr/bin/env python3
"""usage: scripts/check_traces.py [ROOT]

Checks the traces of ARCHITECTURE.md, numbered steps of the form "1. `file`, `function`: ...": each
file has the function, and each step has the next number. Checks that the files and names between
backquotes in ARCHITECTURE.md and Documentation/extending.md exist, and that "`name` in `file`" is
true; parts of a name between < and > stand for any. ARCHITECTURE.md must name the classes of the
list in Module/CMakeLists.txt, which are the public ones. Prints each fault; exits with 1 if there
is any, or if a trace is missing.
"""
import os
import pathlib
import re
import sys

STEP = re.compile(r"^(\d+)\. `([^`]+)`, `([^`]+)`:", re.MULTILINE)
TRACES = ("From a scalar to a pixel", "From a membrane vertex to a virtual vertex")
PAGES = ("ARCHITECTURE.md", "Documentation/extending.md")
CODE = (".cmake", ".cxx", ".glsl", ".h", ".in", ".md", ".module", ".py", ".toml", ".txt", ".xml")
WORD = re.compile(r"[A-Za-z_]\w*")
NAME = re.compile(r"([A-Za-z_]\w*)(::[A-Za-z_]\w*)*(\(\))?")
FILE = re.compile(r"[\w./<>-]+")
PLACE = re.compile(r"`([\w:]+)(?:\(\))?`\s+(?:in|of)\s+`([\w./-]+\.\w+)`")


def read(file):
    return file.read_text(encoding="utf-8", errors="replace")


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
                           read(file)):
            yield f"{where}: {name} has no {function}"


def list_files(root):
    """Paths of the project's files, relative to its root, without those of builds."""
    files = []
    for folder, folders, names in os.walk(root):
        folders[:] = [name for name in folders
                      if not name.startswith((".", "build")) and name != "__pycache__"]
        files += [(pathlib.Path(folder) / name).relative_to(root).as_posix() for name in names]
    return files


def name_faults(root, page, files, words):
    """Files and names of a page that are neither among the files nor among the words."""
    text = re.sub(r"^```.*?^```", "", read(root / page), flags=re.MULTILINE | re.DOTALL)
    for span in sorted(set(re.findall(r"`([^`\n]+)`", text))):
        if NAME.fullmatch(span):
            missing = [word for word in WORD.findall(span) if word not in words]
            if missing:
                yield f"{page}: no {missing[0]}"
        elif FILE.fullmatch(span) and ("/" in span or span.endswith(CODE)):
            # A folder, a file of any folder, or the end of a path.
            pattern = re.sub(r"<[^>]*>", "[^/]*", re.escape(span.rstrip("/")))
            if not any(re.search(rf"(^|/){pattern}(/|$)", file) for file in files):
                yield f"{page}: no file {span}"
    for name, end in PLACE.findall(text):
        places = [file for file in files if file == end or file.endswith("/" + end)]
        if places and not any(re.search(rf"\b{name.split('::')[-1]}\b", read(root / place))
                              for place in places):
            yield f"{page}: {end} has no {name}"


def class_faults(root, text):
    """Public classes that ARCHITECTURE.md does not name."""
    file = root / "Module" / "CMakeLists.txt"
    found = re.search(r"^set\(classes$(.*?)\)", read(file) if file.is_file() else "",
                      re.MULTILINE | re.DOTALL)
    for name in found.group(1).split() if found else ():
        stem = pathlib.PurePath(name).name
        if not re.search(rf"\b{stem}\b", text):
            yield f"ARCHITECTURE.md: no {stem}"


def main():
    root = pathlib.Path(sys.argv[1] if len(sys.argv) > 1 else ".")
    text = read(root / "ARCHITECTURE.md")
    faults = [fault for title in TRACES
              for fault in trace_faults(root, title, section(text, title))]
    faults += class_faults(root, text)
    files = list_files(root)
    words = {pathlib.PurePath(file).stem for file in files}
    for file in files:
        if file.endswith(CODE) and file not in PAGES:
            words.update(WORD.findall(read(root / file)))
    for page in PAGES:
        if (root / page).is_file():
            faults += name_faults(root, page, files, words)
    print("\n".join(faults), end="\n" if faults else "")
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
