"""What can go wrong, as one line that a person can act on."""

from __future__ import annotations


class BadInput(ValueError):
    """An input outside its domain; the message names the parameter, the value and the domain.

    The command line turns it into one line on standard error and exit status 2.
    """

    def __init__(self, parameter: str, value: object, domain: str) -> None:
        self.parameter, self.value, self.domain = parameter, value, domain
        super().__init__(f"{parameter} = {value!r}: {domain}")

    def __reduce__(self) -> tuple[type[BadInput], tuple[str, object, str]]:
        """Pickled by what it was made of: an exception is otherwise made again of its message."""
        return BadInput, (self.parameter, self.value, self.domain)


class Inconclusive(RuntimeError):
    """The budget ran out before the answer reached its tolerance; the command line exits with status 3."""
