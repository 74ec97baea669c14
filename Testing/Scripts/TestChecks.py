# SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
# SPDX-License-Identifier: BSD-3-Clause
"""The checks that scripts/lint calls find the faults that they are for. Argument: the root of the
project."""
import pathlib
import subprocess
import sys
import tempfile
import unittest

SCRIPTS = pathlib.Path(sys.argv.pop(1)) / "scripts"

TABLE = """# Architecture

| Folder | Subject | May include |
|---|---|---|
| `Module/Low` | low |  |
| `Module/High` | high | `Module/Low` |
"""
TRACES = """
## From a scalar to a pixel

1. `Module/Low/Low.h`, `Low::Begin`: begins.
2. `Module/High/High.h`, `High`: ends.

## From a membrane vertex to a virtual vertex

1. `Module/Low/Low.h`, `Begin`: begins.
2. `Module/High/High.h`, `High`: ends.
"""


class Checks(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.root = pathlib.Path(self.folder.name)
        self.write("ARCHITECTURE.md", TABLE + TRACES)
        self.write("Module/Low/Low.h", "/** Depth of a point. */\nvoid Begin();\n")
        self.write("Module/High/High.h", '#include "Low/Low.h"\nvoid High();\n')

    def tearDown(self):
        self.folder.cleanup()

    def write(self, name, text):
        file = self.root / name
        file.parent.mkdir(parents=True, exist_ok=True)
        file.write_text(text, encoding="utf-8")

    def run_check(self, script, *arguments):
        result = subprocess.run(
            [sys.executable, str(SCRIPTS / script), *arguments], stdout=subprocess.PIPE, text=True)
        return result.returncode, result.stdout

    def expect_fault(self, part, script, *arguments):
        status, text = self.run_check(script, *arguments)
        self.assertEqual(status, 1)
        self.assertIn(part, text)

    def rooms(self):
        return self.run_check("check_rooms.py", str(self.root))

    def text_of(self, name):
        return "check_text.py", str(self.root / name)

    def test_a_clean_tree_passes(self):
        self.assertEqual(self.rooms(), (0, ""))
        self.assertEqual(self.run_check("check_traces.py", str(self.root)), (0, ""))
        self.assertEqual(self.run_check(*self.text_of("Module/Low/Low.h")), (0, ""))

    def test_an_include_that_points_up_is_found(self):
        self.write("Module/Low/Low.h", '#include "High/High.h"\nvoid Begin();\n')
        self.expect_fault(
            "Module/Low -> Module/High is not allowed", "check_rooms.py", str(self.root))

    def test_a_row_that_points_up_is_found(self):
        self.write("ARCHITECTURE.md", TABLE.replace("low |  |", "low | `Module/High` |") + TRACES)
        self.write("Module/Low/Low.h", '#include "High/High.h"\nvoid Begin();\n')
        self.expect_fault("an arrow up in ARCHITECTURE.md", "check_rooms.py", str(self.root))

    def test_a_folder_without_a_row_is_found(self):
        self.write("Module/New/New.h", "void New();\n")
        self.expect_fault("Module/New: no row", "check_rooms.py", str(self.root))

    def test_an_arrow_without_an_include_is_found(self):
        self.write("Module/High/High.h", "void High();\n")
        self.expect_fault(
            "allowed in ARCHITECTURE.md, but not used", "check_rooms.py", str(self.root))

    def write_top(self, column):
        row = f"| `Module/Top` | top | {column} |\n"
        self.write("ARCHITECTURE.md", TABLE + row + TRACES)
        self.write("Module/Top/Top.h", '#include "High/High.h"\n#include "Low/Low.h"\n')

    def test_a_folder_may_include_what_its_folders_may(self):
        self.write_top("`Module/High`")
        self.assertEqual(self.rooms(), (0, ""))

    def test_only_the_folders_of_a_row_with_only(self):
        self.write_top("only `Module/High`")
        self.expect_fault(
            "Module/Top -> Module/Low is not allowed", "check_rooms.py", str(self.root))
        self.write_top("only `Module/Low`, `Module/High`")
        self.assertEqual(self.rooms(), (0, ""))

    def test_a_name_that_follows_from_another_is_found(self):
        self.write_top("`Module/Low`, `Module/High`")
        self.expect_fault("follows from another name", "check_rooms.py", str(self.root))

    def test_a_public_class_that_the_page_lacks_is_found(self):
        classes = "set(classes\n  ../Filters/Room/vtkLow\n  ../Rendering/vtkHigh)\n"
        self.write("Module/CMakeLists.txt", classes)
        self.write("ARCHITECTURE.md", TABLE + TRACES + "\nvtkLow, vtkHighest\n")
        self.expect_fault("ARCHITECTURE.md: no vtkHigh", "check_traces.py", str(self.root))
        self.write("ARCHITECTURE.md", TABLE + TRACES + "\nvtkLow, vtkHigh\n")
        self.assertEqual(self.run_check("check_traces.py", str(self.root)), (0, ""))

    def test_a_trace_without_its_function_is_found(self):
        self.write("Module/Low/Low.h", "void Start();\n")
        self.expect_fault("has no Low::Begin", "check_traces.py", str(self.root))

    def test_a_missing_trace_is_found(self):
        self.write("ARCHITECTURE.md", TABLE)
        self.expect_fault("a trace without steps", "check_traces.py", str(self.root))

    def test_names_that_a_recipe_invents_are_found(self):
        page = "Documentation/extending.md"
        true = ("`Begin()` in `Module/Low/Low.h`, `Low.h`, `Module/<Name>/High.h`, `Module/High`,\n"
                "`cmake --build`, `a.b`\n\n```\n`Nothing`\n```\n")
        self.write(page, true)
        self.assertEqual(self.run_check("check_traces.py", str(self.root)), (0, ""))
        for name, fault in (
                ("`Nothing()`", "no Nothing"),
                ("`Module/Low/Lower.h`", "no file Module/Low/Lower.h"),
                ("`Lower.h`", "no file Lower.h"), ("`Module/Lower`", "no file Module/Lower"),
                ("`High()` in\n`Low.h`", "Low.h has no High")):
            self.write(page, true + "\n" + name + "\n")
            self.expect_fault(page + ": " + fault, "check_traces.py", str(self.root))

    def test_wide_lines_are_found(self):
        self.write("wide.h", "// " + 97 * "x" + "\n// " + 98 * "x" + "\n")
        status, text = self.run_check(*self.text_of("wide.h"))
        self.assertEqual(status, 1)
        self.assertEqual(text.count("columns, at most 100"), 1)
        self.assertIn("wide.h:2:", text)

    def test_tables_and_code_of_pages_may_be_wide(self):
        wide = 120 * "x"
        self.write("page.md", f"| {wide} |\n\n    {wide}\n\n{wide}\n")
        status, text = self.run_check(*self.text_of("page.md"))
        self.assertEqual((status, text.count("columns")), (1, 1))

    def test_openings_of_comments_are_found(self):
        openings = (
            "/** What is kept of a ray. */", "/**\n * Of the rays behind, the mean.\n */",
            "// Whether it matters.", "int a; ///< Of the ray",
            "/**\n * One.\n *\n * What two is.\n */")
        for text in openings:
            self.write("comment.h", text + "\n")
            self.expect_fault("a comment that opens with", *self.text_of("comment.h"))

    def test_sentences_inside_a_comment_may_open_so(self):
        self.write(
            "comment.h",
            "/**\n * Mean of the rays.\n * Of these, none is lost.\n */\n// A\n// What\n")
        self.assertEqual(self.run_check(*self.text_of("comment.h")), (0, ""))


if __name__ == "__main__":
    unittest.main()
