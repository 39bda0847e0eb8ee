"""Tables as data frames."""

from typing import TYPE_CHECKING, Callable, Dict, Optional, Sequence

from ._error import Error
from ._native import table_columns

if TYPE_CHECKING:
    import pandas as _pandas


def tables(
    valences: Sequence[int] = tuple(range(3, 21)),
    progress: Optional[Callable[[str, int, int], object]] = None,
    *,
    knots: str = "detected",
) -> "Dict[str, _pandas.DataFrame]":
    """The tables of the lambda-scheme from nothing, as ``eigenring tables`` writes them: a dict of pandas data frames.

    Some seconds of work for each valence; ``progress(what, done, total)`` is called now and then. ``knots`` are the
    command's: ``"detected"``, ``"paper"``, ``"sharp"`` or ``"fine"``, of which the last takes as many coefficients as it
    needs (see :func:`lambda_table`).

    >>> import eigenring
    >>> found = eigenring.tables([4])
    >>> sorted(found)[-3:]
    ['table3_f3_at_featured', 'table5_f2_coefficients', 'table6_f3_coefficients']
    """
    try:
        import pandas
    except ImportError:
        raise Error("pandas is not installed: accepted is pip install eigenring[pandas]", "pip install eigenring[pandas]")
    found = table_columns(list(valences), progress, knots)
    return {name: pandas.DataFrame(columns) for name, columns in found.items()}
