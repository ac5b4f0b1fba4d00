"""The Python module; PYTHONPATH has it, SPRUNG_MODELS is assets/models."""
import gc
import os
import pathlib
import signal
import subprocess
import tempfile
import threading
import time
import unittest

import numpy as np
import sprung

MODELS = pathlib.Path(os.environ["SPRUNG_MODELS"])
TORUS = MODELS / "torus.ply"
BEAM = MODELS / "beam.ply"


def drop(bricks=10):
    world = sprung.World()
    (body,) = world.add(TORUS, sprung.material("gelatin"), size=0.1, bricks=bricks, position=(0, 0.02, 0))
    return world, body


def clamped_beam(bricks=8, **options):
    """A beam of 0.4 x 0.1 x 0.1 m that is held at its low end."""
    world = sprung.World(gravity=(0, -1, 0), ground=None)
    soft = sprung.Material(young=1000, poisson=0.3, density=1)
    (beam,) = world.add(BEAM, soft, size=0.4, bricks=bricks, **options)
    beam.pin(beam.rest_positions[:, 0] < beam.rest_positions[:, 0].min() + 1e-6)
    return world, beam


class Materials(unittest.TestCase):
    def test_names(self):
        self.assertGreaterEqual(len(sprung.materials()), 25)
        self.assertEqual(sprung.material("steel").young, 210e9)
        with self.assertRaisesRegex(sprung.Error, "did you mean 'gelatin'"):
            sprung.material("gelatine")

    def test_ranges(self):
        with self.assertRaisesRegex(sprung.Error, "Poisson"):
            sprung.Material(young=1e3, poisson=0.5, density=1000)

    def test_says_what_it_is(self):
        self.assertIn("steel: 2.1e+11 Pa, 0.3, 7850 kg/m3", repr(sprung.material("steel")))


class Materials(unittest.TestCase):
    def test_motions_have_a_ratio_of_their_own(self):
        gelatin = sprung.material("gelatin")
        self.assertLess(gelatin.poisson_in_motion, gelatin.poisson)
        self.assertIsNone(sprung.Material(1e4, 0.3, 1000).poisson_in_motion)
        ends = []
        for material in gelatin, "gelatin":
            scene = {
                "body": [{"box": [0.1, 0.1, 0.1], "bricks": 2, "material": material, "pin": [{"nearest": [0, 0, 0]}]}],
                "duration": 0.1,
            }
            ends.append(sprung.simulate(scene).positions(1)[0])
        np.testing.assert_array_equal(*ends)


class Meshes(unittest.TestCase):
    def test_a_mesh_from_arrays_is_the_same_as_from_its_file(self):
        mesh = sprung.read_mesh(str(BEAM))
        world = sprung.World()
        material = sprung.material("gelatin")
        (own,) = world.add(sprung.Mesh(mesh.positions, mesh.triangles), material, bricks=8)
        (read,) = world.add(BEAM, material, bricks=8)
        np.testing.assert_array_equal(own.positions, read.positions)
        np.testing.assert_array_equal(own.field("fill"), read.field("fill"))

    def test_what_is_no_mesh(self):
        with self.assertRaisesRegex(sprung.Error, "triangle 1 refers to vertex 4 of 3"):
            sprung.Mesh(np.eye(3), [[0, 1, 3]])
        with self.assertRaisesRegex(sprung.Error, "vertex 1 has a coordinate that is not finite"):
            sprung.Mesh(np.eye(3) * np.nan, [[0, 1, 2]])
        with self.assertRaisesRegex(sprung.Error, "nothing.ply"):
            sprung.read_mesh(MODELS / "nothing.ply")
        with self.assertRaisesRegex(sprung.Error, "the mesh"):  # encloses nothing
            sprung.World().add(sprung.Mesh(np.eye(3), [[0, 1, 2]]), sprung.material("gelatin"))


class Arrays(unittest.TestCase):
    def test_quantities_are_in_si_units(self):
        world, body = drop()
        sides = body.rest_positions[body.nodes[:, 1]] - body.rest_positions[body.nodes[:, 0]]
        np.testing.assert_allclose(sides, np.tile([body.brick_size, 0, 0], (len(sides), 1)), atol=1e-12)
        volume = body.field("fill").sum() * body.brick_size**3
        self.assertAlmostEqual(body.masses.sum() / (volume * body.material.density), 1, places=9)
        self.assertEqual(np.ptp(body.skin_positions(), axis=0).max().round(6), 0.1)
        world.step(1e-5, 10)
        np.testing.assert_allclose(body.velocities[:, 1], -9.81 * 1e-4, rtol=1e-6)
        np.testing.assert_allclose(body.field("young"), body.material.young)

    def test_stress_and_strain_of_a_stretch(self):
        _, beam = clamped_beam()
        beam.positions[:] = beam.rest_positions * [1.001, 1 - 0.0003, 1 - 0.0003]
        np.testing.assert_allclose(beam.field("stress"), 1000 * 0.001, rtol=0.01)  # Pa: E times strain
        np.testing.assert_allclose(beam.field("strain"), 0.001 * 2 / 3 * 1.3, rtol=0.01)
        np.testing.assert_allclose(beam.field("stretch"), 1.001, rtol=1e-9)
        np.testing.assert_allclose(beam.field("volume"), 1.001 * 0.9997**2, rtol=1e-9)

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
        view, nodes = body.positions, body.nodes
        copy, nodes_copy = view.copy(), nodes.copy()
        del world, body
        gc.collect()
        np.testing.assert_array_equal(view, copy)
        np.testing.assert_array_equal(nodes, nodes_copy)

    def test_views_stay_where_they_are_as_bodies_are_added(self):
        world, body = drop(6)
        names = ["positions", "velocities", "rest_positions", "masses", "nodes", "triangles"]
        views = [getattr(body, name) for name in names]
        for row in range(9):
            world.add(TORUS, sprung.material("gelatin"), size=0.1, bricks=4, position=(0.2 * row + 0.2, 0, 0))
        world.step(1e-4)
        for name, array in zip(names, views):
            self.assertTrue(np.shares_memory(array, getattr(body, name)), name)

    def test_fields(self):
        world, body = drop()
        np.testing.assert_allclose(body.field("volume"), 1)
        np.testing.assert_allclose(body.field("stress"), 0, atol=1e-6)
        self.assertTrue(np.shares_memory(body.field("fill"), body.field("fill")))
        world.advance(0.1)
        self.assertGreater(body.field("stress").max(), 1)
        self.assertEqual(body.stress().shape, (len(body.positions), 6))
        self.assertEqual(body.skin_stress().shape, (len(body.skin_positions()), 6))
        self.assertGreater(np.abs(body.stress()).max(), 1)
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
        _, beam = clamped_beam()
        rest = beam.rest_positions
        beam.settle(linear=True)
        end = rest[:, 0] > rest[:, 0].max() - 1e-6
        middle = (beam.positions - rest)[end & (np.abs(rest[:, 1:] - rest[:, 1:].mean(axis=0)) < 1e-6).all(axis=1), 1]
        self.assertAlmostEqual(middle[0] / -0.004004546, 1, delta=0.03)

    def test_settling_takes_the_forces_of_the_scene(self):
        ends = []
        for force in ({"total": [0, 0, 0]}, {"total": [0, -0.02, 0]}):
            world = sprung.World.from_scene(
                {
                    "gravity": [0, 0, 0],
                    "body": [
                        {
                            "box": [0.4, 0.1, 0.1],
                            "bricks": 8,
                            "material": "gelatin",
                            "pin": [{"box": {"min": [0, 0, 0], "max": [0.01, 1, 1]}}],
                            "force": [force],
                        }
                    ],
                }
            )
            (body,) = world.bodies
            body.settle(linear=True)
            ends.append((body.positions - body.rest_positions)[:, 1].min())
        # W L^3 / (8 E I)
        bending = -0.02 * 0.4**3 / (8 * 24e3 * 0.1**4 / 12)
        self.assertAlmostEqual(ends[0], 0, delta=1e-12)
        self.assertAlmostEqual(ends[1] / bending, 1, delta=0.06)
        windy = sprung.World.from_scene(
            {
                "wind": {"velocity": [1, 0, 0]},
                "body": [{"box": [0.1, 0.1, 0.1], "bricks": 2, "material": "gelatin", "pin": [{"nearest": [0, 0, 0]}]}],
            }
        )
        with self.assertRaisesRegex(sprung.Error, "settle\\(\\) cannot take into account a wind"):
            windy.bodies[0].settle()

    def test_the_same_steps_give_the_same_bits(self):
        ends = []
        for _ in range(2):
            world, body = drop()
            world.step(1e-4, 1000)
            ends.append(body.positions.copy())
        np.testing.assert_array_equal(ends[0], ends[1])

    def test_bodies_added_later_leave_the_others_as_they_are(self):
        ends = []
        for additions in (1, 3):
            world = sprung.World()
            jelly = sprung.Material(young=3000, poisson=0.3, density=1000)
            (body,) = world.add(TORUS, jelly, size=0.1, bricks=6, position=(0, 0.001, 0))
            for row in range(additions):
                world.add(TORUS, jelly, size=0.1, bricks=6, position=(1 + row, 0.001, 0))
                world.advance(0 if row == 0 else 1e-12)
            world.step(1e-4, 500)
            ends.append(body.positions.copy())
        np.testing.assert_allclose(ends[0], ends[1], atol=1e-6)

    def test_what_is_pinned_stays(self):
        world, beam = clamped_beam()
        rest = beam.rest_positions
        held = np.flatnonzero(rest[:, 0] < rest[:, 0].min() + 1e-6)
        world.advance(0.2)
        np.testing.assert_array_equal(beam.positions[held], rest[held])
        self.assertGreater(np.abs(beam.positions - rest).max(), 1e-4)
        beam.pin(held)  # rows do as well
        beam.pin([])
        world.advance(0.2)
        self.assertLess(beam.positions[held, 1].max(), rest[held, 1].max())

    def test_ctrl_c_stops_and_takes_back(self):
        world, body = drop(40)
        before = body.positions.copy()
        threading.Timer(1, lambda: os.kill(os.getpid(), signal.SIGINT)).start()
        begin = time.monotonic()
        with self.assertRaises(KeyboardInterrupt):
            world.advance(100)
        self.assertLess(time.monotonic() - begin, 30)
        self.assertEqual(world.time, 0)
        np.testing.assert_array_equal(body.positions, before)

    def test_other_threads_run_meanwhile(self):
        world, body = drop(16)
        mover = threading.Thread(target=world.step, args=(1e-4, 1000))
        mover.start()
        sleeps = 0
        while mover.is_alive():
            time.sleep(0.001)
            sleeps += 1
        mover.join()
        self.assertGreater(sleeps, 3)
        self.assertAlmostEqual(world.time, 0.1)

    def test_threads_take_turns(self):
        world, body = drop(16)
        movers = [threading.Thread(target=lambda: [world.step(1e-4, 50) for _ in range(5)]) for _ in range(2)]
        for mover in movers:
            mover.start()
        while any(mover.is_alive() for mover in movers):
            view = body.positions  # never one of those that a step works on
            self.assertTrue(np.shares_memory(view, body.positions))
            self.assertTrue(np.isfinite(view).all())
        for mover in movers:
            mover.join()
        self.assertAlmostEqual(world.time, 0.05)

class Parts(unittest.TestCase):
    def test_a_bracket_under_load(self):
        file = MODELS / "bracket.stl"
        answer = sprung.load(file, fix="x-low", load="x-high:50N:-y", bricks=40, at=[(40, 6, 15)])
        self.assertAlmostEqual(answer["displacement_m"]["value"], 6.7e-3, delta=0.2e-3)
        self.assertAlmostEqual(answer["reactions"][0]["force_N"][1], 50, delta=0.01)
        self.assertGreater(answer["safety"], 1.5)
        self.assertGreater(answer["points"][0]["von_mises_Pa"]["value"], 5e6)
        mesh = sprung.read_mesh(file)
        stiff = sprung.Material(young=200e9, poisson=0.3, density=7850)
        again = sprung.load(mesh, fix=["x-low"], load=["x-high:50N:-y", "weight"], material=stiff, bricks=40, up="z")
        self.assertLess(again["displacement_m"]["value"], 0.1e-3)
        self.assertIsNone(again["safety"])
        with self.assertRaisesRegex(sprung.Error, "the part has no support"):
            sprung.load(file, fix=[], load="x-high:50N")


class Mistakes(unittest.TestCase):
    """Each is told with its value, and leaves the world as it was."""

    def test_values_out_of_range(self):
        world, body = drop(6)
        for call, message in [
            (lambda: sprung.World(gravity=(0, np.nan, 0)), "gravity .* is nan; it must be"),
            (lambda: sprung.World(ground=np.inf), "ground .* is inf"),
            (lambda: world.add(TORUS, body.material, size=-1), "size is -1 m"),
            (lambda: world.add(TORUS, body.material, size=np.inf), "size is inf"),
            (lambda: world.add(TORUS, body.material, bricks=0), "bricks .0. must be above 0"),
            (lambda: world.add(TORUS, body.material, bricks=10**6), "use larger bricks"),
            (lambda: world.add(TORUS, body.material, position=(0, 0, np.nan)), "position .* is nan"),
            (lambda: world.add(TORUS, body.material, model="calibratd"), "did you mean 'calibrated'"),
            (lambda: world.advance(-1), "duration .* is -1"),
            (lambda: world.advance(np.inf), "duration .* is inf"),
            (lambda: world.step(0), "dt .* is 0"),
            (lambda: world.step(1e-4, -3), "count is -3"),
            (lambda: body.pin([0, 10**9]), "no node 1000000000 .* 0 to"),
            (lambda: body.pin([-1]), "no node -1"),
            (lambda: body.pin([True, False]), "one bool for each"),
            (lambda: body.pin([0.5]), "whole numbers"),
            (lambda: body.settle(), "pin\\(\\) some"),
            (lambda: world.render(0, 100), "resolution 0x100"),
            (lambda: world.render(64, 64, elevation=90), "elevation .* is 90"),
            (lambda: sprung.World().render(64, 64), "add\\(\\) a mesh first"),
        ]:
            with self.assertRaisesRegex(sprung.Error, message):
                call()
        np.testing.assert_array_equal(body.positions, body.rest_positions)
        self.assertEqual(world.time, 0)

    def test_types(self):
        world, body = drop(6)
        for call in (lambda: world.add(TORUS, "gelatin"), lambda: world.add(3, body.material), lambda: world.step("1")):
            self.assertRaises(TypeError, call)

    def test_steps_that_are_too_long(self):
        world, body = drop()
        stable = world.stable_step()
        with self.assertRaisesRegex(sprung.Diverged, "too long, up to .* s are stable"):
            world.step(20 * stable, 2000)
        np.testing.assert_array_equal(body.positions, body.rest_positions)
        np.testing.assert_array_equal(body.velocities, 0)
        world.step(stable, 10)
        self.assertTrue(issubclass(sprung.Diverged, sprung.Error))

    def test_positions_that_are_no_numbers(self):
        world, body = drop(6)
        body.positions[0] = np.nan
        with self.assertRaisesRegex(sprung.Error, "not finite"):
            world.advance(0.01)
        with self.assertRaisesRegex(sprung.Error, "not finite"):
            world.render(32, 32)


class Scenes(unittest.TestCase):
    """Pins, handles, regions, forces, obstacles, glue and caches, by the code of the program."""

    SCENE = {
        "duration": 0.2,
        "fps": 10,
        "body": [
            {
                "box": [0.2, 0.05, 0.05],
                "brick_size": "1.25 cm",
                "material": {"young": 3e4, "poisson": 0.3, "density": 1000},
                "position": [0, 0.1, 0],
                "pin": [
                    {"name": "hold", "box": {"min": [0, 0, 0], "max": [0.01, 1, 1]}},
                    {
                        "box": {"min": [0.99, 0, 0], "max": [1, 1, 1]},
                        "keyframes": [{"t": 0.2, "translate": [0.02, 0, 0]}],
                    },
                ],
                "region": [{"half_space": {"point": [0.5, 0.5, 0.5], "normal": [1, 0, 0]}, "material": sprung.Material(6e4, 0.3, 1000)}],
                "force": [{"per_volume": np.array([0.0, 0.0, 100.0])}],
            },
            {"box": [0.05, 0.05, 0.05], "brick_size": "1.25 cm", "position": [0, 0.15, 0]},
        ],
        "glue": [{"bodies": [1, 2]}],
        "obstacle": [{"plane": {"y": 0}}, {"sphere": {"radius": 0.03}, "position": [0, 0.03, 0]}],
        "probe": [{"name": "hand", "body": 1, "pin": "hold"}, {"name": "bar", "body": 1}],
    }

    def test_a_dict_of_all_of_them(self):
        run = sprung.simulate(self.SCENE)
        self.assertEqual((run.frame_count, len(run.positions(0))), (2, 2))
        np.testing.assert_allclose(run.progress, [0, 0.1])
        self.assertGreater(np.abs(run.probes["hand"]["force"][1]).max(), 0.01)
        self.assertNotIn("force", run.probes["bar"])
        self.assertEqual(run.probes["bar"]["volume"].shape, (2,))
        self.assertGreater(run.probes["bar"]["max_stress"][1], run.probes["bar"]["max_stress"][0])
        bar = run.positions(-1)[0] - run.positions(0)[0]
        self.assertAlmostEqual(bar[:, 0].max(), 0.01, delta=4e-3)  # the handle, half way; the bar swings a little
        self.assertEqual(run.skin_positions(1)[0].shape[1], 3)
        self.assertLess(run.triangles[0].max(), len(run.skin_positions(1)[0]))

    def test_a_scene_moved_by_hand_is_that_of_the_program(self):
        world = sprung.World.from_scene(self.SCENE)
        self.assertEqual(len(world.bodies), 2)
        world.advance(0.1)
        run = sprung.simulate(self.SCENE)
        for body, positions in zip(world.bodies, run.positions(1)):
            np.testing.assert_allclose(body.positions, positions, atol=1e-7)  # a run keeps floats

    def test_a_file_gives_the_bits_that_the_program_prints(self):
        program = pathlib.Path(sprung.__file__).parents[1] / "sprung"
        if not program.exists():
            self.skipTest("the program is elsewhere")
        scene = MODELS.parent / "scenes" / "wall.toml"
        with tempfile.TemporaryDirectory() as folder:
            done = subprocess.run([program, "simulate", scene, "-o", folder + "/run", "--quiet"], check=True,
                                  capture_output=True, text=True)
            run = sprung.simulate(scene, cache=folder + "/run.h5")
            again = sprung.read_run(folder + "/run.h5")
        self.assertIn(f"state {run.state_hash:016x}", done.stdout)
        self.assertEqual((again.frame_count, again.state_hash), (run.frame_count, run.state_hash))
        np.testing.assert_array_equal(again.positions(5)[0], run.positions(5)[0])

    def test_a_run_tells_of_its_frames_and_how_far_it_is(self):
        told, frames = [], []
        run = sprung.simulate(self.SCENE, progress=lambda *now: told.append(now),
                              on_frame=lambda frame, time, positions: frames.append((frame, time, positions)))
        self.assertTrue(told)
        self.assertTrue(all(0 <= share <= 1 and to_go >= 0 for _, share, to_go in told))
        self.assertEqual([frame for frame, _, _ in frames], list(range(run.frame_count)))
        np.testing.assert_array_equal([time for _, time, _ in frames], run.progress)
        np.testing.assert_array_equal(frames[-1][2][0], run.positions(-1)[0])
        self.assertEqual(run.seconds.shape, (run.frame_count,))
        self.assertIn("[[body]]", run.scene)
        with tempfile.TemporaryDirectory() as folder:
            cached = sprung.simulate(self.SCENE, cache=folder + "/run.h5")
        for frame in (0, -1):  # to the last bit, in double precision
            np.testing.assert_array_equal(cached.positions(frame)[0], run.positions(frame)[0])
            np.testing.assert_array_equal(cached.velocities(frame)[0], run.velocities(frame)[0])

        def stop(frame, time, positions):
            raise ValueError("enough")

        with self.assertRaisesRegex(ValueError, "enough"):
            sprung.simulate(self.SCENE, on_frame=stop)

    def test_keys_of_a_body(self):
        world = sprung.World(ground=None)
        (body,) = world.add(BEAM, sprung.material("gelatin"), size=0.4, bricks=8, velocity=[1, 0, 0],
                            pin=[{"box": {"min": [0, 0, 0], "max": [0.01, 1, 1]}}])
        held = body.rest_positions[:, 0] < body.rest_positions[:, 0].min() + 1e-6
        np.testing.assert_array_equal(body.velocities[~held], np.tile([1, 0, 0], ((~held).sum(), 1)))
        world.advance(0.02)
        np.testing.assert_array_equal(body.positions[held], body.rest_positions[held])

    def test_mistakes(self):
        for scene, message in [
            ({"body": [{"box": [1, 1, 1], "bricks": 4, "young": 3}]}, "unknown key 'body.young'"),
            ({"duration": object()}, "a scene has no value like <object"),
            ({"body": [{"mesh": "nothing.ply"}]}, "nothing.ply"),
            ({"body": [{"box": [1, 1, 1], "bricks": 4}, {"box": [1, 1, 1], "bricks": 4, "pin": [{"box": {"min": [0, 0, 0]}}]}]},
             r"^body\[1\].pin\[0\].box: body.pin.box lacks the key 'max'"),
            ({"fps": -1}, "(?m)^fps: -1 fps is out of range"),
            ({"camera": {"elevation": [{}, object()]}}, r"^camera.elevation\[1\]: a scene has no value like <object"),
        ]:
            with self.assertRaisesRegex(sprung.Error, message):
                sprung.simulate(scene)
        with self.assertRaisesRegex(sprung.Error, "no frame 2"):
            sprung.simulate(self.SCENE).positions(2)
        with self.assertRaisesRegex(sprung.Error, "did you mean 'brick_size'"):
            sprung.World().add(BEAM, sprung.material("gelatin"), brick_siz=1)


class Pictures(unittest.TestCase):
    def test_shape_and_content(self):
        world, body = drop()
        picture = world.render(80, 60)
        self.assertEqual((picture.shape, picture.dtype), ((60, 80, 3), np.uint8))
        red = (picture[..., 0].astype(int) - picture[..., 1]) > 20
        self.assertGreater(red.mean(), 0.05)  # or the colours of the mesh itself
        body.positions[:, 0] += 5
        world.add(TORUS, body.material, size=0.1, bricks=6)
        self.assertLess(((world.render(80, 60)[..., 0].astype(int) - picture[..., 0]) == 0).mean(), 0.9)


if __name__ == "__main__":
    unittest.main()
