"""Soft bodies through Python: their motion, impulses and forces, a grabbed and dragged vertex, pins, stresses."""

import os
import sys
import unittest

HERE = os.path.dirname(os.path.abspath(__file__))
ROOT = os.path.realpath(os.path.join(HERE, os.pardir, os.pardir))
sys.path.insert(0, os.path.join(ROOT, "exporters", "python"))
if not os.path.exists(os.environ.get("SBFMT_LIBRARY", "")):
    print("skipped: SBFMT_LIBRARY names no shared library")
    sys.exit(77)
import sbfmt  # noqa: E402
from sbfmt import runtime, soft_body  # noqa: E402

TICK, GRAVITY = 1 / 60, 9.80665
NO_GRAVITY = (0, 0, 0)


class SoftBody(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        source = sbfmt.convert(os.path.join(ROOT, "examples", "pudding", "pudding.glb"))
        cls.asset = source.build(interior="tetrahedra", elements=100)
        cls.springs = source.build()
        cls.loose = runtime.Model(cls.asset, free=True, gravity=NO_GRAVITY)
        cls.pinned = runtime.Model(cls.asset)

    def world(self, model, **how):
        world = runtime.World(None, sleep_after=0, **how)
        self.addCleanup(world.close)
        return world, world.add(model, position=(0, 1, 0), hold_pose=True)  # beside no ground

    def step(self, world, ticks):
        for _ in range(ticks):
            world.step(TICK)

    def test_a_velocity_is_the_bodys(self):
        world, one = self.world(self.loose, gravity=NO_GRAVITY)
        soft_body.set_velocity(one, 0, (1, 2, 0), (0, 0.5, 0))
        self.step(world, 1)
        now = soft_body.motion(one, 0)
        self.assertGreater(now.mass, 0)
        for wanted, is_ in zip((1, 2, 0, 0, 0.5, 0), now.velocity + now.angular_velocity):
            self.assertAlmostEqual(is_, wanted, delta=0.02)

    def momentum(self, one):
        """Of both bodies: they share points."""
        both = [soft_body.motion(one, body) for body in range(2)]
        return [sum(each.mass * each.velocity[axis] for each in both) for axis in range(3)]

    def test_an_impulse_and_a_force_change_the_momentum(self):
        for vertex in (soft_body.WHOLE_BODY, 5):
            world, one = self.world(self.loose, gravity=NO_GRAVITY)
            self.step(world, 1)
            soft_body.apply_impulse(one, 0, (4, 0, 0), vertex)
            self.step(world, 1)
            self.assertAlmostEqual(self.momentum(one)[0], 4, delta=0.02)
            soft_body.apply_force(one, 0, (0, 0, 30), 6 * TICK, vertex)
            self.step(world, 10)
            self.assertAlmostEqual(self.momentum(one)[2], 3, delta=0.02)

    def test_a_vertex_is_grabbed_dragged_and_released(self):
        world, one = self.world(self.loose, gravity=NO_GRAVITY)
        self.step(world, 1)
        origin = one.origin
        at = [origin[k] + one.surface(0)[3 * 7 + k] for k in range(3)]
        self.assertEqual(soft_body.nearest_vertex(one, 0, at), 7)
        for lift in (0.1, 0.2):
            target = (at[0], at[1] + lift, at[2])
            soft_body.grab(one, 0, 7, target)
            self.step(world, 2)
            self.assertGreater(soft_body.grab_force(one, 0, 7)[1], 0)
            self.step(world, 90)
            self.assertAlmostEqual(one.origin[1] + one.surface(0)[3 * 7 + 1], target[1], delta=0.005)
        self.assertTrue(soft_body.release(one, 0, 7))
        self.assertFalse(soft_body.release(one, 0, 7))
        self.assertEqual(soft_body.grab_force(one, 0, 7), (0, 0, 0))

    def test_pins_carry_the_weight(self):
        world, one = self.world(self.pinned)
        self.step(world, 600)
        pins = [pin for body in range(2) for pin in soft_body.pin_reactions(one, body)]
        self.assertGreater(sum(pin.points for pin in pins), 0)
        weight = GRAVITY * sum(soft_body.motion(one, body).mass for body in range(2))
        self.assertAlmostEqual(sum(pin.force[1] for pin in pins), weight, delta=0.01 * weight)

    def test_elements_report_their_stress(self):
        world, one = self.world(self.pinned)
        self.step(world, 60)
        found = soft_body.tetrahedra(one, 0)
        self.assertGreater(len(found), 50)
        self.assertEqual(len(soft_body.springs(one, 0)), 0)
        energy = sum(each.energy_density * each.rest_volume for each in found)
        self.assertAlmostEqual(energy, one.health(0).elastic_j, delta=0.01 * energy)
        self.assertGreater(max(abs(each.stress[1]) for each in found), 1)
        world, one = self.world(runtime.Model(self.springs))
        self.step(world, 60)
        found = soft_body.springs(one, 0)
        self.assertGreater(len(found), 50)
        self.assertEqual(len(soft_body.tetrahedra(one, 0)), 0)
        self.assertGreater(sum(each.energy for each in found), 0)

    def test_wrong_values_are_refused(self):
        world, one = self.world(self.loose)
        self.step(world, 1)
        for call in (lambda: soft_body.apply_impulse(one, 99, (0, 1, 0)), lambda: soft_body.apply_impulse(one, 0, (float("nan"), 0, 0)),
                     lambda: soft_body.grab(one, 0, 10 ** 6, (0, 0, 0)), lambda: soft_body.set_velocity(one, 99, (0, 0, 0))):
            with self.assertRaises(sbfmt.Error):
                call()


if __name__ == "__main__":
    unittest.main()
