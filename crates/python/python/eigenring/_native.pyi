from os import PathLike
from typing import Any, Callable, Dict, List, Mapping, Optional, Protocol, Sequence, Tuple, Union, final, overload

import numpy as np
from numpy.typing import NDArray

__version__: str

_Progress = Callable[[str, int, int], object]
_Floats = NDArray[np.float64]
_Integers = NDArray[np.int64]

@final
class Corner:
    @staticmethod
    def closed(valence: int) -> Corner: ...
    @staticmethod
    def fan(faces: int, corner: bool = False) -> Corner: ...
    @staticmethod
    def dart(valence: int) -> Corner: ...
    @staticmethod
    def cusp(valence: int) -> Corner: ...

@final
class Scheme:
    def __new__(cls, spec: Union[str, PathLike[str]]) -> Scheme: ...
    @staticmethod
    def from_stencils(
        rule: Dict[str, Any],
        *,
        name: str = "stencils",
        kind: str = "one-ring",
        valences: str = "3..",
        parameters: Optional[Dict[str, Any]] = None,
    ) -> Scheme: ...
    @staticmethod
    def from_matrix(array: Union[_Floats, Sequence[Sequence[float]]]) -> Scheme: ...
    def set(self, **parameters: Union[int, float, str]) -> Scheme: ...
    def at(
        self,
        valence: Union[int, np.integer[Any], Corner, None] = None,
        knots: Optional[Sequence[float]] = None,
        *,
        next: Optional[Sequence[float]] = None,
        cs: Optional[int] = None,
    ) -> At: ...
    @property
    def spec(self) -> str: ...

@final
class At:
    def matrix(self, rings: Optional[int] = None, *, level: Optional[int] = None) -> _Floats: ...
    def points(self, rings: Optional[int] = None) -> List[Dict[str, int]]: ...
    def blocks(self, rings: Optional[int] = None, *, level: Optional[int] = None) -> List[NDArray[Any]]: ...
    def spectrum(self, rings: Optional[int] = None, *, level: Optional[int] = None) -> Spectrum: ...
    def eigenvectors(self, rings: Optional[int] = None, *, level: Optional[int] = None) -> Eigenvectors: ...
    def limit_stencils(self, rings: Optional[int] = None) -> LimitStencils: ...
    def natural_configuration(self, rings: Optional[int] = None) -> NaturalConfiguration: ...
    def characteristic_map(self) -> CharacteristicMap: ...
    def second_order_maps(self) -> SecondOrderMaps: ...
    def verify(
        self, require: str = "c1", *, exact: bool = False, progress: Optional[_Progress] = None
    ) -> Certificate: ...
    @property
    def valence(self) -> Optional[int]: ...

@final
class Spectrum:
    def __len__(self) -> int: ...
    @property
    def eigenvalues(self) -> NDArray[np.complex128]: ...
    @property
    def fourier(self) -> _Integers: ...
    @property
    def multiplicities(self) -> _Integers: ...
    @property
    def geometric(self) -> _Integers: ...
    @property
    def jordan(self) -> List[Optional[str]]: ...
    @property
    def subdominant(self) -> Optional[float]: ...
    @property
    def subsubdominant(self) -> Optional[float]: ...
    @property
    def s(self) -> Optional[float]: ...
    @property
    def valence(self) -> Optional[int]: ...
    @property
    def points(self) -> int: ...
    @property
    def notes(self) -> List[str]: ...
    def json(self) -> Dict[str, Any]: ...

@final
class Eigenvectors:
    @property
    def eigenvalues(self) -> NDArray[np.complex128]: ...
    @property
    def fourier(self) -> _Integers: ...
    @property
    def right(self) -> NDArray[Any]: ...
    @property
    def left(self) -> NDArray[Any]: ...
    @property
    def chains(self) -> List[List[int]]: ...
    def json(self) -> Dict[str, Any]: ...

@final
class LimitStencils:
    @property
    def position(self) -> Optional[_Floats]: ...
    @property
    def tangent_x(self) -> Optional[_Floats]: ...
    @property
    def tangent_y(self) -> Optional[_Floats]: ...
    @property
    def missing(self) -> List[str]: ...

@final
class NaturalConfiguration:
    @property
    def value(self) -> float: ...
    @property
    def points(self) -> _Floats: ...

@final
class Sample:
    @staticmethod
    def _of(points: _Floats, jacobians: _Floats, sectors: _Integers) -> Sample: ...
    @property
    def points(self) -> _Floats: ...
    @property
    def jacobians(self) -> _Floats: ...
    @property
    def sectors(self) -> _Integers: ...

@final
class CharacteristicMap:
    @property
    def degree(self) -> int: ...
    @property
    def patches(self) -> int: ...
    def sample(self, n: int) -> Sample: ...

@final
class SecondOrderMaps:
    @property
    def value(self) -> float: ...
    @property
    def mu(self) -> _Floats: ...
    def sample(self, n: int) -> Dict[str, _Floats]: ...

@final
class Certificate:
    @property
    def holds(self) -> bool: ...
    @property
    def status(self) -> str: ...
    @property
    def require(self) -> str: ...
    @property
    def valence(self) -> Optional[int]: ...
    @property
    def checks(self) -> List[Dict[str, Any]]: ...
    def json(self) -> Dict[str, Any]: ...
    def to_json(self) -> str: ...
    @staticmethod
    def from_json(text: str, *, require: str = "c1") -> Certificate: ...
    def recheck(self, *, progress: Optional[_Progress] = None) -> str: ...

_SchemeLike = Union[Scheme, str, PathLike[str]]
_Numbers = Union[float, _Floats, Sequence[float]]

@final
class LimitPoints:
    @staticmethod
    def _of(
        points: _Floats,
        first: _Floats,
        second: _Floats,
        normals: _Floats,
        gauss: _Floats,
        mean: _Floats,
        principal: _Floats,
        kinds: bytes,
    ) -> LimitPoints: ...
    @property
    def points(self) -> _Floats: ...
    @property
    def first(self) -> _Floats: ...
    @property
    def second(self) -> _Floats: ...
    @property
    def normals(self) -> _Floats: ...
    @property
    def gauss(self) -> _Floats: ...
    @property
    def mean(self) -> _Floats: ...
    @property
    def principal(self) -> _Floats: ...
    @property
    def kinds(self) -> List[str]: ...

class _HasFaces(Protocol):
    """As trimesh has it."""

    @property
    def vertices(self) -> Any: ...
    @property
    def faces(self) -> Any: ...

class _HasCells(Protocol):
    """As meshio has it."""

    points: Any
    cells: Any

@final
class Mesh:
    @overload
    def __new__(
        cls,
        vertices: Union[Mesh, _HasFaces, _HasCells],
        faces: None = None,
        *,
        creases: Optional[Mapping[Tuple[int, int], float]] = None,
        corners: Optional[Mapping[int, float]] = None,
        boundary: Optional[str] = None,
    ) -> Mesh: ...
    @overload
    def __new__(
        cls,
        vertices: Union[_Floats, Sequence[Sequence[float]]],
        faces: Union[NDArray[np.integer[Any]], Sequence[Sequence[int]]],
        *,
        creases: Optional[Mapping[Tuple[int, int], float]] = None,
        corners: Optional[Mapping[int, float]] = None,
        boundary: Optional[str] = None,
    ) -> Mesh: ...
    @staticmethod
    def read(path: Union[str, PathLike[str]]) -> Mesh: ...
    def write(self, path: Union[str, PathLike[str]]) -> None: ...
    @staticmethod
    def _of_obj(text: bytes, levels: int) -> Mesh: ...
    @property
    def vertices(self) -> _Floats: ...
    @property
    def faces(self) -> Any: ...
    def subdivide(self, scheme: _SchemeLike, levels: int = 1, *, progress: Optional[_Progress] = None) -> Mesh: ...
    def limit(
        self,
        scheme: _SchemeLike,
        face: Union[int, Sequence[int], NDArray[np.integer[Any]]],
        u: _Numbers,
        v: _Numbers,
        *,
        sub: Union[int, Sequence[int], NDArray[np.integer[Any]], None] = None,
        progress: Optional[_Progress] = None,
    ) -> LimitPoints: ...
    def limit_mesh(self, scheme: _SchemeLike, n: int = 8, *, progress: Optional[_Progress] = None) -> Mesh: ...
    def curvature(
        self,
        scheme: _SchemeLike,
        *,
        per_face: int = 8,
        radii: Sequence[float] = ...,
        progress: Optional[_Progress] = None,
    ) -> Dict[str, Any]: ...
    def solve(
        self,
        scheme: _SchemeLike,
        problem: str = "poisson",
        *,
        solution: str = "exp",
        levels: int = 4,
        bc: Optional[str] = None,
        boundary: str = "open",
        dirichlet: Optional[str] = None,
        gauss: int = 4,
        depth: Optional[int] = None,
        tail: str = "drop",
        solver: Optional[str] = None,
        sphere: bool = False,
        count: Optional[int] = None,
        progress: Optional[_Progress] = None,
    ) -> Dict[str, Any]: ...
    def render(
        self,
        scheme: _SchemeLike,
        show: str = "shaded",
        *,
        view: Tuple[float, float, float] = ...,
        light: Tuple[float, float] = ...,
        stripes: float = 6.0,
        size: int = 480,
        up: str = "z",
        progress: Optional[_Progress] = None,
    ) -> Picture: ...

@final
class Figure:
    @property
    def name(self) -> str: ...
    def svg(self) -> str: ...
    def png(self, dpi: float = 300.0) -> bytes: ...
    def data(self) -> Dict[str, Dict[str, List[Any]]]: ...
    def _repr_svg_(self) -> str: ...

@final
class Picture:
    def png(self) -> bytes: ...
    def _repr_png_(self) -> bytes: ...

@final
class Tuned:
    def json(self) -> Dict[str, Any]: ...
    @property
    def text(self) -> str: ...
    @property
    def certificates(self) -> List[Certificate]: ...

def figure(
    name: str,
    *,
    schemes: Optional[Sequence[_SchemeLike]] = None,
    valences: Optional[Sequence[int]] = None,
    lambdas: Optional[Sequence[float]] = None,
    progress: Optional[_Progress] = None,
) -> List[Figure]: ...
def tune(
    scheme: _SchemeLike,
    valence: Union[int, Sequence[int]],
    minimise: Union[str, Callable[[At], float], None] = None,
    *,
    lambda_: Optional[float] = None,
    subject_to: Sequence[str] = ...,
    fix: Optional[Mapping[str, Union[int, float, str]]] = None,
    margin: Optional[float] = None,
    seed: int = 0,
    descents: int = 6,
    name: str = "tuned",
    progress: Optional[_Progress] = None,
) -> Tuned: ...
def lambda_table(valence: int, *, splines: str = "paper") -> Dict[str, Any]: ...
def table_columns(
    valences: Sequence[int], progress: Optional[_Progress] = None, knots: str = "detected"
) -> Dict[str, Dict[str, List[Any]]]: ...
