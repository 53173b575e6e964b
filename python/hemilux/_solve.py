"""Light: a solution of the radiosity equation B = E + rho F B."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, Optional

import numpy as np

from . import _hemilux
from ._checks import Progress, natural, rows_of_three, threads_and_seed, warn
from ._mesh import Mesh


@dataclass(frozen=True, repr=False)
class Solution:
    """The light of a scene, by patch, and what is known of its error.

    Attributes
    ----------
    method : str
        Name of the method.
    seed : int
        Of the random numbers.
    radiosity : ndarray of float64, shape (p, 3)
        Light that leaves each patch, its own emission included: red, green, blue [W/m2].
    standard_error : ndarray of float64, shape (p, 3)
        Of the radiosity [W/m2]; NaN before two steps.
    estimated_error : float
        Of the whole, relative root mean square [-]; NaN where it is not known.
    uncertainty : float
        Standard deviation of the estimated error itself [-].
    steps : dict of ndarray
        By step: ``step``, ``rays`` and ``seconds`` so far, ``estimated_error`` [-], and with a
        reference ``true_error`` [-].
    warnings : list of str
        What may be wrong with it: light that is lost on backs of faces, an error that was not
        reached or is not known. `solve` warns of each.
    left_out : list of tuple of str
        What the scene did not need and was not done: what, why, what it saved.
    energy : dict of ndarray, shape (3,)
        ``emitted``, ``absorbed``, ``escaped`` and ``unshot`` power [W].
    rays_energy, rays_density : int
        Rays that were traced.
    bytes_density : int
        Size of the density store; 0 where there is none.
    seconds : float
        Time of the run [s].
    """

    method: str
    seed: int
    radiosity: np.ndarray
    standard_error: np.ndarray
    estimated_error: float
    uncertainty: float
    steps: dict[str, np.ndarray]
    warnings: list[str]
    left_out: list[tuple[str, str, str]]
    energy: dict[str, np.ndarray]
    rays_energy: int
    rays_density: int
    bytes_density: int
    seconds: float

    def __repr__(self) -> str:
        return (f"<hemilux.Solution by {self.method}: {len(self.radiosity)} patches, "
                f"{len(self.steps['step'])} steps, estimated error {self.estimated_error:.2g}>")


def _set(numbers: Any, name: str, value: Any) -> None:
    """Set a number of the run; the core checks its range."""
    try:
        setattr(numbers, name, value)
    except TypeError:
        raise ValueError(f"{name}: {value!r} is not a number of the right kind") from None


def _run_numbers(**given: Any) -> Any:
    numbers = _hemilux.RunNumbers()
    numbers.threads, numbers.seed = threads_and_seed(given.pop("threads"), given.pop("seed"))
    numbers.own = {"--" + name.replace("_", "-"): {True: "yes", False: "no"}.get(value, str(value))
                   if isinstance(value, bool) else str(value)
                   for name, value in given.pop("own", {}).items()}
    for name, value in given.items():
        _set(numbers, name, value)
    return numbers


def _reference(reference: Any, mesh: Mesh) -> Optional[np.ndarray]:
    if reference is None:
        return None
    known = rows_of_three("reference", getattr(reference, "radiosity", reference))
    if len(known) != len(mesh):
        raise ValueError(f"reference: expected a row for each of {len(mesh)} patches, found "
                         f"{len(known)}")
    return known


def methods() -> dict[str, str]:
    """Return the methods of `solve` by name, each with a line about it."""
    return dict(_hemilux.methods())


def solve(mesh: Mesh, method: str = "stored-transport", error: Optional[float] = None, *,
          steps: Optional[int] = None, seconds: Optional[float] = None,
          max_rays: Optional[int] = None, rays: Optional[float] = None, depth: int = 2,
          threshold: float = 0.0, literal: bool = False, keep_all: bool = False, seed: int = 1,
          threads: int = 0, reference: Any = None, progress: Progress = None,
          **own: Any) -> Solution:
    """Solve for the light of all patches, as ``hemilux solve --sides front --divide none``.

    Parameters
    ----------
    mesh : Mesh
        Something in it must emit. No face is turned to the light.
    method : str, optional
        One of `methods`.
    error : float, optional
        The run ends once its estimated error is below this, relative [-].
    steps, seconds, max_rays : int, float, int, optional
        The run ends after so many steps, seconds, or rays. The first rule that is met ends it;
        without any, the method's own does.
    rays : float, optional
        Mean number of energy rays from a patch in a step; 64 by default.
    depth : int, optional
        Levels by which the hemisphere is divided, 0 to 5.
    threshold : float, optional
        A triangle whose density is higher is divided [surfaces per ray].
    literal : bool, optional
        The rules as the paper prints them, which are biased.
    keep_all : bool, optional
        Nothing is left out that the scene does not need.
    seed, threads : int, optional
        As of `view_factors`.
    reference : Solution or array_like of float, shape (p, 3), optional
        A known radiosity [W/m2], from which ``steps['true_error']`` follows.
    progress : callable, optional
        Is called as ``progress(phase, share)``; the share is that of the step.
    **own
        Options of the method as ``--help`` names them: ``factors='hemicube'`` for
        ``--factors hemicube``; True or False for those without a value.

    Returns
    -------
    Solution

    Raises
    ------
    ValueError
        For an argument that is wrong, and where no method can solve the scene.
    ArithmeticError
        Where light grows without bounds.
    KeyboardInterrupt
        After Ctrl-C; what was found is lost.

    Warns
    -----
    UserWarning
        For a lamp whose light falls on backs of faces or escapes, for an error that was not
        reached, and for one that is not known.
    """
    numbers = _run_numbers(error=error, steps=steps, seconds=seconds, max_rays=max_rays, rays=rays,
                           depth=natural("depth", depth, 5), threshold=threshold, literal=literal,
                           keep_all=keep_all, seed=seed, threads=threads, own=own)
    found = Solution(**_hemilux.solve(mesh._core, method, numbers, _reference(reference, mesh),
                                      progress))
    for text in found.warnings:
        warn(text)
    return found
