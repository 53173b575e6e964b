"""The share of surfaces that the sun shines on."""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np

from . import _hemilux
from ._checks import Progress, places_with_normals, rows_of_three, threads_and_seed
from ._mesh import Mesh


class Sunlit(NamedTuple):
    """Sunlit fractions of surfaces and points, a row for each sun.

    Attributes
    ----------
    fraction : ndarray of float64, shape (s, n)
        The share of each surface's area that sees the sun from its front [-].
    standard_error : ndarray of float64, shape (s, n)
        Of each [-]; 0: the fraction is exact.
    points : ndarray of float64, shape (s, p)
        1 where the sun shines on a point, else 0.
    name : list of str
        Of the surfaces, as `ViewFactors.name`.
    """

    fraction: np.ndarray
    standard_error: np.ndarray
    points: np.ndarray
    name: list[str]


def sunlit(mesh: Mesh, suns: Any, error: float = 0.01, *, by: str = "face", points: Any = None,
           threads: int = 0, seed: int = 1, progress: Progress = None) -> Sunlit:
    """Find which share of each surface the sun shines on, as ``hemilux viewfactors --sunlit``.

    Parameters
    ----------
    mesh : Mesh
    suns : array_like of float, shape (s, 3)
        Directions in which the light of each sun goes.
    error : float, optional
        Standard error of a fraction that is not exact [-].
    by : {'face', 'group', 'material', 'patch'}, optional
        What a surface is, as for `view_factors`.
    points : array_like of float, shape (p, 6), optional
        Points with normals x, y, z, nx, ny, nz.
    threads : int, optional
        Threads; 0: one per core. The result does not depend on it.
    seed : int, optional
        Of the random numbers. The same seed gives the same bytes.
    progress : callable, optional
        Is called as ``progress(phase, share)`` a few times a second.

    Returns
    -------
    Sunlit

    Raises
    ------
    ValueError
        For an argument that is wrong.
    KeyboardInterrupt
        After Ctrl-C.
    """
    number, chosen_seed = threads_and_seed(threads, seed)
    directions = rows_of_three("suns", suns)
    if not directions.any(axis=1).all():
        raise ValueError("suns: expected directions that are not 0, 0, 0")
    places = places_with_normals("points", points)
    found = _hemilux.sunlit(mesh._core, directions, float(error), by, chosen_seed, number,
                            places[:, :3], places[:, 3:], progress)
    n = len(found["name"])
    fraction, errors = (found[key].reshape(len(directions), n + len(places))
                        for key in ("sunlit", "standard_error"))
    return Sunlit(fraction[:, :n], errors[:, :n], fraction[:, n:], found["name"])
