# SPDX-License-Identifier: MIT
"""From what users pass to arrays of one shape, type and order, or a ValueError."""

from __future__ import annotations

from typing import Any, Optional, TypeVar, cast

import numpy as np
import numpy.typing as npt

T = TypeVar("T")

# None: of any length.
Shape = tuple[Optional[int], ...]


def _shaped(array: npt.NDArray[Any], name: str, shape: Shape) -> npt.NDArray[Any]:
    # An empty list has no second dimension.
    if array.size == 0 and len(shape) > 1 and array.ndim == 1 and shape[0] is None:
        array = array.reshape([n or 0 for n in shape])
    fits = array.ndim == len(shape) and all(
        want is None or want == has for want, has in zip(shape, array.shape)
    )
    if not fits:
        wanted = ", ".join("n" if n is None else str(n) for n in shape)
        raise ValueError(f"{name}: expected an array of shape ({wanted}), not {array.shape}")
    return array


def bools(values: Any, name: str, shape: Shape) -> npt.NDArray[np.bool_]:
    array = np.asarray(values)
    if array.dtype.kind in "iuf" and np.isin(array, (0, 1)).all():
        array = array.astype(np.bool_)
    if array.dtype.kind != "b":
        raise ValueError(f"{name}: expected booleans or 0 and 1, not {array.dtype}")
    return np.ascontiguousarray(_shaped(array, name, shape))


def ints(values: Any, name: str, shape: Shape) -> npt.NDArray[np.int64]:
    array = np.asarray(values)
    if array.size == 0:
        array = array.astype(np.int64)
    if array.dtype.kind not in "iu":
        raise ValueError(f"{name}: expected integers, not {array.dtype}")
    if array.dtype.kind == "u" and array.size and array.max() > np.iinfo(np.int64).max:
        raise ValueError(f"{name}: a number is too large")
    return np.ascontiguousarray(_shaped(array, name, shape), dtype=np.int64)


def doubles(values: Any, name: str, shape: Shape) -> npt.NDArray[np.float64]:
    array = np.asarray(values)
    if array.size == 0:
        array = array.astype(np.float64)
    if array.dtype.kind not in "iuf":
        raise ValueError(f"{name}: expected numbers, not {array.dtype}")
    return np.ascontiguousarray(_shaped(array, name, shape), dtype=np.float64)


A = TypeVar("A", bound=npt.NDArray[Any])


def frozen(array: A) -> A:
    """From now on it cannot be written to."""
    array.flags.writeable = False
    return array


class Immutable:
    """What nobody can change need not be copied; what comes out of a pickle cannot be changed either."""

    def __copy__(self: T) -> T:
        return self

    def __deepcopy__(self: T, memo: dict[int, Any]) -> T:
        return self

    def __setstate__(self, state: dict[str, Any]) -> None:
        for value in state.values():
            if isinstance(value, np.ndarray):
                frozen(value)
        self.__dict__.update(state)


def listed(array: npt.NDArray[Any]) -> list[Any]:
    """``array.tolist()``, of which numpy 1 says Any and numpy 2 a union of all depths."""
    return cast(list[Any], array.tolist())


def with_places(values: Any, name: str, others: int = 0) -> npt.NDArray[np.float64]:
    """Rows of two coordinates, or of three, and ``others`` numbers."""
    in_space = np.ndim(values) == 2 and np.shape(values)[1] == 3 + others
    return doubles(values, name, (None, (3 if in_space else 2) + others))


def per_agent(values: Any, name: str, n: int) -> npt.NDArray[np.float64]:
    """One number for all agents, or one for each."""
    if np.ndim(values) == 0:
        values = [values] * n
    return doubles(values, name, (n,))
