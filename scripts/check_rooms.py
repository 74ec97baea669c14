#!/usr/bin/env python3
"""usage: scripts/check_rooms.py [ROOT]

Checks the includes between the folders of the library against the table of ARCHITECTURE.md. Each
row of the table names a folder, its subject and the folders that its files may include. They may
also include what these folders may include, unless the row says "only". A folder may only name
folders of rows above its own, so that no arrow points up and no circle is possible. Prints each
include that the table does not allow, each folder without a row, and each name of a row that no
file uses or that follows from another name; exits with 1 if there is any.
"""
import pathlib
import re
import sys

TOPS = ("Module", "Filters", "Rendering")
SUFFIXES = (".h", ".cxx", ".in")
ROW = re.compile(r"^\| `([^`]+)` \| [^|]+ \| ([^|]*) \|$")
INCLUDE = re.compile(r'^\s*#\s*include "([^"]+)"', re.MULTILINE)


def read_table(root):
    """Folders in the order of the table, each with the folders that its row names and the folders
    that follow from these."""
    table = {}
    for line in (root / "ARCHITECTURE.md").read_text(encoding="utf-8").splitlines():
        row = ROW.match(line)
        if row:
            named = re.findall(r"`([^`]+)`", row.group(2))
            implied = set()
            for folder in named:
                implied.update(*table.get(folder, ()))
            table[row.group(1)] = (named, set() if row.group(2).startswith("only") else implied)
    return table


def folder_of_include(root, file, name):
    """Folder of an included file of the project, or None for a file of another project."""
    for base in (root / "Module", root, file.parent, root / "Filters", root / "Rendering"):
        if (base / name).is_file():
            return (base / name).resolve().parent.relative_to(root).as_posix()
    return None


def find_arrows(root):
    """Pairs of folders with the includes between them."""
    arrows = {}
    folders = set()
    for top in TOPS:
        for file in sorted((root / top).rglob("*")):
            if file.suffix not in SUFFIXES or not file.is_file():
                continue
            folder = file.parent.relative_to(root).as_posix()
            folders.add(folder)
            for name in INCLUDE.findall(file.read_text(encoding="utf-8")):
                target = folder_of_include(root, file, name)
                if target and target != folder:
                    arrows.setdefault((folder, target), []).append(
                        f"{file.relative_to(root)} includes {name}")
    return folders, arrows


def main():
    root = pathlib.Path(sys.argv[1] if len(sys.argv) > 1 else ".").resolve()
    table = read_table(root)
    order = {folder: number for number, folder in enumerate(table)}
    folders, arrows = find_arrows(root)
    faults = [f"{folder}: no row in ARCHITECTURE.md" for folder in sorted(folders - set(table))]
    faults += [f"{folder}: a row of ARCHITECTURE.md without files" for folder in table
               if folder not in folders]
    for folder, (named, implied) in table.items():
        for target in named:
            if order.get(target, len(order)) >= order[folder]:
                faults.append(f"{folder} -> {target}: an arrow up in ARCHITECTURE.md")
            if (folder, target) not in arrows:
                faults.append(f"{folder} -> {target}: allowed in ARCHITECTURE.md, but not used")
            if target in implied:
                faults.append(f"{folder} -> {target}: follows from another name of the row")
    for (folder, target), includes in sorted(arrows.items()):
        if not any(target in targets for targets in table.get(folder, ())):
            faults += [f"{folder} -> {target} is not allowed: {text}" for text in includes]
    print("\n".join(faults), end="\n" if faults else "")
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
