"""Fit, PairFit, fit and fit_pair of the Python module."""

import json
import pathlib
import tempfile
import unittest

import numpy as np

import viscontact
from cases import DATA, spread, values

LECTURE = DATA / "fits/lecture.json"


class FitTest(unittest.TestCase):
    def test_has_the_bits_of_the_library(self):
        fit = viscontact.Fit(LECTURE)
        gaps = spread(fit.interval)
        expected = values("fit", LECTURE, *map(float.hex, gaps))
        np.testing.assert_array_equal(fit.resistance(gaps), expected[:, 0])
        np.testing.assert_array_equal(fit.impulse(gaps), expected[:, 1])
        np.testing.assert_array_equal(fit.force(gaps, -2.5), -expected[:, 0] * -2.5)

    def test_takes_numbers_lists_and_arrays_of_any_shape_and_type(self):
        fit = viscontact.Fit(str(LECTURE))
        one = fit.resistance(0.25)
        self.assertIsInstance(one, float)
        self.assertEqual(fit.resistance([0.25, 0.5])[0], one)
        gaps = np.full((2, 3, 4), 0.25, dtype=np.float32)[:, ::2]
        np.testing.assert_array_equal(fit.resistance(gaps), np.full((2, 2, 4), one))
        self.assertEqual(fit.resistance(np.zeros((0, 3))).shape, (0, 3))
        self.assertIsInstance(fit.force(0.25, 1), float)
        forces = fit.force([[0.25], [0.5]], [1, 2, 3])
        self.assertEqual(forces.shape, (2, 3))
        self.assertEqual(forces[0, 2], -3 * one)

    def test_impulse_and_its_inverse(self):
        fit = viscontact.Fit(LECTURE)
        gaps = spread(fit.interval)
        # The inverse is exact to round-off of ln(gap), some units in the last place of the gap.
        np.testing.assert_allclose(fit.gap_of_impulse(fit.impulse(gaps)), gaps, rtol=1e-13)

    def test_says_what_the_file_says(self):
        fit = viscontact.Fit(LECTURE)
        self.assertEqual(fit.basis, "lecture")
        self.assertEqual(list(fit.terms), ["1/q", "1", "q", "q^2", "q^3"])
        self.assertEqual((fit.radius, fit.viscosity), (1, 3))
        self.assertLess(fit.largest_relative_residual, 0.01)
        by_hand = sum(c * 0.01 ** p for c, p in zip(fit.terms.values(), (-1, 0, 1, 2, 3)))
        # The sum is rounded in another order.
        self.assertAlmostEqual(fit.resistance(0.01) * -fit.reference_velocity / by_hand, 1,
                               delta=1e-14)

    def test_is_scaled_to_another_sphere_and_fluid(self):
        fit = viscontact.Fit(LECTURE)
        scaled = viscontact.Fit(LECTURE, radius=2, viscosity=6)
        # R is proportional to viscosity and radius at equal gap/radius; sums are rounded anew.
        np.testing.assert_allclose(scaled.resistance(2 * 0.3), 4 * fit.resistance(0.3), rtol=1e-13)

    def test_outside_the_interval(self):
        fit = viscontact.Fit(LECTURE)
        low, high = fit.interval
        with self.assertRaisesRegex(viscontact.InputError, "outside the fitted interval"):
            fit.resistance([high, low / 2])
        with self.assertRaises(ValueError):
            fit.resistance(float("nan"))
        limits = viscontact.Fit(LECTURE, below="lubrication_limit", above="stokes_limit")
        # The container of the table has the height 80, so that the sphere touches its lid at 78.
        lid = 80 - 2 * fit.radius
        self.assertEqual(limits.interval, (0, lid))
        self.assertGreater(limits.resistance(low / 1000), 900 * fit.resistance(low))
        with self.assertRaisesRegex(viscontact.InputError, "touches the wall opposite"):
            limits.resistance(lid)
        stokes = 6 * np.pi * fit.viscosity * fit.radius
        # Lubrication theory is met but for Stokes' drag, of which it is the multiple 1/1e-6.
        self.assertAlmostEqual(limits.resistance(lid - 1e-6) / stokes * 1e-6, 1, delta=1e-5)

    def test_in_an_unbounded_fluid_has_stokes_drag_far_away(self):
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder) / "unbounded.json"
            bounded = json.loads(LECTURE.read_text())
            path.write_text(json.dumps(bounded | {"container": "unbounded"}))
            fit = viscontact.Fit(path, above="stokes_limit")
        self.assertEqual(fit.interval[1], float("inf"))
        stokes = 6 * np.pi * fit.viscosity * fit.radius
        # Stokes' drag is met but for the term c/q of the first reflection, c about the radius.
        self.assertAlmostEqual(fit.resistance(1e6) / stokes, 1, delta=1e-5)

    def test_refusals_have_the_words_of_the_program(self):
        with self.assertRaisesRegex(viscontact.InputError, "no_such_fit.json"):
            viscontact.Fit("no_such_fit.json")
        with self.assertRaisesRegex(viscontact.InputError, "below is 'x'; it must be"):
            viscontact.Fit(LECTURE, below="x")
        with self.assertRaisesRegex(viscontact.InputError, "radius is -1.*must be"):
            viscontact.Fit(LECTURE, radius=-1)
        self.assertTrue(issubclass(viscontact.InputError, viscontact.Error))
        self.assertTrue(issubclass(viscontact.Error, RuntimeError))

    def test_exact_plane(self):
        fit = viscontact.Fit.exact_plane(viscosity=3, radius=1)
        # Leading order of Brenner's drag, which has a relative error of q ln(1/q)/5.
        self.assertAlmostEqual(fit.resistance(1e-9) * 1e-9 / (18 * np.pi), 1, delta=1e-7)

    def test_of_a_table_and_back_from_its_file(self):
        table = DATA / "tables/lecture.csv"
        with tempfile.TemporaryDirectory() as folder:
            file = pathlib.Path(folder) / "fit.json"
            fit = viscontact.fit(table, "asymptotic", output=file)
            again = viscontact.Fit(file)
        self.assertEqual(fit.terms, again.terms)
        self.assertEqual(list(fit.terms), ["1/q", "ln q", "1", "q ln q", "q"])
        theory = viscontact.fit(table, terms="1/q, 1, q", fix="theory")
        self.assertAlmostEqual(theory.terms["1/q"] / -theory.reference_velocity, 18 * np.pi)
        self.assertEqual(viscontact.fit(table, terms="1/q, 1", fix=50.0).terms["1/q"], 50)
        with self.assertRaisesRegex(viscontact.InputError, "basis"):
            viscontact.fit(table, "no such basis")
        with self.assertRaisesRegex(viscontact.InputError, "basis and terms"):
            viscontact.fit(table, "lecture", terms="1/q")

    def test_the_default_fit_is_the_shipped_one(self):
        fit, shipped = viscontact.fit(DATA / "tables/lecture.csv"), viscontact.Fit(LECTURE)
        # Another version of the libraries of linear algebra may round otherwise; the condition
        # number of the lecture's basis is below 1e3.
        for name, coefficient in shipped.terms.items():
            self.assertAlmostEqual(fit.terms[name] / coefficient, 1, delta=1e-11)


class PairFitTest(unittest.TestCase):
    FILE = DATA / "fits/pairs/plane.json"
    ENTRIES = ("squeeze", "slide", "roll", "slide_roll", "spin")

    def test_has_the_bits_of_the_library(self):
        fit = viscontact.PairFit(self.FILE)
        gaps = spread(fit.interval)
        expected = values("pair", self.FILE, *map(float.hex, gaps))
        for entry, column in zip(self.ENTRIES, expected.T):
            np.testing.assert_array_equal(getattr(fit, entry)(gaps), column)

    def test_of_the_tables(self):
        fit = viscontact.fit_pair([DATA / "tables/pairs/plane"])
        shipped = viscontact.PairFit(self.FILE)
        self.assertEqual(fit.interval, shipped.interval)
        self.assertEqual(set(fit.terms), set(self.ENTRIES))
        gaps = spread(fit.interval)
        # The same tables, fitted again: rounding of an ill-conditioned basis.
        np.testing.assert_allclose(fit.slide(gaps), shipped.slide(gaps), rtol=1e-9)
        with self.assertRaisesRegex(viscontact.InputError, "no table"):
            viscontact.fit_pair([])


class PairResistanceTest(unittest.TestCase):
    def test_is_symmetric_and_combines_shapes(self):
        one = viscontact.pair_resistance(1, 2, 0.1)
        self.assertEqual(one.shape, (22, 22))
        np.testing.assert_array_equal(one, one.T)
        many = viscontact.pair_resistance(1, [[1.0], [2.0]], [0.1, 0.2, 0.3], viscosity=3)
        self.assertEqual(many.shape, (2, 3, 22, 22))
        # The same numbers but for the order in which they are multiplied by the viscosity.
        np.testing.assert_allclose(many[1, 0], 3 * one, rtol=1e-14)

    def test_far_apart_is_that_of_each_sphere(self):
        matrix = viscontact.pair_resistance(2.0, 1.0, 1e6, 1.5)
        # The other sphere changes them by about the radius over the distance.
        self.assertAlmostEqual(matrix[0, 0] / (6 * np.pi * 1.5 * 2), 1, delta=1e-5)
        self.assertAlmostEqual(matrix[16, 16] / (8 * np.pi * 1.5), 1, delta=1e-5)
        self.assertAlmostEqual(matrix[6, 6] / (20 / 3 * np.pi * 1.5 * 8), 1, delta=1e-5)

    def test_refuses_what_is_no_pair(self):
        with self.assertRaisesRegex(viscontact.InputError, "gap"):
            viscontact.pair_resistance(1, 1, [0.1, 0.0])
        with self.assertRaisesRegex(viscontact.InputError, "factor"):
            viscontact.pair_resistance(1, 2e9, 0.1)

    def test_a_plane_and_the_balanced_form(self):
        matrix = viscontact.pair_resistance([1.0, 1.0], [np.inf, 1e8], 0.1)
        self.assertEqual(np.abs(matrix[0, 11:]).max(), 0)
        # Drag of a sphere at the gap 0.1 above a plane, Brenner 1961.
        self.assertAlmostEqual(matrix[0, 2, 2] / (6 * np.pi), 11.459157, delta=1e-4)
        # The table of the plane and its matching have errors of 4e-6 beside the diagonal, below 216.
        np.testing.assert_allclose(matrix[1, :11, :11], matrix[0, :11, :11], rtol=0, atol=2e-5 * 216)
        balanced = viscontact.pair_resistance(1, 3, 0.1, balanced=True)
        np.testing.assert_array_equal(balanced[:3], -balanced[11:14])


class FilmTest(unittest.TestCase):
    def test_is_that_of_the_exact_drag(self):
        # A sphere of roughness 0.005 above a plane with the threshold gap 0.1.
        self.assertAlmostEqual(viscontact.film_gamma(1, np.inf, 0.1, 0.01, viscosity=3), -138.3,
                               delta=0.05)
        gaps = np.array([0.001, 0.01, 0.1])
        for radius, neighbour in (1, np.inf), (1, 0.5), (1, -3):
            for discs in False, True:
                gamma = viscontact.film_gamma(radius, neighbour, 0.1, gaps, 2, discs=discs)
                np.testing.assert_allclose(
                    viscontact.film_gap(radius, neighbour, 0.1, gamma, 2, discs=discs), gaps, rtol=1e-12)

    def test_refuses_what_is_no_film(self):
        for arguments in (1, -0.9, 0.1, 0.01), (0, 1, 0.1, 0.01), (1, 1, 0.1, 0.2), (1, 1, 0.1, 0):
            with self.assertRaises(viscontact.Error):
                viscontact.film_gamma(*arguments)
        with self.assertRaises(viscontact.Error):
            viscontact.film_gap(1, 1, 0.1, 0.5)


if __name__ == "__main__":
    unittest.main()
