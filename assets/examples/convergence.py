"""The tip of a clamped beam under its weight, on finer and finer bricks, beside converged finite elements.

PYTHONPATH=build/release/python python3 assets/examples/convergence.py --mesh assets/models/beam.ply -o convergence.png
"""
import argparse

import numpy as np
import sprung

# CalculiX C3D20R, converged: 0.4 x 0.1 x 0.1 m, E = 1 kPa, nu = 0.3, a load of 1 N/m3 (assets/experiments).
REFERENCE = -0.004004546  # m
MODELS = ("calibrated", "tensile", "fem")


def tip(mesh, model, bricks):
    """Displacement (m) of the middle of the free end."""
    world = sprung.World(gravity=(0, -1, 0), ground=None)
    soft = sprung.Material(young=1000, poisson=0.3, density=1)
    (beam,) = world.add(mesh, soft, size=0.4, bricks=bricks, model=model)
    rest = beam.rest_positions
    low, high = rest.min(axis=0), rest.max(axis=0)
    beam.pin(np.flatnonzero(rest[:, 0] < low[0] + 1e-6))
    beam.settle(linear=True)
    middle = (high[1:] + low[1:]) / 2
    end = np.flatnonzero(rest[:, 0] > high[0] - 1e-6)
    distance = np.abs(rest[end, 1:] - middle).max(axis=1)
    nearest = end[distance < distance.min() + 1e-6]  # a node there, or the four around it
    return (beam.positions[nearest, 1] - rest[nearest, 1]).mean()


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--mesh", required=True, help="beam.ply of the models")
    parser.add_argument("-o", "--output", default="convergence.png")
    parser.add_argument("--bricks", type=int, nargs="+", default=[4, 8, 16, 32], help="along the beam")
    words = parser.parse_args()
    errors = {
        model: [100 * abs(tip(words.mesh, model, bricks) / REFERENCE - 1) for bricks in words.bricks] for model in MODELS
    }
    for model, row in errors.items():
        print(f"{model:<12}" + "".join(f"{error:8.2f} %" for error in row))

    import matplotlib

    matplotlib.use("Agg")
    from matplotlib import pyplot

    for model, row in errors.items():
        pyplot.loglog(words.bricks, row, "o-", label=model)
    pyplot.xlabel("bricks along the beam")
    pyplot.ylabel("error of the tip, %")
    pyplot.minorticks_off()
    pyplot.xticks(words.bricks, words.bricks)
    pyplot.legend()
    pyplot.savefig(words.output, dpi=120)


if __name__ == "__main__":
    main()
