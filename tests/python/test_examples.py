"""The examples run: convergence.py says what sprung validate says of the clamped beam, the notebook draws itself."""
import base64
import importlib.util
import json
import os
import pathlib
import subprocess
import sys
import tempfile
import unittest

MODELS = pathlib.Path(os.environ["SPRUNG_MODELS"])
SCRIPT = MODELS.parent / "examples" / "convergence.py"
NOTEBOOK = MODELS.parent / "examples" / "softness.ipynb"
BEAM = str(MODELS / "beam.ply")


class Convergence(unittest.TestCase):
    def test_errors_of_the_tip(self):
        spec = importlib.util.spec_from_file_location("convergence", SCRIPT)
        convergence = importlib.util.module_from_spec(spec)
        spec.loader.exec_module(convergence)
        for bricks, percent in [(4, 2.27), (8, 2.41), (16, 1.03)]:  # sprung validate --case cantilever
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


class Notebook(unittest.TestCase):
    def test_draws_itself(self):
        with tempfile.TemporaryDirectory() as folder:
            command = [sys.executable, "-m", "nbconvert", "--to", "notebook", "--execute", "--output-dir", folder]
            environment = dict(os.environ, IPYTHONDIR=folder, JUPYTER_CONFIG_DIR=folder, JUPYTER_RUNTIME_DIR=folder)
            done = subprocess.run(command + [NOTEBOOK], capture_output=True, text=True, env=environment)
            self.assertEqual(done.returncode, 0, done.stderr)
            cells = json.loads((pathlib.Path(folder) / NOTEBOOK.name).read_text())["cells"]
        outputs = [output for cell in cells if cell["cell_type"] == "code" for output in cell["outputs"]]
        drawn = [base64.b64decode(each["data"]["image/png"]) for each in outputs if "image/png" in each.get("data", {})]
        self.assertEqual([png[:8] for png in drawn], [b"\x89PNG\r\n\x1a\n"] * 2)
        self.assertGreater(min(len(png) for png in drawn), 10000)
        said = "".join("".join(each["text"]) for each in outputs if each["output_type"] == "stream")
        heights = [float(line.split()[-2]) for line in said.splitlines()]
        self.assertEqual(len(heights), 3)
        self.assertEqual(heights, sorted(heights), "the stiffer, the less it sags")


if __name__ == "__main__":
    unittest.main()
