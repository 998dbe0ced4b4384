"""Runs the examples of docs/python.md, of docs/pairs.md and of examples/python as a reader does."""

import contextlib
import io
import os
import pathlib
import re
import subprocess
import sys
import tempfile
import unittest

from cases import SOURCE


class PageTest(unittest.TestCase):
    """The blocks of the page, one after the other in one session, from the source folder. What they
    print must be the block of text that follows, but for numbers: these may differ by the relative
    2e-3 that numbers of README have, because tables and libraries have versions."""

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)
        self.addCleanup(os.chdir, os.getcwd())
        os.chdir(SOURCE)

    def check(self, expected, printed):
        number = re.compile(r"-?\d+(?:\.\d+)?(?:e[-+]?\d+)?")
        self.assertEqual(number.sub("#", expected).split(), number.sub("#", printed).split())
        for one, other in zip(number.findall(expected), number.findall(printed)):
            self.assertAlmostEqual(float(one), float(other),
                                   delta=2e-3 * max(abs(float(one)), 1e-12), msg=printed)

    def test_blocks(self):
        self.check_page("docs/python.md", 5)
        self.check_page("docs/pairs.md", 1)

    def check_page(self, name, fewest):
        page = (SOURCE / name).read_text()
        blocks = re.findall(r"```python\n(.*?)```\n(?:\n```text\n(.*?)```\n)?", page, re.DOTALL)
        self.assertGreater(len(blocks), fewest)
        session = {}
        for code, expected in blocks:
            code = code.replace('"out/', f'"{self.folder}/')
            code = code.replace("build/release/viscontact", os.environ["VISCONTACT_PROGRAM"])
            printed = io.StringIO()
            with contextlib.redirect_stdout(printed):
                exec(compile(code, name, "exec"), session)
            self.check(expected, printed.getvalue())

    def test_examples(self):
        examples = sorted((SOURCE / "examples/python").glob("*.py"))
        self.assertGreaterEqual(len(examples), 3)
        for example in examples:
            with self.subTest(example.name):
                text = example.read_text()
                self.assertIn("\n# %%", text)
                promised = text.split("# It prints:\n#\n")[1]
                promised = re.match(r"(?:#.*\n)*", promised)[0]
                done = subprocess.run([sys.executable, example], capture_output=True, text=True)
                self.assertEqual(done.returncode, 0, done.stderr)
                self.check(re.sub(r"(?m)^# ?", "", promised), done.stdout)


if __name__ == "__main__":
    unittest.main()
