"""Scenes of the tests, and their closed forms."""

from math import atan, log, pi, sqrt

import numpy as np

import hemilux

UNIT_SQUARES = {
    "floor": [[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]],
    "ceiling": [[0, 0, 1], [0, 1, 1], [1, 1, 1], [1, 0, 1]],
    "wall": [[0, 0, 0], [0, 1, 0], [0, 1, 1], [0, 0, 1]],
}

CUBE = [[x, y, z] for z in (0, 1) for y in (0, 1) for x in (0, 1)]
INWARDS = [[0, 1, 3, 2], [4, 6, 7, 5], [0, 4, 5, 1], [1, 5, 7, 3], [3, 7, 6, 2], [2, 6, 4, 0]]

PARALLEL = 0.19982489569838
"""From a unit square to the one opposite (Howell, C-11)."""


def perpendicular(width: float, height: float, length: float) -> float:
    """From a rectangle to one that stands on its edge of this length (Howell, C-14)."""
    w, h = width / length, height / length
    ww, hh = w * w, h * h
    both = 1 + ww + hh
    return (w * atan(1 / w) + h * atan(1 / h) - sqrt(ww + hh) * atan(1 / sqrt(ww + hh))
            + log((1 + ww) * (1 + hh) / both * (ww * both / ((1 + ww) * (ww + hh))) ** ww
                  * (hh * both / ((1 + hh) * (ww + hh))) ** hh) / 4) / (pi * w)


def squares(*names: str, **options) -> hemilux.Mesh:
    """Some of the unit squares, a group each."""
    vertices = np.concatenate([UNIT_SQUARES[name] for name in names]).astype(float)
    return hemilux.Mesh(vertices, np.arange(len(vertices)).reshape(-1, 4), list(names), **options)


def boxes(side: int, **options) -> hemilux.Mesh:
    """A ground of side by side cells, each with a box on it."""
    corners = np.array(CUBE, dtype=float)
    faces = np.array([[0, 1, 5, 4], [1, 3, 7, 5], [3, 2, 6, 7], [2, 0, 4, 6], [4, 5, 7, 6]])
    vertices, polygons = [], []
    for i in range(side):
        for j in range(side):
            polygons.append(faces + 8 * len(vertices))
            vertices.append(corners * [1, 1, 1 + (3 * i + 5 * j) % 4] + [2 * i, 2 * j, 0])
    far = 2.0 * side
    ground = [[-1, -1, 0], [far, -1, 0], [far, far, 0], [-1, far, 0]]
    polygons.append([np.arange(4) + 8 * len(vertices)])
    vertices.append(ground)
    return hemilux.Mesh(np.concatenate(vertices), np.concatenate(polygons), **options)


def furnace(reflectance: float) -> hemilux.Mesh:
    """A cube seen from inside, all of which emits and reflects alike: B = E / (1 - rho)."""
    return hemilux.Mesh(CUBE, INWARDS, reflectance=reflectance, emission=1)


def room(**options) -> hemilux.Mesh:
    """A cube seen from inside; its ceiling emits, and each wall has a colour."""
    reflectance = np.array([[.5, .5, .5], [.2, .2, .2], [.6, .3, .3], [.3, .6, .3], [.3, .3, .6],
                            [.5, .4, .3]])
    emission = np.zeros((6, 3))
    emission[1] = 1
    return hemilux.Mesh(CUBE, INWARDS, reflectance=reflectance, emission=emission, **options)
