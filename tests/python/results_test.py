"""read() of the Python module, tabulate(), Ctrl-C and threads."""

import os
import pathlib
import signal
import subprocess
import sys
import tempfile
import threading
import time
import tomllib
import unittest

import numpy as np

import viscontact
from cases import DATA, SOURCE

PROGRAM = os.environ["VISCONTACT_PROGRAM"]


class OtherPythonTest(unittest.TestCase):
    def test_a_library_for_another_python_is_named(self):
        package = pathlib.Path(viscontact.__file__).parent
        with tempfile.TemporaryDirectory() as folder:
            copy = pathlib.Path(folder) / "viscontact"
            copy.mkdir()
            for file in package.glob("*.py"):
                (copy / file.name).write_bytes(file.read_bytes())
            for library in "_core.cpython-39-x86_64-linux-gnu.so", None:
                if library:
                    (copy / library).touch()
                done = subprocess.run([sys.executable, "-c", "import viscontact"], cwd=folder,
                                      env={**os.environ, "PYTHONPATH": folder},
                                      capture_output=True, text=True)
                self.assertEqual(done.returncode, 1)
                self.assertIn(f"ImportError: {copy} has {library or 'no library'}", done.stderr)
                self.assertIn(sys.executable, done.stderr)
                if library:
                    (copy / library).unlink()


class ReadTest(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)

    def test_a_run_of_many_particles(self):
        case = DATA / "cases/particles/lottery_friction.toml"
        text = case.read_text().replace("end_time = 24.0", "end_time = 0.5")
        text = text.replace('"lottery.csv"', f'"{case.parent}/lottery.csv"')
        short = self.folder / "case.toml"
        short.write_text(text)
        subprocess.run([PROGRAM, "particles", short, "-o", self.folder / "run"], check=True,
                       capture_output=True)
        run = viscontact.read(self.folder / "run")
        p = viscontact.Particles(short)
        self.assertEqual(p.run(), run["run.json"]["steps"])
        final = run["final_particles.csv"]
        np.testing.assert_array_equal(np.column_stack([final.x, final.y, final.z]), p.positions)
        np.testing.assert_array_equal(final.id, p.ids)
        self.assertEqual(final.id.dtype.kind, "i")
        self.assertEqual(final.about["provenance"]["command"][1], "particles")
        self.assertIn("steps.csv", run)
        self.assertNotIn("no_such_file.csv", run)
        frames = run.frames
        self.assertEqual(len(frames), 6)
        np.testing.assert_allclose(frames.times, np.arange(6) / 10, atol=1e-12)
        last = frames[-1]
        np.testing.assert_array_equal(last.points, p.positions)
        np.testing.assert_array_equal(last.orientation, p.orientations)
        now, in_file = p.contacts(), last.about["cells"]
        self.assertEqual(sorted(now.gap), sorted(in_file.gap))
        self.assertEqual(sorted(now.normal_force), sorted(in_file.normal_force))
        self.assertEqual(len(frames[1:3]), 2)

    def test_a_run_of_one_sphere(self):
        subprocess.run([PROGRAM, "simulate", DATA / "cases/lecture.toml", "--fit",
                        DATA / "fits/lecture.json", "-o", self.folder / "run"], check=True,
                       capture_output=True)
        run = viscontact.read(self.folder / "run")
        motion = viscontact.simulate(DATA / "cases/lecture.toml", DATA / "fits/lecture.json")
        self.assertLessEqual({f"trajectories/{model}.csv" for model in motion}, set(run))
        for model, trajectory in motion.items():
            for name, column in trajectory.items():
                np.testing.assert_array_equal(run[f"trajectories/{model}.csv"][name], column)
        self.assertEqual(run["fit.json"]["basis"], "lecture")

    def test_pandas_if_it_is_there(self):
        try:
            import pandas  # noqa: F401
        except ImportError:
            self.skipTest("pandas is not installed")
        table = viscontact.read(DATA / "tables/lecture.csv").pandas()
        self.assertEqual(len(table), 40)

    def test_refusals(self):
        with self.assertRaisesRegex(viscontact.InputError, "no_such_file.csv: there is no"):
            viscontact.read("no_such_file.csv")
        with self.assertRaisesRegex(viscontact.InputError, "no_such_folder: there is no such file"):
            viscontact.read("no_such_folder")
        with self.assertRaisesRegex(viscontact.InputError, "files with this ending"):
            viscontact.read(DATA / "cases/lecture.toml")
        bad = self.folder / "bad.csv"
        bad.write_text("a,b\n1,2\n3\n")
        with self.assertRaisesRegex(viscontact.InputError, "row 2 has 1 fields"):
            viscontact.read(bad)
        with self.assertRaisesRegex(AttributeError, "no column 'x'; it has gap"):
            viscontact.read(DATA / "tables/lecture.csv").x


class CallsTest(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)

    def long_case(self):
        case = DATA / "cases/particles/lottery_friction.toml"
        text = case.read_text().replace('"lottery.csv"', f'"{case.parent}/lottery.csv"')
        path = self.folder / "long.toml"
        path.write_text(text.replace("end_time = 24.0", "end_time = 1e6"))
        return path

    def test_interrupt_stops_a_long_call_and_keeps_the_state(self):
        p = viscontact.Particles(self.long_case())
        timer = threading.Timer(0.3, os.kill, (os.getpid(), signal.SIGINT))
        timer.start()
        handler = signal.getsignal(signal.SIGINT)
        before = time.monotonic()
        with self.assertRaises(KeyboardInterrupt):
            p.run()
        self.assertLess(time.monotonic() - before, 10)
        self.assertEqual(signal.getsignal(signal.SIGINT), handler)
        steps = p.steps
        self.assertGreater(steps, 0)
        p.step()
        self.assertEqual(p.steps, steps + 1)

    def test_interrupt_ends_a_loop_of_steps(self):
        p = viscontact.Particles(self.long_case())
        timer = threading.Timer(0.3, os.kill, (os.getpid(), signal.SIGINT))
        timer.start()
        with self.assertRaises(KeyboardInterrupt):
            while not p.finished:
                p.step()

    def test_other_threads_run_during_a_long_call(self):
        p = viscontact.Particles(self.long_case())
        counts, refusals = [], []

        def count_then_interrupt():
            for k in range(20):
                time.sleep(0.01)
                counts.append(k)
            for refused in p.step, p.run, p.contacts, p.reported_velocities:
                try:
                    refused()
                except viscontact.InputError as error:
                    refusals.append(str(error))
            os.kill(os.getpid(), signal.SIGINT)

        threading.Thread(target=count_then_interrupt).start()
        with self.assertRaises(KeyboardInterrupt):
            p.run()
        self.assertEqual(len(counts), 20)
        self.assertEqual(len(refusals), 4, refusals)
        self.assertRegex(refusals[0], "another thread computes steps")

    def test_tabulate_by_freefem(self):
        case = self.folder / "case.toml"
        text = (DATA / "cases/lecture.toml").read_text()
        case.write_text(text.replace('{ from = 1e-3, to = 2.0, count = 40, spacing = "log" }',
                                     "[0.5, 1.0]").replace("1e-5", "1e-3"))
        for none in [], ():
            with self.assertRaisesRegex(viscontact.InputError, "motions is an empty list"):
                viscontact.tabulate(case, self.folder / "table.csv", motions=none)
        table = viscontact.tabulate(case, self.folder / "table.csv", jobs=1)
        np.testing.assert_array_equal(table.gap, [0.5, 1.0])
        shipped = viscontact.Fit(DATA / "fits/lecture.json")
        # The asked accuracy of the rows and the residual of the fit, 0.46 %.
        np.testing.assert_allclose(table.force, shipped.force(table.gap, -1.0), rtol=6e-3)

    def test_the_module_says_what_it_is(self):
        with open(SOURCE / "pyproject.toml", "rb") as file:
            self.assertEqual(viscontact.__version__, tomllib.load(file)["project"]["version"])
        for name in viscontact.__all__:
            self.assertTrue(getattr(viscontact, name).__doc__, name)
        printed = subprocess.run([sys.executable, "-c", "import viscontact; help(viscontact.Fit)"],
                                 check=True, capture_output=True, text=True).stdout
        self.assertIn("resistance", printed)


if __name__ == "__main__":
    unittest.main()
