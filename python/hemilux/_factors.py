"""A matrix of view factors: sums over groups, and files."""

from __future__ import annotations

import os
from typing import Any, Optional, Union

import numpy as np
import scipy.sparse

from . import _hemilux
from ._checks import labels

OPEN = ("sky", "ground", "back")
_ERROR = "_standard_error"
_Path = Union[str, "os.PathLike[str]"]


def shares_of_bands(found: dict[str, Any], names: list[str]) -> dict[str, np.ndarray]:
    """Return the share of each band by its name, and its standard error with this at the end."""
    rows = len(found["open"])
    return {name + end: np.ascontiguousarray(found["bands" + end].reshape(rows, len(names))[:, k])
            for k, name in enumerate(names) for end in ("", _ERROR)}


def _bands(shares: dict[str, Any], end: str) -> dict[str, np.ndarray]:
    """Return the bands of the sky among shares, or their errors, by the names of the bands."""
    names = [key for key in shares if key.startswith("sky ") and not key.endswith(_ERROR)]
    return {name: shares[name + end] for name in names}


class PointFactors:
    """View factors from points with normals: the share of what a facet at each sends out.

    Rows sum to 1 with sky, ground and backs.

    Attributes
    ----------
    matrix : scipy.sparse.csr_matrix of float64, shape (p, n)
        View factors from each point to each surface [-].
    standard_error : scipy.sparse.csr_matrix of float64
        Of each factor [-], with the same entries; 0: the factor is exact.
    sky, ground, back : ndarray of float64, shape (p,)
        Shares that leave the scene upwards and downwards, and that meet backs of one-sided faces [-].
    sky_standard_error, ground_standard_error, back_standard_error : ndarray of float64, shape (p,)
        Their standard errors [-].
    bands, bands_standard_error : dict of str to ndarray of float64, shape (p,)
        The parts of the sky by their names, as `ViewFactors.bands`.
    unlisted_bound : ndarray of float64, shape (p,)
        The sum of the factors of a row that are not listed is below this in 95 of 100 rows [-].
    """

    def __init__(self, found: dict[str, Any], surfaces: int, bands: list[str]) -> None:
        self.unlisted_bound = found["unlisted_bound"]
        self.matrix, self.standard_error = (
            scipy.sparse.csr_matrix((found[data], found["indices"], found["indptr"]),
                                    (len(self), surfaces)) for data in ("data", "standard_error"))
        self.sky, self.ground, self.back = np.ascontiguousarray(found["open"].T)
        self.sky_standard_error, self.ground_standard_error, self.back_standard_error = \
            np.ascontiguousarray(found["open_standard_error"].T)
        shares = shares_of_bands(found, bands)
        self.bands, self.bands_standard_error = _bands(shares, ""), _bands(shares, _ERROR)

    def __len__(self) -> int:
        return len(self.unlisted_bound)

    def __repr__(self) -> str:
        return f"<hemilux.PointFactors of {len(self)} points, {self.matrix.nnz} factors>"


class ViewFactors:
    """A matrix of view factors: F[i, j] is the share of what surface i sends out that reaches j.

    Rows sum to 1 with sky, ground and backs, and area[i] F[i, j] = area[j] F[j, i].

    Attributes
    ----------
    matrix : scipy.sparse.csr_matrix of float64, shape (n, n)
        View factors [-]. With ``sky=True`` or ``ground=True`` a column of each follows, and a row
        without entries, so that the matrix stays square. ``sky_bands=`` has a column of each band.
    standard_error : scipy.sparse.csr_matrix of float64
        Of each factor [-], with the same entries; 0: the factor is exact.
    area : ndarray of float64, shape (n,)
        Of the surfaces [m2].
    name : list of str
        Of the surfaces: the number of the face, with `` back`` for its back, or the name of the
        group or material.
    sky, ground, back : ndarray of float64, shape (n,), or None
        Shares that leave the scene upwards and downwards, and that meet backs of one-sided faces
        [-]. None where a loaded file does not have them.
    sky_standard_error, ground_standard_error, back_standard_error : ndarray of float64, or None
        Their standard errors [-]. Where no ray went one way, half of what is possible in 95 % of all
        cases.
    bands, bands_standard_error : dict of str to ndarray of float64, shape (n,)
        The parts of the sky by their names, ``sky 0-30`` or ``sky 17``, and their standard errors
        [-]. They sum to ``sky``. Empty without ``sky_bands=``.
    unlisted_bound : ndarray of float64, shape (n,), or None
        The sum of the factors of a row that are not listed is below this in 95 of 100 rows [-].
    audit : dict of str to float
        How well the factors agreed before rows were closed; `view_factors` explains its keys.
    points : PointFactors or None
        The rows of points, where ``points=`` has some. Files and sums over groups leave them out.
    """

    points: Optional[PointFactors] = None

    def __init__(self, factors: scipy.sparse.csr_matrix, errors: scipy.sparse.csr_matrix,
                 area: np.ndarray, name: list[str], shares: dict[str, Optional[np.ndarray]],
                 unlisted_bound: Optional[np.ndarray], audit: dict[str, Any],
                 columns: tuple[str, ...] = ()) -> None:
        self._factors, self._errors, self._columns = factors, errors, columns
        self.area, self.name, self.unlisted_bound, self.audit = area, name, unlisted_bound, audit
        self._shares = shares
        self.sky, self.sky_standard_error = shares["sky"], shares["sky_standard_error"]
        self.ground, self.ground_standard_error = shares["ground"], shares["ground_standard_error"]
        self.back, self.back_standard_error = shares["back"], shares["back_standard_error"]
        self.bands, self.bands_standard_error = _bands(shares, ""), _bands(shares, _ERROR)
        self.matrix = _with_columns(factors, [shares[c] for c in columns])
        self.standard_error = errors if not columns else _with_columns(
            errors, [shares[c + "_standard_error"] for c in columns], self.matrix)

    def __len__(self) -> int:
        return len(self.area)

    def __repr__(self) -> str:
        return f"<hemilux.ViewFactors between {len(self)} surfaces, {self.matrix.nnz} factors>"

    def by(self, ids: Any) -> "ViewFactors":
        """Sum the factors over groups of surfaces.

        Parameters
        ----------
        ids : array_like of str or int, shape (n,)
            The group of each surface.

        Returns
        -------
        ViewFactors
            Between the groups, in the order in which they first appear. Errors of different pairs are
            taken as independent, as those of the program's ``--by group``.
        """
        names, index = labels("ids", ids, len(self))
        n, m = len(self), len(names)
        sums = scipy.sparse.csr_matrix((np.ones(n), (index, np.arange(n))), shape=(m, n))
        area = np.bincount(index, self.area, m)
        scale = scipy.sparse.diags(1 / area)
        weight = scipy.sparse.diags(self.area)
        variance = (weight @ self._errors).power(2)
        # Within a group each pair is there from both sides, with one error.
        inside = variance - scipy.sparse.diags(variance.diagonal())
        twice = (sums @ inside @ sums.T).diagonal()
        variance = sums @ variance @ sums.T + scipy.sparse.diags(twice)
        factors = (scale @ (sums @ (weight @ self._factors) @ sums.T)).tocsr()
        factors.sort_indices()
        errors = _on_entries_of(factors, scale @ variance.sqrt())
        share = self.area / area[index]
        shares: dict[str, Optional[np.ndarray]] = {}
        for key, values in self._shares.items():
            if values is None:
                shares[key] = None
            elif key.endswith("_standard_error"):
                shares[key] = np.sqrt(np.bincount(index, (share * values) ** 2, m))
            else:
                shares[key] = np.bincount(index, share * values, m)
        bound = None if self.unlisted_bound is None \
            else np.bincount(index, share * self.unlisted_bound, m)
        return ViewFactors(factors, errors, area, names, shares, bound, self.audit, self._columns)

    def save(self, path: _Path) -> None:
        """Write the factors.

        Parameters
        ----------
        path : str or path
            ``.npz``: all of this, as `load` reads it; ``scipy.sparse.load_npz`` reads the matrix.
            ``.csv``: ``i,j,F,standard_error``. ``.npy``: a dense matrix. ``vfsparse.inp...`` and
            ``svf.inp...``: the files of uDALES.

        Raises
        ------
        ValueError
            For another kind of file.
        OSError
            Where the file cannot be written.
        """
        path = os.fspath(path)
        if not path.lower().endswith(".npz"):
            self._save_by_program(path)
            return
        matrix = self.matrix
        arrays = {"indices": matrix.indices, "indptr": matrix.indptr, "format": np.array(b"csr"),
                  "shape": np.array(matrix.shape), "data": matrix.data,
                  "standard_error": self.standard_error.data, "area": self.area,
                  "name": np.char.encode(np.array(self.name + list(self._columns)), "utf-8")}
        arrays.update({key: values for key, values in self._shares.items() if values is not None})
        if self.unlisted_bound is not None:
            arrays["unlisted_bound"] = self.unlisted_bound
        arrays.update({"audit_" + key: np.array(value) for key, value in self.audit.items()})
        unfinished = f"{path}.{os.getpid()}.part"
        try:
            with open(unfinished, "wb") as file:
                np.savez(file, **arrays)
            os.replace(unfinished, path)
        except BaseException:
            if os.path.exists(unfinished):
                os.unlink(unfinished)
            raise

    def _save_by_program(self, path: str) -> None:
        n = len(self)
        shares, errors = (np.stack([_or_zeros(self._shares.get(key + end), n) for key in OPEN], 1)
                          for end in ("", "_standard_error"))
        factors = self._factors
        bands, band_errors = (np.stack(list(parts.values()), 1) if parts else np.empty((n, 0))
                              for parts in (self.bands, self.bands_standard_error))
        division = "tregenza" if "sky 1" in self.bands else str(len(self.bands) or "")
        _hemilux.save_factors(path, factors.indptr, factors.indices, factors.data,
                              self._errors.data, shares, errors, bands, band_errors, division,
                              bool(self.bands) or "sky" in self._columns, "ground" in self._columns)

    @staticmethod
    def load(path: _Path) -> "ViewFactors":
        """Read what `save` or ``hemilux viewfactors -o factors.npz`` wrote.

        Rows of points are left out; ``scipy.sparse.load_npz`` reads these.

        Parameters
        ----------
        path : str or path

        Returns
        -------
        ViewFactors
        """
        with np.load(os.fspath(path)) as file:
            size = len(file["area"])
            name = [text.decode("utf-8") for text in file["name"].tolist()]
            shape = tuple(file["shape"].tolist())
            place = {key: size + k for k, key in enumerate(name[size:shape[1]])}
            columns = tuple(place)
            bands = [key for key in place if key not in OPEN]
            matrix, errors = (scipy.sparse.csr_matrix((file[data], file["indices"], file["indptr"]),
                                                      shape) for data in ("data", "standard_error"))
            shares: dict[str, Optional[np.ndarray]] = {}
            for key in [*OPEN, *bands]:
                for end, source in (("", matrix), ("_standard_error", errors)):
                    shares[key + end] = file[key + end] if key + end in file else None
                    if shares[key + end] is None and key in columns:
                        shares[key + end] = source[:size, place[key]].toarray().reshape(-1)
            if bands and shares["sky"] is None:
                shares["sky"] = np.sum([shares[key] for key in bands], axis=0)
            bound = file["unlisted_bound"] if "unlisted_bound" in file else None
            audit = {key.removeprefix("audit_"): file[key].item()
                     for key in file.files if key.startswith("audit_")}
            return ViewFactors(matrix[:size, :size], errors[:size, :size], file["area"],
                               name[:size], shares, bound, audit, columns)


def _or_zeros(values: Optional[np.ndarray], size: int) -> np.ndarray:
    return np.zeros(size) if values is None else values


def _on_entries_of(pattern: scipy.sparse.csr_matrix, values: Any) -> scipy.sparse.csr_matrix:
    """Return the values at the entries of the pattern, zeros among them."""
    if pattern.nnz == 0:
        return pattern.copy()
    rows = np.repeat(np.arange(pattern.shape[0]), np.diff(pattern.indptr))
    data = np.asarray(values.tocsr()[rows, pattern.indices]).reshape(-1)
    return scipy.sparse.csr_matrix((data, pattern.indices, pattern.indptr), pattern.shape)


def _with_columns(matrix: scipy.sparse.csr_matrix, columns: list[Any],
                  pattern: Optional[scipy.sparse.csr_matrix] = None) -> scipy.sparse.csr_matrix:
    """Append columns, and rows without entries. With a pattern the entries are those of it."""
    if not columns:
        return matrix
    wide = scipy.sparse.hstack([matrix, scipy.sparse.csr_matrix(np.stack(columns, 1))], "csr")
    wide.resize(wide.shape[1], wide.shape[1])
    return wide if pattern is None else _on_entries_of(pattern, wide)
