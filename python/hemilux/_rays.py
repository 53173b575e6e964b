"""Single rays: what they meet."""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np

from . import _hemilux
from ._checks import natural, rows_of_three
from ._mesh import Mesh


class Hits(NamedTuple):
    """The nearest face of each ray.

    Attributes
    ----------
    face : ndarray of int64, shape (r,)
        Index of the face, -1 where the ray meets nothing.
    patch : ndarray of int64, shape (r,)
        Index of the patch, -1 also at the back of a one-sided face.
    distance : ndarray of float64, shape (r,)
        From the origin [m], infinite where the ray meets nothing.
    front : ndarray of bool, shape (r,)
        Whether the front of the face was met.
    """

    face: np.ndarray
    patch: np.ndarray
    distance: np.ndarray
    front: np.ndarray


class Rays:
    """Traces rays through a mesh; `rays` makes it. The first call builds the tree of the mesh."""

    def __init__(self, mesh: Mesh, threads: int = 0) -> None:
        self._mesh = mesh
        self._threads = natural("threads", threads, 4096)

    @staticmethod
    def _arrays(origins: Any, directions: Any) -> tuple[np.ndarray, np.ndarray]:
        starts, ways = rows_of_three("origins", origins), rows_of_three("directions", directions)
        if len(starts) != len(ways):
            raise ValueError(f"origins and directions: expected as many of both, found {len(starts)} "
                             f"and {len(ways)}")
        if not ways.any(axis=1).all():
            raise ValueError("directions: expected no direction of length 0")
        return starts, ways

    def closest(self, origins: Any, directions: Any) -> Hits:
        """Find the nearest face of each ray.

        Parameters
        ----------
        origins : array_like of float, shape (r, 3)
            Where rays start [m].
        directions : array_like of float, shape (r, 3)
            Directions of any length but 0.

        Returns
        -------
        Hits
        """
        face, patch, distance, front = _hemilux.closest(
            self._mesh._core, *self._arrays(origins, directions), self._threads)
        return Hits(face, patch, distance, front.view(bool))

    def count(self, origins: Any, directions: Any) -> np.ndarray:
        """Count the faces that each ray pierces, on its whole way.

        Parameters
        ----------
        origins, directions : array_like of float, shape (r, 3)
            As of `closest`.

        Returns
        -------
        ndarray of int64, shape (r,)
            Faces, or triangles and quads where faces are divided. A ray through a shared edge counts
            one of the two.
        """
        return _hemilux.count(self._mesh._core, *self._arrays(origins, directions), self._threads)


def rays(mesh: Mesh, *, threads: int = 0) -> Rays:
    """Return a tracer of rays through a mesh.

    Parameters
    ----------
    mesh : Mesh
    threads : int, optional
        Threads that trace; 0: one per core.

    Returns
    -------
    Rays
    """
    return Rays(mesh, threads)
