"""Checks and conversions of arguments that several functions share."""

from __future__ import annotations

import warnings
from typing import Any, Callable, Optional

import numpy as np

Progress = Optional[Callable[[str, float], Any]]
"""A function that is called a few times a second with a word for what is done, and its share."""

AXES = {"x": 0, "y": 1, "z": 2}


def numbers(name: str, values: Any) -> np.ndarray:
    """Return an array of finite doubles; the same one where it is that already."""
    array = np.asarray(values)
    if array.dtype.kind not in "fiu":
        raise ValueError(f"{name}: expected numbers, found an array of {array.dtype}")
    array = np.asarray(array, dtype=np.float64, order="C")
    if not np.isfinite(array).all():
        place = np.argwhere(~np.isfinite(array))[0].tolist()
        raise ValueError(f"{name}{place}: expected finite numbers, found {array[tuple(place)]}")
    return array


def rows_of_three(name: str, values: Any) -> np.ndarray:
    """Return an array of finite doubles of shape (n, 3)."""
    array = numbers(name, values)
    if array.ndim != 2 or array.shape[1] != 3:
        raise ValueError(f"{name}: expected an array of shape (n, 3), found {array.shape}")
    return array


def places_with_normals(name: str, points: Any) -> np.ndarray:
    """Return points with normals as an array (p, 6), none for None."""
    if points is None:
        return np.empty((0, 6))
    places = np.asarray(points, dtype=float)
    if places.ndim != 2 or places.shape[1] != 6 or not np.isfinite(places).all():
        raise ValueError(f"{name}: expected rows of six numbers x, y, z, nx, ny, nz")
    if not places[:, 3:].any(axis=1).all():
        raise ValueError(f"{name}: expected a normal that is not 0, 0, 0")
    return places


def whole_numbers(name: str, values: Any) -> np.ndarray:
    """Return an array of int64; fractions are refused, whole numbers in floats too."""
    array = np.asarray(values)
    if array.dtype.kind not in "iu":
        raise ValueError(f"{name}: expected whole numbers, found an array of {array.dtype}")
    return np.ascontiguousarray(array, dtype=np.int64)


def natural(name: str, value: Any, most: int) -> int:
    """Return a whole number from 0 to ``most``."""
    if isinstance(value, (bool, np.bool_)) or not isinstance(value, (int, np.integer)):
        raise ValueError(f"{name}: expected a whole number, found {value!r}")
    if not 0 <= value <= most:
        raise ValueError(f"{name}: expected a whole number from 0 to {most}, found {value}")
    return int(value)


def labels(name: str, values: Any, count: int) -> tuple[list[str], np.ndarray]:
    """Return the names among the labels, as they first appear, and the index of each label's."""
    array = np.asarray(values)
    if array.shape != (count,):
        raise ValueError(f"{name}: expected {count} names or whole numbers, found an array of shape "
                         f"{array.shape}")
    if array.dtype.kind not in "iuUS":
        raise ValueError(f"{name}: expected names or whole numbers")
    found, first, index = np.unique(array, return_index=True, return_inverse=True)
    order = np.argsort(first)
    place = np.empty_like(order)
    place[order] = np.arange(len(order))
    return found[order].astype(str).tolist(), place[index.reshape(-1)].astype(np.int64)


def axis(up: str) -> int:
    """Return the number of an axis."""
    if up not in AXES:
        raise ValueError(f"up: expected 'x', 'y' or 'z', found {up!r}")
    return AXES[up]


def threads_and_seed(threads: int, seed: int) -> tuple[int, int]:
    """Return both, checked."""
    return natural("threads", threads, 4096), natural("seed", seed, 2**64 - 1)


def warn(text: str, frames: int = 1) -> None:
    """Warn the caller of the package, which is so many functions above the one that calls this."""
    warnings.warn(text, stacklevel=2 + frames)
