"""Scenes: faces from arrays or from a file."""

from __future__ import annotations

import os
from typing import Any, Mapping, Optional, Sequence, Union

import numpy as np

from . import _hemilux
from ._checks import axis, labels, numbers, rows_of_three, warn, whole_numbers


def _edge(max_edge: float) -> float:
    if not max_edge >= 0 or not np.isfinite(max_edge):
        raise ValueError("max_edge: expected a length, or 0 for faces that are not divided")
    return float(max_edge)


def _colours(name: str, values: Any, faces: int, most: float) -> np.ndarray:
    """Return an array of shape (faces, 3) or (1, 3)."""
    array = numbers(name, values)
    if array.shape == (3,) and faces == 3:
        raise ValueError(f"{name}: three numbers for three faces may be a colour or greys; "
                         "give an array of shape (1, 3) or (3, 1)")
    if array.ndim == 0:
        array = np.full((1, 3), array)
    elif array.shape == (3,):
        array = array.reshape(1, 3)
    elif array.shape in ((faces,), (faces, 1)):
        array = np.repeat(array.reshape(-1, 1), 3, axis=1)
    if array.shape not in ((1, 3), (faces, 3)):
        raise ValueError(f"{name}: expected a number, a colour of shape (3,), or an array of shape "
                         f"({faces},) or ({faces}, 3), found {array.shape}")
    if (array < 0).any() or (array > most).any():
        allowed = "numbers from 0 to 1" if most == 1 else "numbers of at least 0"
        raise ValueError(f"{name}: expected {allowed}, found {array.min()} to {array.max()}")
    return array


class Mesh:
    """A scene: faces, their colours, and the patches that they are divided into.

    Corners of a face run counter-clockwise as seen from its front. The front alone emits, reflects
    and sees, unless the face is two-sided.

    Parameters
    ----------
    vertices : array_like of float, shape (n, 3)
        Places of the corners [m].
    faces : array_like of int, shape (m, k)
        Indices of the corners of each face, from 0; k is 3 for triangles, 4 for quads. Faces of
        fewer corners than k end with negative numbers. Faces may be concave; those that are not
        planar are divided into triangles.
    group : array_like of str or int, shape (m,), optional
        The group of each face.
    reflectance : array_like of float, optional
        Share of the light that a face reflects [-]: one number, a colour of shape (3,), or one for
        each face of shape (m,) or (m, 3).
    emission : array_like of float, optional
        Light that a face emits [W/m2], in the same shapes.
    two_sided : bool or array_like of bool, shape (m,), optional
        Whether the back counts too.
    max_edge : float, optional
        Faces are divided into patches until no edge is longer [m]; 0: not at all.
    up : {'z', 'y', 'x'}, optional
        The axis that points to the sky.

    Raises
    ------
    ValueError
        For a wrong shape, numbers that are not finite, an index of no vertex, or faces without area.

    Notes
    -----
    Large arrays of the right type are copied once, into the library. ``len(mesh)`` is the number of
    patches.
    """

    def __init__(self, vertices: Any, faces: Any, group: Any = None, reflectance: Any = 0.5,
                 emission: Any = 0.0, *, two_sided: Any = False, max_edge: float = 0.0,
                 up: str = "z") -> None:
        corners = rows_of_three("vertices", vertices)
        polygons = whole_numbers("faces", faces)
        if polygons.ndim != 2 or polygons.shape[0] < 1 or polygons.shape[1] < 3:
            raise ValueError("faces: expected an array of shape (m, k) with k of at least 3, found "
                             f"{polygons.shape}")
        m = polygons.shape[0]
        if max(m, len(corners)) >= 2**32 - 1:
            raise ValueError("vertices and faces: expected fewer than 2**32 - 1 of each")
        names, index = (["default"], np.zeros(m, dtype=np.int64)) if group is None \
            else labels("group", group, m)
        colours = np.hstack(np.broadcast_arrays(_colours("reflectance", reflectance, m, 1),
                                                _colours("emission", emission, m, np.inf)))
        materials, material = np.unique(colours, axis=0, return_inverse=True)
        material = np.broadcast_to(material.reshape(-1).astype(np.int64), (m,)) \
            if len(colours) == 1 else material.reshape(-1).astype(np.int64)
        sides = np.asarray(two_sided)
        if sides.dtype != bool or sides.shape not in ((), (m,)):
            raise ValueError(f"two_sided: expected True, False, or {m} of them")
        sides = np.broadcast_to(sides, (m,))
        self._core = _hemilux.mesh_of(corners, polygons, names, index, materials[:, :3],
                                      materials[:, 3:], material, sides, _edge(max_edge), axis(up))
        for text in self._core.warnings:
            warn(text)

    @classmethod
    def _of(cls, core: Any) -> "Mesh":
        mesh = cls.__new__(cls)
        mesh._core = core
        return mesh

    def __len__(self) -> int:
        return len(self._core)

    def __repr__(self) -> str:
        return (f"<hemilux.Mesh of {self._core.faces} faces, {len(self)} patches, "
                f"{len(self.groups)} groups>")

    @property
    def groups(self) -> list[str]:
        """Names of the groups."""
        return self._core.groups

    @property
    def materials(self) -> list[str]:
        """Names of the materials; those of arrays are numbers."""
        return self._core.materials

    @property
    def up(self) -> str:
        """The axis that points to the sky."""
        return "xyz"[self._core.up]

    def patches(self) -> dict[str, np.ndarray]:
        """Return what is known of each patch.

        Returns
        -------
        dict of ndarray
            ``face``, ``group``, ``material`` : int64, shape (p,), indices from 0.
            ``back`` : bool, shape (p,), whether the patch is on the back of its face.
            ``area`` : float64, shape (p,) [m2].
            ``centre``, ``normal`` : float64, shape (p, 3) [m], [-].
            ``reflectance``, ``emission`` : float64, shape (p, 3) [-], [W/m2].
        """
        found = self._core.patches()
        found["back"] = found["back"].view(bool)
        return found


def read(path: Union[str, "os.PathLike[str]"], *,
         reflectance: Optional[Mapping[str, Any]] = None,
         emission: Optional[Mapping[str, Any]] = None, two_sided: Optional[bool] = None,
         max_edge: float = 0.0, up: Optional[str] = None) -> Mesh:
    """Read a scene from an OBJ, glTF or STL file.

    Parameters
    ----------
    path : str or path
        The file: .obj, .gltf, .glb or .stl.
    reflectance, emission : mapping of str to float or (3,) array_like, optional
        Colours by names of materials, in place of those of the file [-], [W/m2]. ``*`` in a name
        stands for any letters.
    two_sided : bool, optional
        Whether backs of faces count; by default those that the file says.
    max_edge : float, optional
        Faces are divided until no edge is longer [m].
    up : {'x', 'y', 'z'}, optional
        The axis that points to the sky; by default y for glTF and z for other files.

    Returns
    -------
    Mesh

    Raises
    ------
    ValueError
        Where the file cannot be read, with file, line and what was expected.

    Warns
    -----
    UserWarning
        For what is doubtful in the file.

    Notes
    -----
    No face is turned, as ``hemilux solve --sides front``.
    """
    def colours(of: Optional[Mapping[str, Any]]) -> Sequence[tuple[str, list[float]]]:
        return [(name, np.broadcast_to(numbers(name, value), (3,)).tolist())
                for name, value in (of or {}).items()]

    mesh = Mesh._of(_hemilux.read(os.fspath(path), colours(reflectance), colours(emission),
                                  two_sided, _edge(max_edge), None if up is None else axis(up)))
    for text in mesh._core.warnings:
        warn(text)
    return mesh
