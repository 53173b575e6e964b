"""Light that is gathered from a solution: at points, in pictures and lightmaps, and of each lamp."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from . import _hemilux
from ._checks import threads_and_seed, warn


@dataclass(frozen=True, repr=False)
class _Gathered:
    """What comes with all gathered light.

    Attributes
    ----------
    estimated_error : float
        Relative root mean square over places and channels [-]; NaN where it is not known.
    error_bound : float
        The error is below it in 19 of 20 runs [-].
    error_local : float
        What 95 of 100 places are within, relative to the light there [-].
    rays : int
        Rays that were traced to learn, gather and judge the light.
    warnings : list of str
        What there is to warn of.
    """

    estimated_error: float
    error_bound: float
    error_local: float
    rays: int
    warnings: list[str]

    def __repr__(self) -> str:
        return (f"<hemilux.{type(self).__name__}: estimated error {self.estimated_error:.2g}, "
                f"surely below {self.error_bound:.2g}>")


@dataclass(frozen=True, repr=False)
class PointLight(_Gathered):
    """The light at points.

    Attributes
    ----------
    irradiance, standard_error : ndarray of float64, shape (n, 3)
        Light that arrives, and its standard error [W/m2].
    is_known : ndarray of bool, shape (n,)
        False for points that lie on no face where a limit ended the work before.
    """

    irradiance: np.ndarray
    standard_error: np.ndarray
    is_known: np.ndarray


@dataclass(frozen=True, repr=False)
class Picture(_Gathered):
    """The light that a camera shows.

    Attributes
    ----------
    light : ndarray of float32, shape (height, width, 3)
        Linear radiosity [W/m2], from the top left; black where there is no surface.
    camera : tuple of float
        Eye, target, vertical angle [degrees] and direction upwards.
    """

    light: np.ndarray
    camera: tuple[float, ...]


@dataclass(frozen=True, repr=False)
class Lightmap(_Gathered):
    """The light of a square on which all surfaces have a place.

    Attributes
    ----------
    light : ndarray of float32, shape (size, size, 3)
        [W/m2], from the top left.
    face : ndarray of int64, shape (n,)
        Face of each triangle.
    corners : ndarray of float64, shape (n, 3, 3)
        Corners of each triangle [m].
    places : ndarray of float64, shape (n, 3, 2)
        Their places on the square, from 0 to 1, from the top left.
    """

    light: np.ndarray
    face: np.ndarray
    corners: np.ndarray
    places: np.ndarray


@dataclass(frozen=True)
class Lamp:
    """The light of a lamp by itself.

    Attributes
    ----------
    name : str
        Of its group, else of its material.
    power : ndarray of float64, shape (3,)
        That it emits [W].
    radiosity, standard_error : ndarray of float64, shape (p, 3)
        By patch [W/m2]; the sum over lamps is the solution.
    estimated_error : float
        Relative to the light that it brings [-].
    """

    name: str
    power: np.ndarray
    radiosity: np.ndarray
    standard_error: np.ndarray
    estimated_error: float


def gather(what: str, run: Any, arguments: tuple[Any, ...], error: float,
           asked: dict[str, Any]) -> dict[str, Any]:
    """Call a function of the core that gathers light, and warn of what it found."""
    progress = asked.pop("progress", None)
    of = _hemilux.Asked()
    of.threads, of.seed = threads_and_seed(asked.pop("threads", 0), asked.pop("seed", 1))
    limits = {name: asked.pop(name, None) for name in ("max_rays", "seconds")}
    if asked:
        raise TypeError(f"{what}() got an unexpected keyword argument {next(iter(asked))!r}")
    for name, value in {"error": error, **limits}.items():
        if value is not None and not (isinstance(value, (int, float)) and value > 0):
            raise ValueError(f"{name}: expected a number above 0, found {value!r}")
        setattr(of, name, value)
    found: dict[str, Any] = getattr(_hemilux, what)(run, *arguments, of, progress)
    for text in found["warnings"]:
        warn(text, 2)
    return found


def lamps_of(run: Any, by: str, threads: int, progress: Any) -> list[Lamp]:
    """Return the lamps of a run."""
    return [Lamp(**{**lamp, "power": lamp["power"][0]})
            for lamp in _hemilux.lamps(run, by, threads, progress)]
