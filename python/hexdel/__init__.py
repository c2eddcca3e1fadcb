"""Triangle meshes with every angle between 43.89 and 90 degrees, certified.

>>> import hexdel
>>> mesh = hexdel.mesh([(0.0, 0.0), (1.0, 0.2), (0.3, 0.7)])
>>> mesh.holds
True

`mesh` takes points, `mesh_pslg` points and segments, `mesh_polygons` shapely geometries,
GeoDataFrames and GeoJSON; `triangulate` has the call of the package `triangle`. A `Mesh`
holds numpy arrays and goes on to matplotlib, meshio, pyvista, scikit-fem, xugrid, flopy,
MPAS, shapely and geopandas.
"""

from importlib.metadata import PackageNotFoundError, version

from ._calls import check, generate, mesh, mesh_pslg
from ._certificate import Certificate
from ._dual import Dual
from ._errors import (
    FileError,
    HexdelError,
    HexdelWarning,
    InputError,
    InternalError,
    MissingFileError,
    MissingPackageError,
    OptionError,
    SessionError,
    UnreachedError,
)
from ._files import Graph, read, write
from ._mesh import Mesh, Quality
from ._polygons import mesh_polygons
from ._session import Change, Session
from ._size import Raster, SizeAt, SizeIn
from ._triangle import compare, plot, triangulate

try:
    __version__ = version("hexdel")
except PackageNotFoundError:  # used in place, not installed
    __version__ = "0"

__all__ = [
    "Certificate",
    "Change",
    "Dual",
    "FileError",
    "Graph",
    "HexdelError",
    "HexdelWarning",
    "InputError",
    "InternalError",
    "Mesh",
    "MissingFileError",
    "MissingPackageError",
    "OptionError",
    "Quality",
    "Raster",
    "Session",
    "SessionError",
    "SizeAt",
    "SizeIn",
    "UnreachedError",
    "check",
    "compare",
    "generate",
    "mesh",
    "mesh_polygons",
    "mesh_pslg",
    "plot",
    "read",
    "triangulate",
    "write",
]
