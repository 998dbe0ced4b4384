"""simulate, rolling and swimmer of the Python module."""

import pathlib
import tempfile
import unittest

import numpy as np

import viscontact
from cases import DATA, values

LECTURE = DATA / "cases/lecture.toml"
FIT = DATA / "fits/lecture.json"
INCLINE = DATA / "cases/rolling/incline.toml"


class SimulateTest(unittest.TestCase):
    def test_has_the_bits_of_the_library(self):
        for model in "inertial", "viscous_contact":
            trajectory = viscontact.simulate(LECTURE, FIT, models=[model])[model]
            np.testing.assert_array_equal(
                np.column_stack([trajectory.time, trajectory.gap, trajectory.velocity]),
                values("simulate", LECTURE, FIT, model))

    def test_all_models_of_the_case(self):
        motion = viscontact.simulate(LECTURE, viscontact.Fit(FIT))
        self.assertIn("reference", motion)
        # README's smallest gap of the model inertial, printed with six digits.
        self.assertAlmostEqual(motion["inertial"].gap.min(), 0.00296729, delta=5e-9)
        contact = motion["viscous_contact"]
        self.assertTrue(np.all(contact["gamma"] <= 0))
        self.assertTrue(np.all(np.isnan(motion["inertial"].gamma)))
        self.assertAlmostEqual(contact.about["film_from_gamma"], 0.000873904, delta=5e-10)
        np.testing.assert_allclose(contact.about["contact_interval"], [0.4467, 4], atol=5e-5)
        m, about = 20, motion["inertial"].about
        # The balance of momentum; the impulse of the drag is computed from it.
        self.assertAlmostEqual(about["external_impulse"] + about["film_impulse"],
                               m * motion["inertial"].velocity[-1], delta=1e-9)

    def test_other_numbers(self):
        of_case = viscontact.simulate(LECTURE, FIT, models=["inertial"])["inertial"]
        thick = viscontact.simulate(LECTURE, FIT, models=["inertial"],
                                    values={"fluid.viscosity": 6.0})["inertial"]
        self.assertGreater(thick.gap.min(), 5 * of_case.gap.min())
        with self.assertRaisesRegex(viscontact.InputError, "no_such_key"):
            viscontact.simulate(LECTURE, FIT, values={"sphere.no_such_key": 1.0})

    def test_refusals(self):
        with self.assertRaisesRegex(viscontact.InputError, "the drag is not given.*give fit="):
            viscontact.simulate(LECTURE)
        with self.assertRaisesRegex(viscontact.InputError, "no model is named 'x'"):
            viscontact.simulate(LECTURE, FIT, models=["x"])
        with self.assertRaisesRegex(viscontact.InputError, "models is an empty list"):
            viscontact.simulate(LECTURE, FIT, models=[])
        with self.assertRaises(TypeError):
            viscontact.simulate(LECTURE, 3)


class RollingTest(unittest.TestCase):
    def test_has_the_bits_of_the_library(self):
        for model in "rough", "viscous_contact":
            motion = viscontact.rolling(INCLINE, models=[model])[model]
            np.testing.assert_array_equal(
                np.column_stack([motion.time, motion.gap, motion.position,
                                 motion.angular_velocity]),
                values("rolling", INCLINE, model))

    def test_about_and_refusals(self):
        fit = viscontact.PairFit(DATA / "fits/pairs/plane.json")
        motion = viscontact.rolling(INCLINE, fit, models=["rough"])["rough"]
        touches = motion.contact > 0
        self.assertEqual(motion.about["contact_time"], motion.time[touches][0])
        self.assertEqual(motion.about["smallest_gap"], motion.gap.min())
        with self.assertRaisesRegex(viscontact.InputError, "no model is named"):
            viscontact.rolling(INCLINE, models=["x"])
        with self.assertRaisesRegex(viscontact.InputError, "models is an empty list"):
            viscontact.rolling(INCLINE, models=[])


class SwimmerTest(unittest.TestCase):
    CASE = DATA / "cases/swimmer/three_spheres.toml"

    def test_the_strokes_of_the_case(self):
        strokes = viscontact.swimmer(self.CASE, DATA / "tables/three_spheres.csv", intervals=100)
        square, optimal = strokes["stroke"], strokes["optimal"]
        self.assertEqual(square.arms.shape[1], 2)
        self.assertEqual(square.forces.shape, (len(square.time), 3))
        # No force acts on the swimmer as a whole.
        np.testing.assert_allclose(square.forces.sum(axis=1), 0, atol=1e-10)
        np.testing.assert_allclose(square.arms[0], [6, 6])
        # The energy is the integral of the power, here by the trapezoidal rule on 100 intervals.
        energy = np.sum(np.diff(square.time) * (square.power[1:] + square.power[:-1]) / 2)
        self.assertAlmostEqual(energy / square.about["energy"], 1, delta=0.05)
        self.assertAlmostEqual(optimal.about["displacement"], 0.2, delta=1e-9)
        self.assertGreater(optimal.about["efficiency"], square.about["efficiency"])

    def test_refuses_the_table_of_another_case(self):
        text = (DATA / "cases/swimmer/three_spheres.toml").read_text()
        with tempfile.TemporaryDirectory() as folder:
            other = pathlib.Path(folder) / "other.toml"
            other.write_text(text.replace("count = 12", "count = 11"))
            with self.assertRaisesRegex(viscontact.InputError, "three_spheres.csv: is not the table"):
                viscontact.swimmer(other, DATA / "tables/three_spheres.csv")
            with self.assertRaisesRegex(viscontact.Error, "lacks swimmer.table"):
                viscontact.swimmer(other)

    def test_scales_the_table_that_the_case_names(self):
        lecture = DATA / "cases/swimmer/lecture.toml"
        stroke = viscontact.swimmer(lecture)["stroke"]
        # In radii of 5e-5 m, between arms of 3 and 6: Stokes flow has no length of its own.
        self.assertLess(abs(stroke.forces.sum(axis=1)).max(), 1e-10 * abs(stroke.forces).max())
        np.testing.assert_allclose(stroke.arms.max(axis=0), [3e-4, 3e-4])
        with self.assertRaisesRegex(viscontact.Error, "has swimmer.table"):
            viscontact.swimmer(lecture, DATA / "tables/three_spheres.csv")


if __name__ == "__main__":
    unittest.main()
