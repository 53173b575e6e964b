"""Methods side by side, against a reference."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, Optional, Sequence

import numpy as np

from . import _hemilux
from ._checks import Progress, natural
from ._mesh import Mesh
from ._solve import _reference, _run_numbers


@dataclass(frozen=True, repr=False)
class Comparison:
    """Errors of methods by step.

    Attributes
    ----------
    rows : dict
        By step of each run: ``method`` (list of str), and arrays ``run``, ``step``, ``rays`` and
        ``seconds`` so far, ``estimated_error``, ``true_error`` [-].
    summary : list of dict
        By method, at the ends of its runs: means of ``rays`` and ``seconds``, geometric means of
        ``true_error`` and ``estimated_error`` [-], ``bytes_density`` and the number of ``runs``.
    reference : ndarray of float64, shape (p, 3)
        The radiosity that is taken for the truth [W/m2].
    """

    rows: dict[str, Any]
    summary: list[dict[str, Any]]
    reference: np.ndarray

    def __repr__(self) -> str:
        lines = [f"{row['method']}: error {row['true_error']:.3g} with {row['rays']:.3g} rays in "
                 f"{row['seconds']:.2g} s" for row in self.summary]
        return "<hemilux.Comparison: " + "; ".join(lines) + ">"

    def of(self, method: str, name: str, run: int = 0) -> np.ndarray:
        """Return a column of the rows for one run of a method."""
        chosen = np.array([of == method for of in self.rows["method"]], dtype=bool)
        return self.rows[name][chosen & (self.rows["run"] == run)]


def compare(mesh: Mesh, methods: Sequence[str], *, max_rays: Optional[int] = None,
            seconds: Optional[float] = None, runs: int = 3, rays: Optional[float] = None,
            reference: Any = None, reference_error: float = 0.002, depth: int = 2,
            threshold: float = 0.0, literal: bool = False, keep_all: bool = False, seed: int = 1,
            threads: int = 0, progress: Progress = None) -> Comparison:
    """Run methods side by side with one budget, as ``hemilux compare``.

    Parameters
    ----------
    mesh : Mesh
    methods : sequence of str
        Names of methods.
    max_rays : int, optional
        Budget of each run, density rays included; by default 64 steps' rays.
    seconds : float, optional
        Budget of each run in time instead [s].
    runs : int, optional
        Runs of each method; run r has the seed plus r.
    reference : Solution or array_like of float, shape (p, 3), optional
        The radiosity that is taken for the truth [W/m2]; by default ``matrix`` computes it.
    reference_error : float, optional
        Estimated error to which it is computed, relative [-].
    rays, depth, threshold, literal, keep_all, seed, threads, progress
        As of `solve`; ``literal`` is for methods that have printed rules.

    Returns
    -------
    Comparison
    """
    if isinstance(methods, str):
        raise ValueError("methods: expected a list of names")
    if max_rays is not None and seconds is not None:
        raise ValueError("max_rays and seconds: expected one of the two")
    numbers = _run_numbers(seconds=seconds, max_rays=max_rays, rays=rays,
                           depth=natural("depth", depth, 5), threshold=threshold, literal=literal,
                           keep_all=keep_all, seed=seed, threads=threads)
    if natural("runs", runs, 1000) == 0:
        raise ValueError("runs: expected at least 1")
    if not reference_error > 0:
        raise ValueError("reference_error: expected a number above 0")
    rows, summary, known = _hemilux.compare(mesh._core, list(methods), numbers, runs,
                                            _reference(reference, mesh), reference_error, progress)
    return Comparison(rows, summary, known)
