"""Eigenstructure, proofs and tuning of subdivision schemes for surfaces.

A scheme is looked at around a vertex or face of a valence N. There refinement is a matrix, and its eigenvalues and
eigenvectors say what the limit surface is like: whether it is C1, whether its curvature is bounded.

>>> import eigenring
>>> at = eigenring.Scheme("catmull-clark").at(5)
>>> round(at.spectrum().subdominant, 6)
0.549988
>>> at.verify(require="c1").status
'proven'

Indices count from 0. Arrays are numpy's; what is given must be finite, C-contiguous and of the stated type. Whatever
is refused raises :class:`Error`. Numbers are those that the command ``eigenring`` prints with ``--format json``.
"""

from ._error import Error
from ._native import (
    At,
    Certificate,
    CharacteristicMap,
    Corner,
    Eigenvectors,
    Figure,
    LimitPoints,
    LimitStencils,
    Mesh,
    NaturalConfiguration,
    Picture,
    Sample,
    Scheme,
    SecondOrderMaps,
    Spectrum,
    Tuned,
    __version__,
    figure,
    lambda_table,
    tune,
)
from ._sweep import sweep
from ._tables import tables

__all__ = [
    "At",
    "Certificate",
    "CharacteristicMap",
    "Corner",
    "Eigenvectors",
    "Error",
    "Figure",
    "LimitPoints",
    "LimitStencils",
    "Mesh",
    "NaturalConfiguration",
    "Picture",
    "Sample",
    "Scheme",
    "SecondOrderMaps",
    "Spectrum",
    "Tuned",
    "__version__",
    "figure",
    "lambda_table",
    "sweep",
    "tables",
    "tune",
]
