"""Soft bodies of real materials: meshes filled with bricks, moved, measured and drawn. SI units throughout.

Shapes: m nodes, n bricks, v vertices of the skin, t triangles.
"""

from typing import Optional, Sequence

import numpy as np
from numpy.typing import NDArray

class Error(RuntimeError):
    """What the library throws: a mesh, a material or a name that is wrong, a motion that diverged."""

class Material:
    def __init__(
        self, young: float, poisson: float, density: float, damping: float = 0.02, name: str = "custom"
    ) -> None: ...
    @property
    def name(self) -> str: ...
    @property
    def young(self) -> float: ...  # Pa
    @property
    def poisson(self) -> float: ...  # -1 to 0.5
    @property
    def density(self) -> float: ...  # kg/m3
    @property
    def damping(self) -> float: ...  # ratio of critical damping at the slowest vibration
    @property
    def source(self) -> str: ...

def material(name: str) -> Material:
    """A built-in material; Error with the nearest name where there is none."""

def materials() -> list[str]:
    """The names of the built-in materials."""

class Body:
    """One solid filled with bricks. Arrays without a copy are views: they show each state as the world moves on."""

    @property
    def positions(self) -> NDArray[np.float64]: ...  # (m, 3) m, no copy, may be written to
    @property
    def velocities(self) -> NDArray[np.float64]: ...  # (m, 3) m/s, no copy, may be written to
    @property
    def rest_positions(self) -> NDArray[np.float64]: ...  # (m, 3) m, no copy, read only
    @property
    def nodes(self) -> NDArray[np.int32]: ...  # (n, 8) rows of positions, x runs fastest; no copy, read only
    @property
    def masses(self) -> NDArray[np.float64]: ...  # (m,) kg
    @property
    def brick_size(self) -> float: ...  # m
    @property
    def material(self) -> Material: ...
    def field(self, name: str) -> NDArray[np.float64]:
        """(n,): stretch (1), strain (1), stress (Pa, von Mises), volume (over that at rest), fill (1), young (Pa)."""

    def skin_positions(self) -> NDArray[np.float64]: ...  # (v, 3) m
    def triangles(self) -> NDArray[np.int32]: ...  # (t, 3) rows of skin_positions
    def pin(self, nodes: Sequence[int]) -> None:
        """Holds these nodes where they are, and no others."""

    def settle(self, linear: bool = False) -> None:
        """Equilibrium with gravity and the pinned nodes; linear: for small displacements. Obstacles are not met."""

class World:
    def __init__(self, gravity: Sequence[float] = (0, -9.81, 0), ground: Optional[float] = 0.0) -> None:
        """gravity (3,) m/s2; ground: height of level ground, m, or None."""

    def add(
        self,
        mesh: str,
        material: Material,
        size: float = 0.2,
        bricks: int = 24,
        position: Sequence[float] = (0, 0, 0),
        model: str = "calibrated",
    ) -> list[Body]:
        """A body for every solid of a mesh file, its longest side `size` m and `bricks` bricks long; position (3,) m of
        the middle of the bottom of its bounding box."""

    def advance(self, duration: float) -> None:
        """Moves on by `duration` s, by steps that are stable."""

    def step(self, dt: float, count: int = 1) -> None:
        """`count` explicit steps of dt s."""

    def stable_step(self) -> float: ...  # s
    @property
    def time(self) -> float: ...  # s
    def render(
        self, width: int = 640, height: int = 360, azimuth: float = 30.0, elevation: float = 14.0
    ) -> NDArray[np.uint8]:
        """(height, width, 3) sRGB, from azimuth (degrees about y) and elevation (degrees above the horizon)."""
