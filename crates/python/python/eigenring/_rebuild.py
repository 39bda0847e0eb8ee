"""What pickles are made of: objects from plain data, by the names under which :mod:`pickle` finds them again."""

from typing import Any, List, Mapping, Optional

from ._native import At, Certificate, Corner, LimitPoints, Mesh, Sample, Scheme


def scheme(text: str, values: Mapping[str, str]) -> Scheme:
    """By name, or from the text of its file, with values of parameters."""
    found = Scheme(text)
    return found.set(**values) if values else found


def matrix(array: Any) -> Scheme:
    """From its matrix."""
    return Scheme.from_matrix(array)


def corner(kind: str, sectors: int, fixed: bool = False) -> Corner:
    """By the name of the function that makes it."""
    if kind == "fan":
        return Corner.fan(sectors, fixed)
    made: Corner = getattr(Corner, kind)(sectors)
    return made


def at(given: Scheme, place: Optional[Corner], knots: Optional[List[float]], next: Optional[List[float]], cs: Optional[int]) -> At:
    """A scheme at a corner, or at knots."""
    return given.at(place, knots, next=next, cs=cs)


def at_matrix(given: Scheme, valence: Optional[int]) -> At:
    """A matrix, with the rotation that was found."""
    return given.at(valence)


def mesh(text: bytes, levels: int) -> Mesh:
    """From a file of OBJ with its marks."""
    return Mesh._of_obj(text, levels)


def certificate(text: str, require: str) -> Certificate:
    """From its stored form."""
    return Certificate.from_json(text, require=require)


def limit_points(*columns: Any) -> LimitPoints:
    """From arrays."""
    return LimitPoints._of(*columns)


def sample(*arrays: Any) -> Sample:
    """From arrays."""
    return Sample._of(*arrays)
