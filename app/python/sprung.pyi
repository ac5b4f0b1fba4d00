"""Soft bodies of real materials: meshes filled with bricks, moved, measured and drawn. SI units.

The texts are those of the module, so help(sprung.Body) has them too; tests/python holds both to what the module gives.
"""

from os import PathLike
from typing import Any, Callable, Sequence

import numpy as np
from numpy.typing import ArrayLike, NDArray

__version__: str

class Error(RuntimeError):
    """Raised by the library: a mesh, a material, a value or a name is wrong."""

class Diverged(Error):
    """A motion or an equilibrium that does not converge; the message says where."""

class Material:
    """What bricks are made of: isotropic, and linear for small strains."""

    def __init__(
        self,
        young: float,
        poisson: float,
        density: float,
        damping: float = 0.02,
        name: str = "custom",
        law: str = "neo-hooke",
        mooney_share: float | None = None,
        fung_exponent: float | None = None,
        ogden_exponents: Sequence[float] = [],
        ogden_shares: Sequence[float] = [],
    ) -> None:
        """young: Pa; poisson: above -1 and below 0.5; density: kg/m3; damping: fraction of critical, at the slowest
        vibration; law: at large strains, neo-hooke, mooney-rivlin, ogden, fung or linear, with its parameters as in a
        scene."""
    @property
    def name(self) -> str:
        """The name it was given."""
    @property
    def young(self) -> float:
        """Young's modulus, Pa."""
    @property
    def poisson(self) -> float:
        """Poisson's ratio, 1."""
    @property
    def poisson_in_motion(self) -> float | None:
        """Poisson's ratio in motions, 1; None: the same."""
    @property
    def density(self) -> float:
        """Density, kg/m3."""
    @property
    def damping(self) -> float:
        """Ratio of critical damping at the slowest vibration, 1."""
    @property
    def law(self) -> str:
        """The law at large strains."""
    @property
    def source(self) -> str:
        """Source of a built-in material's figures."""

def material(name: str) -> Material:
    """A built-in material; Error with the nearest name where there is none."""

def materials() -> list[str]:
    """The names of the built-in materials."""

class Mesh:
    """A surface of triangles, as a file or a script gives it."""

    def __init__(self, positions: ArrayLike, triangles: ArrayLike) -> None:
        """positions: (k, 3), in any unit; triangles: (t, 3) rows of positions, from 0, counter-clockwise from
        outside."""
    @property
    def positions(self) -> NDArray[np.float64]:
        """(k, 3) units of the file; no copy, read only."""
    @property
    def triangles(self) -> NDArray[np.int32]:
        """(t, 3) rows of positions; no copy, read only."""
    @property
    def notes(self) -> list[str]:
        """What was ignored in the file, one sentence each."""

def read_mesh(file: str | PathLike[str]) -> Mesh:
    """The mesh in a file: OBJ, PLY, STL, OFF, or whatever assimp reads; Error says what is wrong and where."""

class Body:
    """One solid filled with bricks: m nodes, n bricks; its skin: v vertices, t triangles."""

    @property
    def positions(self) -> NDArray[np.float64]:
        """(m, 3) m; no copy, writable."""
    @property
    def velocities(self) -> NDArray[np.float64]:
        """(m, 3) m/s; no copy, writable."""
    @property
    def rest_positions(self) -> NDArray[np.float64]:
        """(m, 3) m; no copy, read only."""
    @property
    def masses(self) -> NDArray[np.float64]:
        """(m,) kg; no copy, read only."""
    @property
    def nodes(self) -> NDArray[np.int32]:
        """(n, 8) rows of positions, x fastest; no copy, read only."""
    @property
    def triangles(self) -> NDArray[np.int32]:
        """(t, 3) rows of skin_positions(); no copy, read only."""
    @property
    def brick_size(self) -> float:
        """Side of a brick, m."""
    @property
    def material(self) -> Material:
        """Its material."""
    def field(self, name: str) -> NDArray[np.float64]:
        """(n,) stretch, strain (von Mises), volume (over that at rest), fill, 1; stress (von Mises), young, Pa."""
    def stress(self, small: bool = False) -> NDArray[np.float64]:
        """(m, 6) Cauchy stress at the nodes: xx, yy, zz, xy, yz, zx, Pa. Continued from the bricks' middles to their corners by their neighbours; small: of displacements as those of settle(linear=True)."""
    def skin_stress(self, small: bool = False) -> NDArray[np.float64]:
        """(v, 6) Pa, the same at the vertices of the skin."""
    def skin_positions(self) -> NDArray[np.float64]:
        """(v, 3) m."""
    def pin(self, nodes: Sequence[int] | NDArray[np.integer] | NDArray[np.bool_]) -> None:
        """Fixes these nodes where they are, and no others: rows, or (m,) bools."""
    def settle(self, linear: bool = False) -> None:
        """Equilibrium with gravity, the constant forces of the scene and the pinned nodes; linear: for small
        displacements. Obstacles are not met; other loads are refused."""

class World:
    """Bodies that move and touch each other. Threads take turns; where an Error is raised nothing changes."""

    def __init__(self, gravity: ArrayLike = [0.0, -9.81, 0.0], ground: float | None = 0.0) -> None:
        """gravity: (3,) m/s2; ground: height of level ground, m, or None."""
    def add(
        self,
        mesh: str | PathLike[str] | Mesh,
        material: Material,
        size: float = 0.2,
        bricks: int = 24,
        position: ArrayLike = [0.0, 0.0, 0.0],
        model: str = "calibrated",
        **keys: Any,
    ) -> list[Body]:
        """A body for every solid of a mesh or a file of one. size: longest side, m; bricks: along that; position: (3,)
        m, of the middle of the bottom of the bounding box; model: as for sprung animate --model; keys: others of
        [[body]] in scenes, pin=[{...}], force=[{...}], velocity=[...] ..."""
    @staticmethod
    def from_scene(scene: str | PathLike[str] | dict[str, Any]) -> World:
        """Everything in a scene: bodies, pins, forces, obstacles, glue. scene: a TOML file, or a dict of the same keys;
        paths in a dict are relative to the working folder."""
    @property
    def bodies(self) -> list[Body]:
        """All bodies, in the order in which they were added."""
    def advance(self, duration: float) -> None:
        """Advances by duration, s, in stable time steps."""
    def step(self, dt: float, count: int = 1) -> None:
        """Exactly count explicit time steps of dt, s."""
    def stable_step(self) -> float:
        """Longest stable explicit time step in the present state, s."""
    @property
    def time(self) -> float:
        """Since the start, s."""
    def render(
        self, width: int = 640, height: int = 360, azimuth: float = 30.0, elevation: float = 14.0
    ) -> NDArray[np.uint8]:
        """(height, width, 3) sRGB bytes; azimuth: degrees about y; elevation: degrees above the horizon."""

class Run:
    """The frames of a scene."""

    @property
    def frame_count(self) -> int:
        """How many frames there are."""
    @property
    def progress(self) -> NDArray[np.float64]:
        """(frames,) time, s, or share of the load, or number of the mode, 1."""
    @property
    def seconds(self) -> NDArray[np.float64]:
        """(frames,) s, of computing; those of an earlier run that this one went on from included."""
    @property
    def scene(self) -> str:
        """The scene as resolved, as TOML."""
    @property
    def frequencies(self) -> NDArray[np.float64]:
        """(modes,) Hz."""
    @property
    def state_hash(self) -> int:
        """Of every bit of the last state, as sprung simulate prints it."""
    def positions(self, frame: int) -> list[NDArray[np.float64]]:
        """By body: (m, 3) m, of the nodes in a frame, from 0; -1 is the last."""
    def velocities(self, frame: int) -> list[NDArray[np.float64]]:
        """By body: (m, 3) m/s, of the nodes in a frame."""
    def skin_positions(self, frame: int) -> list[NDArray[np.float64]]:
        """By body: (v, 3) m."""
    @property
    def triangles(self) -> list[NDArray[np.int32]]:
        """By body: (t, 3) rows of skin_positions()."""
    @property
    def probes(self) -> dict[str, dict[str, NDArray[np.float64]]]:
        """By name: position, displacement, m; force, N; torque, N m; stress (xx, yy, zz), shear_stress (xy, yz, zx), Pa; each (frames, 3)."""

def simulate(
    scene: str | PathLike[str] | dict[str, Any],
    cache: str | PathLike[str] | None = None,
    resume: bool = False,
    progress: Callable[[str, float, float], object] | None = None,
    on_frame: Callable[[int, float, list[NDArray[np.float64]]], object] | None = None,
) -> Run:
    """Computes all frames of a scene, as sprung simulate does. scene: a TOML file, or a dict of the same keys;
    cache: an HDF5 file to keep the frames in; resume: continues the run in it; progress(stage, share, seconds_to_go):
    called between time steps, up to ten times a second; on_frame(frame, progress, positions): called after each frame,
    with the nodes of each body, (m, 3) m. What these raise ends the run."""

def read_run(cache: str | PathLike[str]) -> Run:
    """The run in a cache, as sprung simulate wrote it."""

def load(
    mesh: str | PathLike[str] | Mesh,
    fix: str | list[str],
    load: str | list[str],
    material: str | Material = "abs",
    unit: str = "",
    bricks: int | None = None,
    at: ArrayLike = [],
    analysis: str = "auto",
    modes: int = 0,
    buckling: bool = False,
    up: str | None = None,
) -> dict[str, Any]:
    """How far a part bends and whether it holds: what sprung load --json prints. mesh: a file, or a Mesh; fix, load: one
    or several, as for sprung load; unit: of the mesh, mm unless it is glTF; bricks: along its longest side; at: (k, 3)
    units of the mesh, points to answer at; analysis: 'auto', 'linear', 'nonlinear'; modes: how many vibrations;
    buckling: whether to find its load; up: 'y' or 'z'."""
