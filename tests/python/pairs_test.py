"""The study of two free spheres, scripts/pair_study, against data/reference/two_free_spheres_in_shear.csv."""
import csv
import os
import pathlib
import subprocess
import sys
import unittest

SOURCE = pathlib.Path(os.environ["VISCONTACT_SOURCE"])


class PairStudyTest(unittest.TestCase):
    def test_has_the_smallest_gaps_of_exact_resistances(self):
        found = subprocess.run([sys.executable, SOURCE / "scripts/pair_study", "--gaps"], check=True, text=True,
                               capture_output=True).stdout.splitlines()
        with open(SOURCE / "data/reference/two_free_spheres_in_shear.csv") as lines:
            rows = list(csv.DictReader(line for line in lines if not line.startswith("#")))
        self.assertEqual(len(found), len(rows))
        for line, row in zip(found, rows):
            offset, gap = map(float, line.split())
            self.assertEqual(offset, float(row["offset"]))
            # The errors of the matrix, 1e-6, are amplified on the way.
            self.assertAlmostEqual(gap / float(row["smallest_gap"]), 1, delta=1e-4)


if __name__ == "__main__":
    unittest.main()
