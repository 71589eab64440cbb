"""Between Python values and those of the C interface: arrays without copies, options, enumerations, times, dtypes."""

import datetime
from collections.abc import Callable
from dataclasses import fields
from enum import IntEnum
from typing import Any, TypeVar

import numpy as np
from numpy.typing import ArrayLike, DTypeLike, NDArray

from ._ffi import ffi
from ._library import check

Array = NDArray[Any]
_Enum = TypeVar("_Enum", bound=IntEnum)
_Filled = TypeVar("_Filled")


def readable(values: ArrayLike, dtype: DTypeLike, name: str, shape: tuple[int, ...] | None = None) -> Array:
    """The values as a contiguous array of the type: the same memory where they already are one."""
    array = np.ascontiguousarray(values, dtype=dtype)
    if shape is not None and array.shape != shape:
        raise ValueError(f"{name} has the shape {array.shape} instead of {shape}")
    return array


def writable(out: Array | None, dtype: DTypeLike, shape: tuple[int, ...], name: str = "out") -> Array:
    """The caller's array, which has to fit as it is, or a new one."""
    if out is None:
        return np.empty(shape, dtype)
    if out.dtype != dtype or out.shape != shape or not out.flags.c_contiguous or not out.flags.writeable:
        raise ValueError(
            f"{name} must be a writable C-contiguous array of {np.dtype(dtype)} with the shape {shape}, not {out.dtype} with {out.shape}"
        )
    return out


def pointer(array: Array, kind: str = "void *") -> Any:
    """The array's memory for a call; the array has to live until the call is back."""
    return ffi.cast(kind, ffi.from_buffer(array))


def enum_value(kind: type[_Enum], value: _Enum | int | str) -> int:
    """The number of an enumeration's member, given as itself, as a number or by its name in any case."""
    if isinstance(value, str):
        try:
            return int(kind[value.upper().replace("-", "_").replace(" ", "_")])
        except KeyError:
            raise ValueError(f"{value!r} is not one of {', '.join(one.name.lower() for one in kind)}") from None
    return int(value)


def filled_options(struct: str, init: Callable[[Any, int], int], checked: Callable[[int], None] = check, **values: Any) -> Any:
    """An options struct with its defaults and the values given; None leaves a default."""
    options = ffi.new(f"{struct} *")
    checked(init(options, ffi.sizeof(struct)))
    for name, value in values.items():
        if value is not None:
            setattr(options, name, value)
    return options


def filled(kind: type[_Filled], struct: Any) -> _Filled:
    """A dataclass of _structs.py from the C struct of its name."""
    values = {}
    for field in fields(kind):
        value = getattr(struct, field.name)
        values[field.name] = tuple(value) if isinstance(value, ffi.CData) else value
    return kind(**values)


def empty_struct(struct: str) -> Any:
    """A struct that begins with its size, for a call to fill in."""
    new = ffi.new(f"{struct} *")
    new.struct_size = ffi.sizeof(struct)
    return new


def dtype_of(struct: str) -> np.dtype[Any]:
    """The numpy dtype of a record struct: its fields with their own names, types and offsets."""
    kind = ffi.typeof(struct)
    names: list[str] = []
    formats: list[str | np.dtype[Any]] = []
    offsets: list[int] = []
    for name, field in kind.fields:
        inner = field.type
        names.append(name)
        offsets.append(field.offset)
        if inner.kind == "struct":
            formats.append(dtype_of(inner.cname))
        elif inner.kind == "array":
            formats.append(f"S{inner.length}")
        else:
            letter = {"float": "f", "double": "f", "int64_t": "i", "int32_t": "i"}.get(inner.cname, "u")
            formats.append(f"{letter}{ffi.sizeof(inner)}")
    return np.dtype({"names": names, "formats": formats, "offsets": offsets, "itemsize": ffi.sizeof(kind)})


def microseconds(time: int | np.integer[Any] | np.datetime64 | np.timedelta64 | datetime.datetime | datetime.timedelta) -> int:
    """A time, or a length of time, in microseconds; a datetime without a zone is taken as UTC."""
    if isinstance(time, datetime.timedelta):
        return time // datetime.timedelta(microseconds=1)
    if isinstance(time, datetime.datetime):
        zoned = time if time.tzinfo is not None else time.replace(tzinfo=datetime.timezone.utc)
        return (zoned - datetime.datetime(1970, 1, 1, tzinfo=datetime.timezone.utc)) // datetime.timedelta(microseconds=1)
    if isinstance(time, np.datetime64):
        return int(time.astype("datetime64[us]").astype(np.int64))
    if isinstance(time, np.timedelta64):
        return int(time.astype("timedelta64[us]").astype(np.int64))
    return int(time)
