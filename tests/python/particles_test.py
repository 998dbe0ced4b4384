"""Particles of the Python module: the same bits as C++, views without copies, forces, contacts."""

import gc
import pathlib
import tempfile
import threading
import unittest

import numpy as np

import viscontact
from cases import DATA, SOURCE, values

RAFT = DATA / "cases/particles/raft.toml"

# A disc and a sphere that fall on a plane, with friction, so that they turn.
FALLING = """
title = "Falling"
[space]
dimension = {dimension}
gravity = [{zeros}-1.0]
[viscous_contact]
end_time = 3.0
time_step = 0.01
gamma_min = -0.5
{scheme}
[friction]
coefficient = 0.5
[[plane]]
point = [{zeros}0.0]
normal = [{zeros}1.0]
[[particle]]
centre = [{zeros}2.0]
velocity = [{velocity}]
radius = 1.0
mass = 2.0
{force}
[[particle]]
centre = [4.0, {more_zeros}1.5]
radius = 0.5
mass = 1.0
"""


def falling(dimension=2, force="", scheme=""):
    return FALLING.format(dimension=dimension, zeros="0.0, " * (dimension - 1),
                          more_zeros="0.0, " * (dimension - 2),
                          velocity=", ".join(["1.0"] + ["0.0"] * (dimension - 1)), force=force,
                          scheme=scheme)


class ParticlesTest(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)

    def open(self, text, **options):
        case = self.folder / "case.toml"
        case.write_text(text)
        return viscontact.Particles(case, **options)

    def test_has_the_bits_of_the_library(self):
        for case in RAFT, DATA / "cases/particles/lottery_friction.toml":
            p = viscontact.Particles(case)
            for _ in range(60):
                p.step()
            expected = values("particles", case, 60)
            np.testing.assert_array_equal(np.column_stack([p.positions, p.velocities]), expected)

    def test_arrays_give_the_bits_of_a_file(self):
        rng = np.random.default_rng(3)
        x, y = np.meshgrid(2.1 * np.arange(5), 1.1 + 2.1 * np.arange(4))
        table = {"x": x.ravel() + rng.uniform(-0.05, 0.05, 20), "y": y.ravel(),
                 "radius": rng.uniform(0.7, 1.0, 20), "mass": np.ones(20),
                 "vx": rng.normal(size=20), "vy": np.zeros(20), "id": np.arange(20, 40)}
        case = {"space": {"dimension": 2, "gravity": (0.0, -1.0)},
                "viscous_contact": {"end_time": 2, "time_step": 0.01, "gamma_min": np.float64(-0.5)},
                "plane": [{"point": np.zeros(2), "normal": [0.0, 1.0]}],
                "title": 'From "arrays"\n'}
        one = viscontact.Particles(case, table)
        self.assertEqual(one.ids.tolist(), table["id"].tolist())
        np.testing.assert_array_equal(one.positions, np.column_stack([table["x"], table["y"]]))
        np.savetxt(self.folder / "table.csv", np.column_stack(list(table.values())), fmt="%.17g",
                   delimiter=",", header=",".join(table), comments="")
        text = (falling().split("[friction]")[0].replace("end_time = 3.0", "end_time = 2")
                + '[particles]\nfile = "table.csv"\n'
                "[[plane]]\npoint = [0.0, 0.0]\nnormal = [0.0, 1.0]\n")
        two = self.open(text)
        self.assertEqual(one.run(), two.run())
        np.testing.assert_array_equal(one.positions, two.positions)
        # The case as a file, without its particles.
        path = self.folder / "bare.toml"
        path.write_text(text.replace('[particles]\nfile = "table.csv"\n', ""))
        three = viscontact.Particles(path, table, threads=2)
        three.run()
        np.testing.assert_array_equal(one.positions, three.positions)

    def test_wrong_arrays_are_refused(self):
        case = {"space": {"dimension": 2}, "viscous_contact": {"end_time": 1, "time_step": 0.1,
                                                               "gamma_min": -1}}
        good = {"x": [0.0, 3.0], "y": [0.0, 0.0], "radius": [1.0, 1.0], "mass": [1.0, 1.0]}
        viscontact.Particles(case, good)
        rows = np.array([(0.0, 0.0, 1.0, 1.0), (3.0, 0.0, 1.0, 1.0)],
                        dtype=[(name, float) for name in good])
        self.assertEqual(len(viscontact.Particles(case, rows)), 2)
        for wrong, words in [({"mass": [1.0]}, r"mass \(1,\)"),
                             ({"mass": [1.0, -1.0]}, "mass is -1"), ({"u": [0, 0]}, "'u'"),
                             ({"mass": 1.0}, r"mass \(\)"), ({"x": [0.0, 1.0]}, "overlap")]:
            with self.assertRaisesRegex(viscontact.InputError, words):
                viscontact.Particles(case, {**good, **wrong})
        with self.assertRaisesRegex(viscontact.InputError, "particles:3: .*mass is -1"):
            viscontact.Particles(case, {**good, "mass": [1.0, -1.0]})
        with self.assertRaisesRegex(viscontact.InputError, "the shapes none"):
            viscontact.Particles(case, {})
        masked = np.ma.array([1.0, 1.0], mask=[False, True])
        with self.assertRaisesRegex(viscontact.InputError, "the column mass .* has masked values"):
            viscontact.Particles(case, {**good, "mass": masked})
        with self.assertRaisesRegex(viscontact.InputError, "of the type ndarray"):
            viscontact.Particles(case, np.zeros((2, 4)))
        with self.assertRaisesRegex(viscontact.InputError, "leave one of both out"):
            viscontact.Particles({**case, "particles": {"file": "x.csv"}}, good)
        with self.assertRaisesRegex(viscontact.InputError, "is not possible in a case"):
            viscontact.Particles({**case, "title": None}, good)

    def test_threads_change_no_bit(self):
        one, two = viscontact.Particles(RAFT), viscontact.Particles(RAFT, threads=2)
        self.assertEqual(one.run(0.5), two.run(0.5))
        np.testing.assert_array_equal(one.positions, two.positions)

    def test_arrays_are_views_that_cannot_be_written(self):
        p = self.open(falling())
        x = p.positions
        self.assertEqual((x.shape, x.dtype), ((2, 2), np.float64))
        before = x.copy()
        p.step()
        self.assertTrue(np.any(x != before))
        self.assertEqual(x.__array_interface__["data"], p.positions.__array_interface__["data"])
        with self.assertRaisesRegex(ValueError, "read-only"):
            x[0] = 1
        for name, shape in dict(velocities=(2, 2), angles=(2,), angular_velocities=(2,), radii=(2,),
                                masses=(2,), orientations=(0, 0), forces=(2, 2), torques=(2,),
                                ids=(2,)).items():
            self.assertEqual(getattr(p, name).shape, shape, name)
        self.assertEqual((len(p), p.time_step, p.end_time), (2, 0.01, 3))
        del p
        gc.collect()
        self.assertTrue(np.all(np.isfinite(x)))  # the view keeps the simulation alive

    def test_spheres(self):
        p = self.open(falling(3))
        for name, shape in dict(positions=(2, 3), velocities=(2, 3), angles=(0,),
                                orientations=(2, 4), angular_velocities=(2, 3),
                                torques=(2, 3)).items():
            self.assertEqual(getattr(p, name).shape, shape, name)

    def test_set_forces_act_as_constant_forces_of_the_case(self):
        for dimension in 2, 3:
            for scheme in "", 'scheme = "leapfrog"':
                push = [0.7] + [0.0] * (dimension - 2) + [0.3]
                of_case = self.open(falling(dimension, f"force = {push}", scheme))
                own = self.open(falling(dimension, "", scheme))
                own.forces[0] = push
                for _ in range(200):
                    of_case.step()
                    own.step()
                np.testing.assert_array_equal(own.positions, of_case.positions)
                np.testing.assert_array_equal(own.velocities, of_case.velocities)
                np.testing.assert_array_equal(own.reported_velocities(),
                                              of_case.reported_velocities())
                free = self.open(falling(dimension, "", scheme))
                free.run(2.0)
                self.assertGreater(np.abs(free.positions - own.positions).max(), 0.1)

    def test_a_spring_keeps_its_energy(self):
        p = self.open("""
title = "A spring"
[space]
dimension = 2
[viscous_contact]
end_time = 20.0
time_step = 0.01
scheme = "leapfrog"
[[particle]]
centre = [1.0, 0.0]
radius = 0.1
mass = 2.0
""")
        energies = []
        while not p.finished:
            p.forces[:] = -8 * p.positions
            p.step()
            energies.append(4 * np.sum(p.positions ** 2) + np.sum(p.velocities ** 2))
        # Leapfrog keeps the energy but for oscillations of the order omega h = 0.02, because the
        # velocities are those of half a step earlier; a scheme of first order gains exp(0.8).
        self.assertLess(np.ptp(energies) / 4, 0.021)
        omega = 2 / 0.01 * np.arcsin(2 * 0.01 / 2)  # of the discrete oscillator
        self.assertAlmostEqual(p.positions[0, 0], np.cos(omega * 20), delta=1e-3)

    def test_torque(self):
        p = self.open(falling())
        p.torques[1] = 0.25
        p.step()
        # Before it touches: h T / I with I = m r^2/2 = 0.125.
        self.assertAlmostEqual(p.angular_velocities[1], 0.01 * 0.25 / 0.125, delta=1e-15)
        self.assertEqual(p.angular_velocities[0], 0)

    def test_contacts_bear_the_weight(self):
        p = self.open(falling())
        p.run()
        c = p.contacts()
        self.assertEqual(list(c.first), [-1, -1])
        self.assertEqual(list(c.second), [0, 1])
        np.testing.assert_allclose(c.normal, [[0, 1], [0, 1]])
        # At rest on the film or the solids the contact carries the weight; the tolerance is that of
        # the impulses of a step.
        np.testing.assert_allclose(c.normal_force, [2, 1], rtol=1e-6)
        self.assertEqual(c.tangential_force.shape, (2, 2))
        self.assertTrue(np.all(c.gamma <= 0))
        np.testing.assert_allclose(c.branch, [[0, 1], [0, 0.5]], atol=1e-5)
        self.assertEqual(list(c.image), [0, 0])

    def test_particles_are_those_of_the_file_at_the_end(self):
        p = self.open(falling())
        p.run()
        now = p.particles()
        self.assertEqual(now.position.shape, (2, 2))
        np.testing.assert_array_equal(now.position, p.positions)
        np.testing.assert_array_equal(now.radius, p.radii)
        np.testing.assert_array_equal(now.velocity, p.reported_velocities())
        self.assertEqual(list(now.id), list(p.ids))
        np.testing.assert_array_equal(now.angular_velocity, p.angular_velocities)

    def test_steps_and_times(self):
        p = self.open(falling())
        report = p.step(until=0.004)
        self.assertEqual((report.time, p.time, p.steps), (0.004, 0.004, 1))
        self.assertTrue(report.converged)
        self.assertEqual(p.step(until=0.004).time, 0.004)  # there is no time left for a step
        self.assertEqual(p.steps, 1)
        p.run(0.1)
        self.assertAlmostEqual(p.time, 0.1, delta=1e-12)
        self.assertFalse(p.finished)
        p.run()
        self.assertTrue(p.finished)
        self.assertEqual(p.run(), 0)
        for call in p.run, p.step:
            for time in 0.5 * p.time, float("nan"):
                with self.assertRaisesRegex(viscontact.Error, "until is .* the present time"):
                    call(time)

    def test_no_step_goes_beyond_the_end_of_the_case(self):
        # The force ends with the case. A step beyond it would take it as 0: the disc would keep its
        # velocity.
        force = "force = [ { until = 0.055, value = [1.0, 0.0] } ]"
        for dimension in 2, 3:
            text = falling(dimension, force.replace("0.0]", "0.0, 0.0]" if dimension == 3 else "0.0]"))
            text = text.replace("end_time = 3.0", "end_time = 0.055")
            p = self.open(text)
            for until in 0.0551, 3.0, float("inf"):
                with self.assertRaisesRegex(viscontact.InputError, "until is .* end_time"):
                    p.run(until)
            self.assertEqual(p.steps, 0)
            while not p.finished:
                p.step(until=float("inf"))  # the last step is cut
            self.assertEqual((p.steps, p.time), (6, 0.055))
            velocity = p.velocities.copy()
            for call in p.step, lambda: p.step(1.0), lambda: p.run(1.0):
                with self.assertRaisesRegex(viscontact.InputError, "end_time"):
                    call()
            self.assertEqual((p.step(until=0.055).time, p.steps), (0.055, 6))
            np.testing.assert_array_equal(p.velocities, velocity)
            whole = self.open(text)
            whole.run()
            np.testing.assert_array_equal(whole.positions, p.positions)

    def test_calls_from_other_threads_are_refused_during_steps(self):
        p = self.open(falling().replace("time_step = 0.01", "time_step = 1e-5"))
        p.step()
        thread = threading.Thread(target=p.run)  # 3e5 steps
        read = [lambda name=name: getattr(p, name) for name in (
            "forces", "torques", "positions", "velocities", "angles", "orientations",
            "angular_velocities", "radii", "masses", "ids", "time", "steps", "finished")]
        read += [lambda: len(p), lambda: repr(p), p.contacts, p.reported_velocities, p.step,
                 lambda: p.step(0), p.run, lambda: p.run(0)]
        for call in read[:-4]:
            call()
        thread.start()
        while thread.is_alive():  # until the thread has begun its steps
            try:
                p.time
            except ValueError:
                break
        for call in read:
            with self.assertRaisesRegex(viscontact.InputError, "another thread computes steps"):
                call()
        self.assertTrue(thread.is_alive())
        thread.join()
        self.assertTrue(p.finished)

    def test_errors_leave_the_state(self):
        p = self.open(falling())
        p.step()
        before = p.positions.copy()
        p.forces[0] = 1e300
        with self.assertRaisesRegex(viscontact.NotConvergedError, "too far for the precision"):
            p.step()
        np.testing.assert_array_equal(p.positions, before)
        p.forces[0] = 0
        p.step()
        self.assertEqual(p.steps, 2)

    def test_refusals(self):
        with self.assertRaisesRegex(viscontact.InputError, "case.toml:.*time_step"):
            self.open(falling().replace("time_step = 0.01", "time_step = -1.0"))
        with self.assertRaisesRegex(viscontact.InputError, "threads is 0"):
            self.open(falling(), threads=0)

    def test_forces_in_a_fluid(self):
        # A solver without FreeFEM, by which a disc alone moves with F/(4 pi mu).
        text = f"""
title = "A disc in a fluid"
[space]
dimension = 2
[viscous_contact]
end_time = 1.0
time_step = 0.125
[domain]
box = {{ from = [-10.0, -10.0], to = [10.0, 10.0] }}
[fluid]
viscosity = 2.0
solver = ["python3", "{SOURCE}/examples/stokes_drag.py"]
[[particle]]
centre = [0.0, 0.0]
radius = 1.0
"""
        of_case = self.open(text + "force = [3.0, 1.0]\n")
        own = self.open(text)
        own.forces[0] = [3, 1]
        of_case.run()
        own.run()
        np.testing.assert_array_equal(own.positions, of_case.positions)
        self.assertAlmostEqual(own.positions[0, 0], 3 / (8 * np.pi), delta=1e-12)


class Suspensions(unittest.TestCase):
    CASE = {"space": {"dimension": 3},
            "domain": {"box": {"from": [0.0, 0.0, 0.0], "to": [8.0, 8.0, 8.0],
                               "periodic": [True, True, True]}},
            "lubrication": {"viscosity": 3.0, "velocity": {"shear_rate": 2.0}},
            "viscous_contact": {"strain_step": 0.125, "end_strain": 1.0}}

    def test_one_sphere_has_einsteins_viscosity(self):
        sphere = viscontact.Particles(self.CASE, {"x": [1.0], "y": [5.0], "z": [3.0],
                                                  "radius": [1.0]})
        viscosity = 1 + 2.5 * 4 * np.pi / 3 / 8**3
        # Rounding errors of the solution, whose tolerance is 1e-11.
        self.assertAlmostEqual(sphere.rheology.viscosity, viscosity, delta=1e-12)
        self.assertAlmostEqual(sphere.velocities[0, 0], 10, delta=1e-9)
        self.assertTrue(np.isnan(sphere.rheology.smallest_gap))
        self.assertEqual(sphere.run(), 8)
        self.assertAlmostEqual(sphere.rheology.strain, 1, delta=1e-12)

    def test_forces_of_the_caller_act_at_once(self):
        sphere = viscontact.Particles(self.CASE, {"x": [1.0], "y": [5.0], "z": [3.0],
                                                  "radius": [1.0]})
        sphere.forces[0] = [0.0, 0.0, 6 * np.pi * 3.0]
        sphere.solve_instant()
        self.assertAlmostEqual(sphere.velocities[0, 2], 1, delta=1e-9)
        self.assertEqual(sphere.time, 0)

    def test_inertia_planes_and_a_flow_in_pieces(self):
        case = {"space": {"dimension": 3},
                "lubrication": {"viscosity": 3.0, "inertia": True,
                                "velocity": {"shear_rate": [{"until": 0.5, "value": 2.0},
                                                            {"until": 1.0, "value": -1.0}]}},
                "plane": [{"point": [0.0, 0.0, 0.0], "normal": [0.0, 1.0, 0.0]}],
                "viscous_contact": {"time_step": 0.1, "end_time": 1.0}}
        spheres = viscontact.Particles(case, {
            "x": [0.0, 9.0], "y": [3.0, 3.0], "z": [0.0, 0.0], "radius": [1.0, 1.0],
            "mass": [2.0, 2.0]})
        # They begin with the flow.
        np.testing.assert_array_equal(spheres.velocities, [[6, 0, 0], [6, 0, 0]])
        np.testing.assert_array_equal(spheres.angular_velocities, [[0, 0, -1], [0, 0, -1]])
        spheres.run(0.5)
        self.assertAlmostEqual(spheres.rheology.shear_rate, 2, delta=1e-12)
        spheres.run()
        self.assertAlmostEqual(spheres.rheology.net_strain, 0.5, delta=1e-12)
        self.assertAlmostEqual(spheres.rheology.strain, 1.5, delta=1e-12)
        # Drag makes both go back with the flow within the time 2/(18 pi).
        self.assertTrue(np.all(spheres.velocities[:, 0] < 0))
        with self.assertRaisesRegex(viscontact.InputError, "mass"):
            viscontact.Particles(case, {"x": [0.0], "y": [3.0], "z": [0.0], "radius": [1.0]})

    def test_other_particles_have_no_rheology(self):
        with self.assertRaises(viscontact.InputError):
            viscontact.Particles(RAFT).rheology


if __name__ == "__main__":
    unittest.main()
