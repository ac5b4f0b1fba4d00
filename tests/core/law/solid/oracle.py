"""One brick of the default model, written down as plainly as possible: what the program is compared with.

SI units. Corner c of a brick lies on the high side of axis i where bit i of c is set (x is bit 0). What a brick knows of
its solid: `volume` (m^3), `centroid` (from the brick's middle, in brick lengths) and `second`, the 3 x 3 second moments
about the centroid, int d_j d_k dV (m^5). energy() takes complex corners too, so that forces() is its gradient by complex
steps, exact to rounding: no derivative is written down that the program could share a mistake with.

Without arguments it checks itself. With a file it compares: each line has, separated by spaces, E, nu, h, the volume, the
centroid (3), the second moments (9), the corners (24), a direction u (24), and what another program made of them: energy,
forces (24), Hessian times u (24). It prints the largest relative differences, and fails where one is above its limit.
"""

import functools
import sys
from collections import namedtuple

import numpy as np

Solid = namedtuple("Solid", "volume centroid second")
SIDES = np.array([[1 if c >> axis & 1 else -1 for axis in range(3)] for c in range(8)])
WARPING = 3
LOWEST = 0.08  # volume ratio, below which the logarithm goes on as a cubic, and below zero as a parabola
STIFFENING = 100  # growth of its curvature in between


def full_brick(h):
    return Solid(h**3, np.zeros(3), np.eye(3) * h**5 / 12)


def lame(young, nu):
    return young * nu / ((1 + nu) * (1 - 2 * nu)), young / (2 * (1 + nu))


def density(F, young, nu):
    """J/m^3."""
    lam, G = lame(young, nu)
    J = F[:, 0] @ np.cross(F[:, 1], F[:, 2])
    d = (J - LOWEST) / LOWEST
    if J.real >= LOWEST:
        log_J = np.log(J)
    elif J.real >= 0:
        log_J = np.log(LOWEST) + d - d**2 / 2 + STIFFENING / 6 * d**3
    else:
        e = J / LOWEST
        log_J = np.log(LOWEST) - 1.5 - STIFFENING / 6 + (2 + STIFFENING / 2) * e - (1 + STIFFENING) / 2 * e**2
    change = (J - 1) ** 2 if lam >= 0 else (J - 1) ** 2 / (1 + (J - 1) ** 2)
    return G / 2 * (np.sum(F * F) - 3) - G * log_J + lam / 2 * change


def square(v, rest):
    """To first order the length of v, but for a constant."""
    return np.sum(v * v) / (2 * rest)


def modes(x, centroid, h):
    """The deformation gradient at the centroid (3 x 3), and the differences b[i, j] (1/m), q[i] (1/m^2), t[k] (1/m)."""
    F, b, q, t = (np.zeros(shape, x.dtype) for shape in ((3, 3), (3, 3), 3, 3))

    def weight(side, place):
        return 0.5 + side * place

    for i in range(3):
        j, k = (i + 1) % 3, (i + 2) % 3
        for low in (c for c in range(8) if not c >> i & 1):
            edge = x[low | 1 << i] - x[low]
            sj, sk = SIDES[low, j], SIDES[low, k]
            F[:, i] += weight(sj, centroid[j]) * weight(sk, centroid[k]) * edge / h
            b[i, j] += sj * weight(sk, centroid[k]) * square(edge, h) / h**2
            b[i, k] += sk * weight(sj, centroid[j]) * square(edge, h) / h**2
            q[i] += sj * sk * square(edge, h) / h**3
        for side in (0, 1):
            base = side << i
            up = square(x[base | 1 << j | 1 << k] - x[base], np.sqrt(2) * h)
            down = square(x[base | 1 << k] - x[base | 1 << j], np.sqrt(2) * h)
            t[i] += (1 if side else -1) * (up - down) / (np.sqrt(2) * h) / h
    return F, b, q, t


def strain_along(b, t, free):
    """The engineering strains 00, 11, 22, 12, 20, 01 by the three axes (6 x 3), of b, t and what no corner has: free[i, i]
    is the strain ii along i, free[i, j] the shear ij along i."""
    along = np.zeros((6, 3), np.result_type(b, free))
    for i in range(3):
        along[i, i] = free[i, i]
        along[3 + i, i] = t[i]
        for j in range(3):
            if i != j:
                along[i, j] = b[i, j]
                along[6 - i - j, i] = free[i, j]
    return along


@functools.lru_cache(maxsize=None)
def gradient_stiffness(second, young, nu):
    """18 x 18: the integral of one strain's stress on another strain, where both change linearly from none at the
    centroid; of their changes by the axes (6 x 3, flat). `second`: row by row."""
    lam, G = lame(young, nu)
    hooke = np.diag([2 * G] * 3 + [G] * 3)
    hooke[:3, :3] += lam
    return np.einsum("st,kl->sktl", hooke, np.reshape(second, (3, 3))).reshape(18, 18)


@functools.lru_cache(maxsize=None)
def cheapest(second, young, nu):
    """What is free (9) of what costs least, by what the corners have: of strain_along() with b and t alone (18)."""
    zero = np.zeros((3, 3))
    units = np.array([strain_along(zero, np.zeros(3), unit.reshape(3, 3)).ravel() for unit in np.eye(9)])
    stiffness = gradient_stiffness(second, young, nu)
    return -np.linalg.solve(units @ stiffness @ units.T, units @ stiffness)


def least_energy(b, t, second, young, nu):
    """The energy of the strain's changes where what is free takes what costs least, and these changes."""
    key = tuple(second.ravel()), young, nu
    given = strain_along(b, t, np.zeros((3, 3))).ravel()
    along = strain_along(b, t, (cheapest(*key) @ given).reshape(3, 3))
    return along.ravel() @ gradient_stiffness(*key) @ along.ravel() / 2, along


def tangent(centroid, b, along, h):
    """What makes the trilinear map's gradient at the centroid that of the bent solid, but for its change of thickness."""
    bend = np.eye(3, dtype=along.dtype)
    for i in range(3):
        for j in range(3):
            if i != j:
                half = h * centroid[i] * (along[6 - i - j, i] - b[i, j]) / 2  # u_j by i twice
                bend[i, j] += half
                bend[j, i] += half
    return bend


def energy(x, solid, young, nu, h):
    """J, of corners x (8 x 3, m)."""
    F, b, q, t = modes(x, solid.centroid, h)
    m, V = solid.second, solid.volume
    for k in range(3):
        i, j = (k + 1) % 3, (k + 2) % 3
        t[k] += h * (solid.centroid[i] * q[i] + solid.centroid[j] * q[j])
    bending, along = least_energy(b, t, m, young, nu)
    W = V * density(F @ tangent(solid.centroid, b, along, h), young, nu) + bending
    for g in range(3):
        i, k = (g + 1) % 3, (g + 2) % 3
        W += 0.5 * WARPING * young * m[i, i] * m[k, k] / V * q[g] ** 2
    return W


def forces(x, solid, young, nu, h):
    """-dW/dx, N, 8 x 3."""
    step = 1e-30 * h
    f = np.zeros((8, 3))
    for c in range(8):
        for axis in range(3):
            moved = x.astype(complex)
            moved[c, axis] += 1j * step
            f[c, axis] = -energy(moved, solid, young, nu, h).imag / step
    return f


def change_of_forces(x, u, solid, young, nu, h):
    """Of -forces() in the direction u (8 x 3): the Hessian times u, by central differences good to some 1e-9."""
    step = 1e-6 * h / np.abs(u).max()
    change = forces(x - step * u, solid, young, nu, h) - forces(x + step * u, solid, young, nu, h)
    return change / (2 * step)


LIMITS = {"energy": 1e-12, "forces": 1e-12, "hessian": 1e-7}


def compare(file):
    worst = dict.fromkeys(LIMITS, 0.0)

    def note(what, theirs, ours):
        worst[what] = max(worst[what], np.abs(theirs - ours).max() / np.abs(ours).max())

    rows = np.atleast_2d(np.loadtxt(file))
    for row in rows:
        young, nu, h, volume = row[:4]
        solid = Solid(volume, row[4:7], row[7:16].reshape(3, 3))
        x, u = row[16:40].reshape(8, 3), row[40:64].reshape(8, 3)
        note("energy", row[64], energy(x, solid, young, nu, h))
        note("forces", row[65:89].reshape(8, 3), forces(x, solid, young, nu, h))
        note("hessian", row[89:113].reshape(8, 3), change_of_forces(x, u, solid, young, nu, h))
    print(len(rows), "bricks:", ", ".join("%s %.1e" % item for item in worst.items()))
    return all(worst[what] < limit for what, limit in LIMITS.items())


def check():
    """Uniform strain, bending, twist and momentum by what a continuum does."""
    rng = np.random.default_rng(1)
    young, nu, h = 2e4, 0.4, 0.05
    rest = SIDES * h / 2
    root = rng.normal(size=(3, 3))
    cut = Solid(0.3 * h**3, np.array([0.2, -0.1, 0.05]), h**5 * 0.01 * root @ root.T)
    F = np.eye(3) + 0.4 * rng.normal(size=(3, 3))
    faults = {"uniform strain": energy(rest @ F.T + 0.7, cut, young, nu, h) / (cut.volume * density(F, young, nu)) - 1}
    full, a = full_brick(h), 1e-4 / h
    X, Y, Z = rest.T
    bend = rest + np.column_stack([a * X * Y, -a * X**2 / 2 + nu * a * (Z**2 - Y**2) / 2, -nu * a * Y * Z])
    faults["bending"] = (energy(bend, full, young, nu, h) / (young * h**5 / 24 * a**2) - 1) / 1e4
    twist = rest + np.column_stack([-a * Y * Z, a * X * Z, 0 * X])
    faults["twist"] = (energy(twist, full, young, nu, h) / (lame(young, nu)[1] * h**5 / 12 * a**2) - 1) / 1e4
    wild = rest + 0.3 * h * rng.normal(size=(8, 3))
    f = forces(wild, cut, young, nu, h)
    faults["momentum"] = np.abs(f.sum(0)).max() / np.abs(f).max()
    faults["angular momentum"] = np.abs(np.cross(wild, f).sum(0)).max() / np.abs(f).max() / h
    for name, fault in faults.items():
        print("%-18s %.1e" % (name, fault))
    return all(abs(fault) < 1e-10 for fault in faults.values())


if __name__ == "__main__":
    sys.exit(0 if (compare(sys.argv[1]) if len(sys.argv) > 1 else check()) else 1)
