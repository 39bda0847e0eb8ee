"""The one exception of the package."""

from typing import Any, Optional, Tuple


class Error(ValueError):
    """A value, a scheme or a mesh that is refused; the message is that of the command.

    ``accepted`` says what is accepted in its place, or is None where that cannot be said.

    >>> import eigenring
    >>> try:
    ...     eigenring.Scheme("catmull-clark").at(2)
    ... except eigenring.Error as error:
    ...     print(error.accepted)
    3 and above
    """

    def __init__(self, message: str, accepted: Optional[str] = None) -> None:
        super().__init__(message)
        self.accepted = accepted

    def __reduce__(self) -> Tuple[Any, ...]:
        return (type(self), (str(self), self.accepted))
