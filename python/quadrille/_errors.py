# SPDX-License-Identifier: MIT
"""What is raised for bad input."""

from __future__ import annotations

from typing import Optional


class InputError(ValueError):
    """An argument or a file is wrong. The text is what the program prints: ``file:line: reason``.

    Attributes:
        code: "io", "syntax", "invalid-instance", "no-plan", "out-of-range" or "invalid-plan".
        reason: The text without file and line.
        file: Name of the file, or None.
        line: Line in the file, from 1, or None.
    """

    code: str = "out-of-range"
    reason: str = ""
    file: Optional[str] = None
    line: Optional[int] = None


class NoPlanError(InputError):
    """No plan can exist, as is seen without a search: starts or goals of bodies overlap, a goal cannot
    be reached, or a deadline is too early. ``solve`` says so in its result and raises nothing; this is
    raised where the instance itself is needed: its plans, ``save``, and all of a fleet from a file."""


class FileError(InputError, OSError):
    """A file cannot be opened, read or written."""


class RoundingWarning(UserWarning):
    """Robots are planned to be notably faster or slower than they are, because the times that they take
    for edges are rounded to whole ticks."""


class BodyWarning(UserWarning):
    """A file says nothing of bodies, and no radius was given."""


class LayoutWarning(UserWarning):
    """A file of roads says something that plans do not honour."""


def renamed(error: InputError, text: str) -> InputError:
    """The same error in other words."""
    other = type(error)(text)
    other.code, other.reason, other.file, other.line = error.code, text, error.file, error.line
    return other


def make_error(code: str, text: str, reason: str, file: str, line: int) -> InputError:
    kinds = {"no-plan": NoPlanError, "io": FileError}
    error = kinds.get(code, InputError)(text)
    error.code, error.reason = code, reason
    error.file, error.line = file or None, line or None
    return error
