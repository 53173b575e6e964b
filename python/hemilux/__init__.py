"""Diffuse light and view factors of scenes of polygons, each with its error.

The functions compute what the program ``hemilux`` computes, and give the same numbers for the same
seed, whatever the number of threads. Lengths are in one unit of your choice, here called metres.

>>> import hemilux
>>> mesh = hemilux.read("room.obj")                           # doctest: +SKIP
>>> hemilux.view_factors(mesh, by="group").matrix.toarray()   # doctest: +SKIP
"""

from ._compare import Comparison, compare
from ._density import Density, density
from ._factors import PointFactors, ViewFactors
from ._hemilux import __version__
from ._lighting import Lamp, Lightmap, Picture, PointLight
from ._mesh import Mesh, read
from ._rays import Hits, Rays, rays
from ._solve import Solution, methods, solve
from ._sunlit import Sunlit, sunlit
from ._view_factors import view_factors

__all__ = [
    "Comparison",
    "Density",
    "Hits",
    "Lamp",
    "Lightmap",
    "Mesh",
    "Picture",
    "PointFactors",
    "PointLight",
    "Rays",
    "Solution",
    "Sunlit",
    "ViewFactors",
    "__version__",
    "compare",
    "density",
    "methods",
    "rays",
    "read",
    "solve",
    "sunlit",
    "view_factors",
]
