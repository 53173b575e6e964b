from typing import Any, Optional, Sequence

import numpy as np

__version__: str

class Mesh:
    groups: list[str]
    materials: list[str]
    warnings: list[str]
    up: int
    faces: int
    def __len__(self) -> int: ...
    def patches(self) -> dict[str, np.ndarray]: ...

class RunNumbers:
    error: Optional[float]
    seconds: Optional[float]
    rays: Optional[float]
    steps: Optional[int]
    max_rays: Optional[int]
    depth: int
    threshold: float
    literal: bool
    keep_all: bool
    seed: int
    threads: int
    own: dict[str, str]

def mesh_of(vertices: np.ndarray, faces: np.ndarray, groups: list[str], group: np.ndarray,
            reflectance: np.ndarray, emission: np.ndarray, material: np.ndarray,
            two_sided: np.ndarray, max_edge: float, up: int) -> Mesh: ...
def read(path: str, reflectance: Sequence[tuple[str, list[float]]],
         emission: Sequence[tuple[str, list[float]]], two_sided: Optional[bool], max_edge: float,
         up: Optional[int]) -> Mesh: ...
def view_factors(mesh: Mesh, error: float, of: str, by: str, rays: int, seconds: Optional[float],
                 sky_bands: str, up: int, seed: int, threads: int, positions: np.ndarray,
                 normals: np.ndarray, progress: Any) -> dict[str, Any]: ...
def save_factors(path: str, indptr: np.ndarray, indices: np.ndarray, data: np.ndarray,
                 standard_error: np.ndarray, open: np.ndarray, open_standard_error: np.ndarray,
                 bands: np.ndarray, bands_standard_error: np.ndarray, sky_bands: str, sky: bool,
                 ground: bool) -> None: ...
def solve(mesh: Mesh, method: str, numbers: RunNumbers, reference: Optional[np.ndarray],
          progress: Any) -> dict[str, Any]: ...
def methods() -> list[tuple[str, str]]: ...
def compare(mesh: Mesh, methods: list[str], numbers: RunNumbers, runs: int,
            reference: Optional[np.ndarray], reference_error: float,
            progress: Any) -> tuple[dict[str, Any], list[dict[str, Any]], np.ndarray]: ...
def closest(mesh: Mesh, origins: np.ndarray, directions: np.ndarray,
            threads: int) -> tuple[np.ndarray, np.ndarray, np.ndarray, np.ndarray]: ...
def count(mesh: Mesh, origins: np.ndarray, directions: np.ndarray, threads: int) -> np.ndarray: ...
def density(mesh: Mesh, patch: int, depth: int, threshold: float) -> dict[str, Any]: ...
