"""assets/examples/convergence.py runs and says what sprung validate says of the clamped beam."""
import importlib.util
import os
import pathlib
import subprocess
import sys
import tempfile
import unittest

MODELS = pathlib.Path(os.environ["SPRUNG_MODELS"])
SCRIPT = MODELS.parent / "examples" / "convergence.py"
BEAM = str(MODELS / "beam.ply")


class Convergence(unittest.TestCase):
    def test_errors_of_the_tip(self):
        spec = importlib.util.spec_from_file_location("convergence", SCRIPT)
        convergence = importlib.util.module_from_spec(spec)
        spec.loader.exec_module(convergence)
        for bricks, percent in [(4, 1.8), (8, 2.5), (16, 1.1)]:  # sprung validate --case cantilever
            error = 100 * abs(convergence.tip(BEAM, "calibrated", bricks) / convergence.REFERENCE - 1)
            self.assertAlmostEqual(error, percent, delta=0.06, msg=f"{bricks} bricks")

    def test_draws_the_plot(self):
        with tempfile.TemporaryDirectory() as folder:
            plot = pathlib.Path(folder) / "convergence.png"
            command = [sys.executable, SCRIPT, "--mesh", BEAM, "-o", plot, "--bricks", "4", "8"]
            done = subprocess.run(command, check=True, capture_output=True, text=True)
            self.assertEqual([line.split()[0] for line in done.stdout.splitlines()], ["calibrated", "tensile", "fem"])
            self.assertEqual(plot.read_bytes()[:8], b"\x89PNG\r\n\x1a\n")
            self.assertGreater(plot.stat().st_size, 5000)


if __name__ == "__main__":
    unittest.main()
