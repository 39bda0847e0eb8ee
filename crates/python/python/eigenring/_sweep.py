"""Studies of many schemes, valences and parameters, on threads or on a cluster."""

import math
import os
from concurrent.futures import ThreadPoolExecutor, as_completed
from os import PathLike
from operator import index
from typing import Any, Callable, Dict, Generator, Iterable, List, Mapping, NamedTuple, Optional, Tuple, Union

from ._error import Error
from ._native import At, Certificate, Scheme

Parameter = Union[int, float, str]
Values = Union[None, float, Mapping[str, Parameter]]
Rows = Generator[Tuple[int, Dict[str, Any]], None, None]
Task = Union[Tuple[Union[str, "PathLike[str]"], int], Tuple[Union[str, "PathLike[str]"], int, Values]]

_ACCEPTED = "tuples (scheme, valence) or (scheme, valence, lambda)"


class _Plain(NamedTuple):
    """A task that any computer understands: no open files, no paths, nothing that is compiled."""

    scheme: str
    valence: int
    values: Tuple[Tuple[str, Parameter], ...]


def _shown(given: Any) -> str:
    """A value in a message of one line."""
    text = " ".join(repr(given).split())
    return text if len(text) <= 60 else text[:60] + ".."


def _plain(task: Any) -> _Plain:
    try:
        scheme, valence, *rest = task
    except (TypeError, ValueError):
        raise Error(f"a task is {_shown(task)}: accepted are {_ACCEPTED}", _ACCEPTED) from None
    if len(rest) > 1 or isinstance(task, str):
        raise Error(f"a task is {_shown(task)}: accepted are {_ACCEPTED}", _ACCEPTED)
    if not isinstance(scheme, (str, PathLike)):
        accepted = "the name of a scheme, the path of a scheme file, or its text"
        raise Error(f"the scheme of a task is {_shown(scheme)}: accepted is {accepted}", accepted)
    text = os.fspath(scheme)
    if isinstance(valence, bool) or not hasattr(valence, "__index__"):
        raise Error(f"the valence of a task is {_shown(valence)}: accepted are whole numbers", "whole numbers")
    if "\n" not in text and text.endswith(".toml") and not text.startswith("file:"):
        # workers need not have the file
        try:
            with open(text, encoding="utf-8") as file:
                text = file.read()
        except (OSError, UnicodeDecodeError) as error:
            raise Error(f"{text}: {error}: accepted is a readable scheme file", "a readable scheme file") from None
    return _Plain(text, index(valence), _values(rest[0] if rest else None))


def _values(given: Values) -> Tuple[Tuple[str, Parameter], ...]:
    if given is None:
        return ()
    if not isinstance(given, Mapping):
        given = {"lambda": given}
    return tuple((str(name), _number(name, value)) for name, value in given.items())


def _number(name: str, value: Any) -> Parameter:
    """The value as one of Python's own, whatever library it comes from."""
    if isinstance(value, str):
        return value
    if hasattr(value, "__index__"):
        return index(value)
    try:
        number = float(value)
    except (TypeError, ValueError):
        number = math.nan
    if not math.isfinite(number):
        raise Error(f"{name} is {_shown(value)}: accepted are finite numbers", "finite numbers")
    return number


def _at(task: _Plain) -> At:
    """The task's scheme at its valence, made where it is looked at."""
    if "\n" not in task.scheme and not task.scheme.startswith("file:") and task.values:
        separator = "," if ":" in task.scheme else ":"
        settings = ",".join(f"{name}={value}" for name, value in task.values)
        return Scheme(task.scheme + separator + settings).at(task.valence)
    scheme = Scheme(task.scheme)
    return (scheme.set(**dict(task.values)) if task.values else scheme).at(task.valence)


def verdict(at: At) -> Dict[str, Any]:
    """The study of :func:`sweep` without another: eigenvalues, and what is proven."""
    spectrum = at.spectrum()
    certificate = at.verify("c1")
    bounded = Certificate.from_json(certificate.to_json(), require="bounded")
    return {
        "subdominant": spectrum.subdominant,
        "subsubdominant": spectrum.subsubdominant,
        "s": spectrum.s,
        "c1": certificate.status,
        "bounded": bounded.status,
    }


def _run(task: _Plain, study: Callable[[At], Mapping[str, Any]]) -> Dict[str, Any]:
    """One row. What is refused is said in the row, so that one task does not end the others."""
    try:
        return {**study(_at(task)), "error": None}
    except Error as error:
        return {"error": str(error)}


def _on_threads(
    tasks: List[_Plain], study: Callable[[At], Mapping[str, Any]]
) -> Rows:
    pool = ThreadPoolExecutor(os.cpu_count())
    futures = {pool.submit(_run, task, study): place for place, task in enumerate(tasks)}
    try:
        for future in as_completed(futures):
            yield futures[future], future.result()
    finally:
        # nobody waits for those that are under way when the caller has had enough
        pool.shutdown(wait=False, cancel_futures=True)


def _on_cluster(
    client: Any, tasks: List[_Plain], study: Callable[[At], Mapping[str, Any]]
) -> Rows:
    from distributed import KilledWorker
    from distributed import as_completed as finished

    if getattr(client, "asynchronous", False):
        raise Error("the client is asynchronous: accepted is Client(.., asynchronous=False)", "Client(..)")
    # each task is its own, though it may equal another; the scheduler runs again what a lost worker had
    futures = client.map(_run, tasks, [study] * len(tasks), pure=False)
    places = {future.key: place for place, future in enumerate(futures)}
    try:
        for future in finished(futures):
            try:
                row = future.result()
            except KilledWorker as error:
                row = {"error": f"every worker that ran this task was lost: {error.last_worker.address}"}
            yield places[future.key], row
            future.release()
    finally:
        client.cancel(futures)


def sweep(
    tasks: Iterable[Task],
    client: Any = None,
    *,
    study: Callable[[At], Mapping[str, Any]] = verdict,
    progress: Optional[Callable[[str, int, int], object]] = None,
) -> List[Dict[str, Any]]:
    """Studies of (scheme, valence, lambda), a dict for each task, in the order of the tasks.

    A task is a tuple of a scheme (a name, the path of a scheme file, or its text), a valence and, where the scheme
    has them, parameters: a number is lambda, a dict has others by name. ``client`` is any ``dask.distributed.Client``;
    without one the tasks run on the threads of this computer. Rows do not depend on where and in which order they were
    found. The tasks of a worker that is lost are run again elsewhere.

    Rows hold the task (``scheme``, ``valence``, ``parameters``) and what ``study(at)`` returns, a dict; without one:
    ``subdominant``, ``subsubdominant``, ``s`` as in :class:`Spectrum`, and what :meth:`At.verify` says, ``c1`` and
    ``bounded``. What is refused leaves an ``error`` in its row, which is None in others, and None elsewhere.

    >>> import eigenring
    >>> rows = eigenring.sweep([("catmull-clark", 5), ("lambda", 5, 0.5), ("lambda", 5, 9.0)])
    >>> [(row["c1"], round(row["subdominant"], 6)) for row in rows[:2]]
    [('proven', 0.549988), ('proven', 0.5)]
    >>> rows[2]["error"] is None
    False
    """
    given = [_plain(task) for task in tasks]
    if not callable(study):
        raise Error(f"the study is {_shown(study)}: accepted is a function of At", "a function of At")
    found: List[Optional[Dict[str, Any]]] = [None] * len(given)
    if given:
        rows = _on_threads(given, study) if client is None else _on_cluster(client, given, study)
        try:
            for done, (place, row) in enumerate(rows, 1):
                found[place] = row
                if progress is not None:
                    progress("tasks", done, len(given))
        finally:
            # an exception of progress, or Ctrl-C, ends what is under way
            rows.close()
    columns = dict.fromkeys(name for row in found for name in row or ())
    heads = ({"scheme": task.scheme, "valence": task.valence, "parameters": dict(task.values)} for task in given)
    return [{**head, **dict.fromkeys(columns), **(row or {})} for head, row in zip(heads, found)]
