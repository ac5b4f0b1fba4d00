"""The Python module; PYTHONPATH has it, SPRUNG_MODELS is assets/models."""
import ast
import gc
import os
import pathlib
import unittest

import numpy as np
import sprung

MODELS = os.environ["SPRUNG_MODELS"]
TORUS = os.path.join(MODELS, "torus.ply")
BEAM = os.path.join(MODELS, "beam.ply")


def drop(bricks=10):
    world = sprung.World()
    (body,) = world.add(TORUS, sprung.material("gelatin"), size=0.1, bricks=bricks, position=(0, 0.02, 0))
    return world, body


class Materials(unittest.TestCase):
    def test_names(self):
        self.assertGreaterEqual(len(sprung.materials()), 25)
        self.assertEqual(sprung.material("steel").young, 210e9)
        with self.assertRaisesRegex(sprung.Error, "did you mean 'gelatin'"):
            sprung.material("gelatine")

    def test_ranges(self):
        with self.assertRaisesRegex(sprung.Error, "Poisson"):
            sprung.Material(young=1e3, poisson=0.5, density=1000)


class Arrays(unittest.TestCase):
    def test_shapes_and_units(self):
        _, body = drop()
        m, n = len(body.positions), len(body.nodes)
        self.assertEqual(body.positions.shape, (m, 3))
        self.assertEqual(body.nodes.shape, (n, 8))
        self.assertEqual(body.masses.shape, (m,))
        self.assertLess(body.nodes.max(), m)
        sides = body.rest_positions[body.nodes[:, 1]] - body.rest_positions[body.nodes[:, 0]]
        np.testing.assert_allclose(sides, np.tile([body.brick_size, 0, 0], (n, 1)), atol=1e-12)
        volume = body.field("fill").sum() * body.brick_size**3
        self.assertAlmostEqual(body.masses.sum() / (volume * body.material.density), 1, places=9)

    def test_positions_are_the_state_itself(self):
        world, body = drop()
        view = body.positions
        before = view.copy()
        world.advance(0.01)
        self.assertTrue(np.shares_memory(view, body.positions))
        np.testing.assert_array_equal(view, body.positions)
        self.assertLess(view[:, 1].mean(), before[:, 1].mean())
        view += [1, 0, 0]
        np.testing.assert_allclose(body.skin_positions()[:, 0].mean(), 1, atol=0.01)
        with self.assertRaises(ValueError):
            body.rest_positions[0] = 0

    def test_views_outlive_the_world(self):
        world, body = drop()
        view = body.positions
        copy = view.copy()
        del world, body
        gc.collect()
        np.testing.assert_array_equal(view, copy)

    def test_fields(self):
        world, body = drop()
        np.testing.assert_allclose(body.field("volume"), 1)
        np.testing.assert_allclose(body.field("stress"), 0, atol=1e-6)
        world.advance(0.1)
        self.assertGreater(body.field("stress").max(), 1)
        with self.assertRaisesRegex(sprung.Error, "did you mean 'stress'"):
            body.field("stres")


class Motion(unittest.TestCase):
    def test_falls_as_anything_does(self):
        world = sprung.World(ground=None)
        (body,) = world.add(TORUS, sprung.material("gelatin"), size=0.1, bricks=8)
        start = body.positions.mean(axis=0)
        world.step(1e-4, 100)
        self.assertAlmostEqual(world.time, 0.01)
        np.testing.assert_allclose(body.positions.mean(axis=0) - start, [0, -9.81 * 0.01 * 0.0101 / 2, 0], atol=1e-8)

    def test_the_ground_holds(self):
        world, body = drop()
        world.advance(0.3)
        self.assertGreater(body.skin_positions()[:, 1].min(), -0.002)

    def test_beam_bends_as_finite_elements_say(self):
        world = sprung.World(gravity=(0, -1, 0), ground=None)
        soft = sprung.Material(young=1000, poisson=0.3, density=1)
        (beam,) = world.add(BEAM, soft, size=0.4, bricks=8)
        rest = beam.rest_positions
        beam.pin(np.flatnonzero(rest[:, 0] < rest[:, 0].min() + 1e-6))
        beam.settle(linear=True)
        end = rest[:, 0] > rest[:, 0].max() - 1e-6
        middle = (beam.positions - rest)[end & (np.abs(rest[:, 1:] - rest[:, 1:].mean(axis=0)) < 1e-6).all(axis=1), 1]
        self.assertAlmostEqual(middle[0] / -0.004004546, 1, delta=0.03)

    def test_what_nothing_holds_does_not_settle(self):
        _, body = drop()
        with self.assertRaisesRegex(sprung.Error, "pinned"):
            body.settle()


class Pictures(unittest.TestCase):
    def test_shape_and_content(self):
        world, _ = drop()
        picture = world.render(80, 60)
        self.assertEqual((picture.shape, picture.dtype), ((60, 80, 3), np.uint8))
        red = (picture[..., 0].astype(int) - picture[..., 1]) > 20
        self.assertGreater(red.mean(), 0.05)  # or the colours of the mesh itself


class Stubs(unittest.TestCase):
    def test_name_what_is_there(self):
        stub = pathlib.Path(sprung.__file__).with_name("sprung.pyi")
        for node in ast.parse(stub.read_text()).body:
            if not isinstance(node, (ast.ClassDef, ast.FunctionDef)):
                continue
            thing = getattr(sprung, node.name)
            members = [item.name for item in getattr(node, "body", []) if isinstance(item, ast.FunctionDef)]
            for member in members if isinstance(node, ast.ClassDef) else []:
                self.assertTrue(hasattr(thing, member), f"{node.name}.{member}")
            if isinstance(node, ast.ClassDef) and node.name != "Error":
                public = {name for name in dir(thing) if not name.startswith("_")}
                self.assertEqual(public - set(members), set(), node.name)


if __name__ == "__main__":
    unittest.main()
