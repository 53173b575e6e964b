"""Divided hemispheres: how many surfaces a patch has in which direction."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from . import _hemilux
from ._checks import natural
from ._mesh import Mesh


class Density(NamedTuple):
    """The divided hemisphere of a patch (section 5a of the paper).

    Attributes
    ----------
    triangles : ndarray of float64, shape (t, 3, 3)
        Corners of the spherical triangles: unit vectors in the axes of the scene.
    density : ndarray of float64, shape (t,)
        Mean number of surfaces along the three corners [surfaces per ray].
    level : ndarray of int64, shape (t,)
        How often the octant was divided.
    solid_angle : ndarray of float64, shape (t,)
        [sr]; they sum to 2 pi.
    power_share : ndarray of float64, shape (t,)
        Share of the patch's power by Lambert's law [-]; they sum to 1.
    directions : ndarray of float64, shape (b, 3)
        Directions in which surfaces were counted.
    surfaces : ndarray of uint8, shape (b,)
        What was counted there, the bytes that are stored; 255: as many or more.
    rays : int
        Density rays that were traced.
    """

    triangles: np.ndarray
    density: np.ndarray
    level: np.ndarray
    solid_angle: np.ndarray
    power_share: np.ndarray
    directions: np.ndarray
    surfaces: np.ndarray
    rays: int

    @property
    def bytes(self) -> int:
        """Bytes that are stored of the patch."""
        return self.surfaces.nbytes

    @property
    def average(self) -> float:
        """D_average of the paper, weighted by power [surfaces per ray]."""
        return float(self.power_share @ self.density)


def density(mesh: Mesh, patch: int, *, depth: int = 2, threshold: float = 0.0) -> Density:
    """Divide the hemisphere of a patch by the surfaces that it has in each direction.

    Parameters
    ----------
    mesh : Mesh
    patch : int
        Index of the patch, from 0.
    depth : int, optional
        Levels of division, 0 to 5.
    threshold : float, optional
        A triangle whose density is higher is divided [surfaces per ray].

    Returns
    -------
    Density
    """
    number = natural("patch", patch, 2**32 - 1)
    if not threshold >= 0:
        raise ValueError("threshold: expected a number of at least 0")
    found = _hemilux.density(mesh._core, number, natural("depth", depth, 5), threshold)
    found["triangles"] = found["triangles"].reshape(-1, 3, 3)
    return Density(**found)
