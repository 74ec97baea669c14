#!/usr/bin/env python3
"""usage: collect_pages.py FOLDER

Copies the pages and images of the tree, and every file that a page links to, under the same paths
to FOLDER, for scripts/site. A link that leads nowhere is an error."""
import pathlib
import re
import shutil
import sys

ROOT = pathlib.Path(__file__).resolve().parent.parent
LINK = re.compile(r"\]\(([^)#\s]+)(?:#[^)]*)?\)")
CODE = re.compile(r"^```.*?^```", re.MULTILINE | re.DOTALL)


def linked(page):
    """Files that a page links to."""
    text = CODE.sub("", page.read_text())
    return [(page.parent / target).resolve() for target in LINK.findall(text)
            if not re.match(r"[a-z]+:", target)]


def main(folder):
    waiting = [ROOT / "README.md", ROOT / "Documentation" / "README.md"]
    copied = set()
    while waiting:
        file = waiting.pop()
        if file in copied:
            continue
        if not file.is_file():
            sys.exit("error: a page links to %s, which is no file" % file.relative_to(ROOT))
        copied.add(file)
        target = folder / file.relative_to(ROOT)
        target.parent.mkdir(parents=True, exist_ok=True)
        shutil.copyfile(file, target)
        if file.suffix == ".md":
            waiting.extend(linked(file))


if __name__ == "__main__":
    main(pathlib.Path(sys.argv[1]))
