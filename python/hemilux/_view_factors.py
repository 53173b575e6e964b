"""View factors between surfaces, each with its standard error."""

from __future__ import annotations

from typing import Any, Optional, Union

import numpy as np
import scipy.sparse

from . import _hemilux
from ._checks import Progress, axis, natural, places_with_normals, threads_and_seed, warn
from ._factors import OPEN, PointFactors, ViewFactors, shares_of_bands
from ._mesh import Mesh


def _error_reached(factors: ViewFactors, of: str, least: float) -> float:
    """Return the error that ``of`` means, as the program reports it."""
    matrix, errors = factors._factors, factors._errors
    if of == "sky":
        return max((float(np.max(np.where(factors._shares[k] > 0, factors._shares[k + "_standard_error"]
                                          / np.maximum(factors._shares[k], 0.01), 0), initial=0))
                    for k in OPEN[:2]))
    if of == "rows":
        return float(np.sqrt(np.max(np.asarray(errors.power(2).sum(axis=1)), initial=0)))
    if of == "largest":
        rows = np.flatnonzero(np.diff(matrix.indptr))
        largest = np.asarray(matrix.argmax(axis=1)).reshape(-1)[rows]
        return float(np.max(np.asarray(errors[rows, largest] / matrix[rows, largest]), initial=0))
    if of.startswith("pair:"):
        i, j = (factors.name.index(part) for part in of.removeprefix("pair:").split(",", 1))
        return float(errors[i, j] / matrix[i, j]) if matrix[i, j] > 0 else 0.0
    counts = matrix.data >= least
    relative = errors.data[counts] / matrix.data[counts]
    return float(np.sqrt(np.mean(relative**2))) if counts.any() else 0.0


def view_factors(mesh: Mesh, error: float = 0.01, *, of: str = "above:0.001", by: str = "face",
                 sky: bool = False, ground: bool = False,
                 sky_bands: Union[int, str, None] = None, rays: int = 1024,
                 time: Optional[float] = None, up: Optional[str] = None, points: Any = None,
                 threads: int = 0, seed: int = 1, progress: Progress = None) -> ViewFactors:
    """Compute the view factors between all surfaces, as ``hemilux viewfactors``.

    Parameters
    ----------
    mesh : Mesh
    error : float, optional
        Standard error that is aimed at, relative [-].
    of : str, optional
        What it is of. ``'above:F'``: root mean square of all factors of at least F. ``'rows'``: all
        factors of a row together, as a share of it. ``'largest'``: the largest factor of each row.
        ``'pair:A,B'``: the factor between two surfaces by their names. ``'sky'``: sky and ground of
        each surface alone, without factors between surfaces.
    by : {'face', 'group', 'material', 'patch'}, optional
        What a surface is: the front or the back of a face, all faces of a group or material,
        or a patch.
    sky, ground : bool, optional
        Whether they are columns of the matrix too.
    sky_bands : int or 'tregenza', optional
        Divide the sky into bands of equal altitude, 1 to 90 of them, or into the 145 patches of
        Tregenza. They are in ``.bands``, and columns of the matrix in place of the sky.
    rays : int, optional
        Rays of each patch that find who sees whom, a power of two from 256.
    time : float, optional
        Seconds after which the factors are as exact as they are then; ``audit["error"]`` has the
        error that was reached. A result that was cut short depends on the machine.
    up : {'x', 'y', 'z'}, optional
        The axis that points to the sky; by default that of the mesh.
    points : array_like of float, shape (p, 6), optional
        Points with normals x, y, z, nx, ny, nz that get rows of their own, in ``.points``.
    threads : int, optional
        Threads; 0: one per core. The result does not depend on it.
    seed : int, optional
        Of the random numbers. The same seed gives the same bytes.
    progress : callable, optional
        Is called as ``progress(phase, share)`` a few times a second.

    Returns
    -------
    ViewFactors
        ``audit`` has ``lacking_rms`` and ``lacking_worst``, by how much row sums missed 1 before they
        were closed [-]; ``chance_rms`` and ``chance_worst``, the same in units of what the errors let
        expect; ``worst_patch``; ``largest_move`` of a sampled factor in standard errors and
        ``largest_exact_move`` [-]; ``set_to_zero``, factors that closing made 0; ``reciprocity``, the
        largest ``|A_i F_ij / (A_j F_ji) - 1|``; ``error``, what was reached of the error asked for;
        ``rays``, ``lines``, and by which means pairs were found: ``exact_pairs``, ``line_pairs``,
        ``ray_pairs``, and ``clear_pairs``, which looked free without proof.

    Raises
    ------
    ValueError
        For an argument that is wrong.
    KeyboardInterrupt
        After Ctrl-C.

    Warns
    -----
    UserWarning
        Where the error is larger than asked for, where rows lacked more than chance explains, and
        for surfaces that see nothing but backs of faces.
    """
    number, chosen_seed = threads_and_seed(threads, seed)
    places = places_with_normals("points", points)
    found = _hemilux.view_factors(mesh._core, float(error), of, by, natural("rays", rays, 2**20),
                                  None if time is None else float(time),
                                  "" if sky_bands is None else str(sky_bands),
                                  mesh._core.up if up is None else axis(up), chosen_seed, number,
                                  places[:, :3], places[:, 3:], progress)
    n = len(found["area"])
    factors, errors = (scipy.sparse.csr_matrix((found[data], found["indices"], found["indptr"]),
                                               (n, n)) for data in ("data", "standard_error"))
    shares: dict[str, Optional[np.ndarray]] = {}
    for k, name in enumerate(OPEN):
        shares[name] = np.ascontiguousarray(found["open"][:, k])
        shares[name + "_standard_error"] = np.ascontiguousarray(found["open_standard_error"][:, k])
    bands = found["band_names"]
    shares.update(shares_of_bands(found, bands))
    columns = (tuple(bands) or ("sky",) * sky) + ("ground",) * ground
    result = ViewFactors(factors, errors, found["area"], found["name"], shares,
                         found["unlisted_bound"], found["audit"], columns)
    if points is not None:
        result.points = PointFactors(found["points"], n, bands)
    _warn_of(result, of, found["least"], error)
    return result


def _warn_of(factors: ViewFactors, of: str, least: float, error: float) -> None:
    audit = factors.audit
    audit["error"] = reached = _error_reached(factors, of, least)
    if reached > error:
        warn(f"the error is {reached:.2g}, where {error:g} was asked for; most of it is where little "
             "is seen past many edges", 2)
    if of != "sky" and audit["chance_rms"] > 1.5 and audit["lacking_rms"] > 1e-8:
        warn("the rows lacked more than chance explains; an opening that no ray found, or faces that "
             f"lie through each other, may be the cause: patch {audit['worst_patch']} lacked "
             f"{audit['lacking_worst']:.2g}", 2)
    turned = np.flatnonzero(factors._shares["back"] > 0.999)
    if len(turned):
        names = ", ".join(repr(factors.name[i]) for i in turned[:4])
        warn(f"{len(turned)} of the surfaces see nothing but backs of faces ({names}"
             f"{', ...' if len(turned) > 4 else ''}); such faces are probably turned", 2)
