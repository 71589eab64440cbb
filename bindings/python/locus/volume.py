"""Volume files: MetaImage, NRRD, NIfTI and raw arrays (liblocus_io)."""

import os
from dataclasses import dataclass
from typing import Any

import numpy as np

from ._ffi import ffi
from ._library import check_io, io_library
from ._structs import VolumeInfo
from ._values import Array, empty_struct, enum_value, filled, filled_options, pointer
from .constants import READ_FLOAT, READ_KEEP, Voxel, VolumeFormat

_DTYPES = {kind: np.dtype(kind.name.lower()) for kind in Voxel}
_VOXELS = {dtype: kind for kind, dtype in _DTYPES.items()}


@dataclass(frozen=True)
class Raw:
    """How the numbers of a file without a header lie.

    Parameters
    ----------
    shape : tuple of int
        (z, y, x), or (components, z, y, x).
    dtype : numpy dtype
        Of the numbers; ``">i2"`` has its high byte first.
    offset : int
        Bytes before the numbers.
    spacing, origin : tuple of float
        (x, y, z).
    interleaved : bool
        The components of a voxel lie side by side.
    """

    shape: tuple[int, ...]
    dtype: Any
    offset: int = 0
    spacing: tuple[float, float, float] = (1.0, 1.0, 1.0)
    origin: tuple[float, float, float] = (0.0, 0.0, 0.0)
    interleaved: bool = False

    def _options(self) -> dict[str, Any]:
        if len(self.shape) not in (3, 4):
            raise ValueError(f"shape must be (z, y, x) or (components, z, y, x), not {self.shape}")
        dtype = np.dtype(self.dtype)
        native = dtype.newbyteorder("=")
        if native not in _VOXELS:
            raise ValueError(f"no volume holds numbers of the dtype {dtype}")
        big = dtype.byteorder == ">" or (dtype.byteorder in "=|" and dtype.itemsize > 1 and np.little_endian is False)
        return {
            "format": VolumeFormat.RAW, "raw_dims": self.shape[-3:][::-1], "raw_type": _VOXELS[native], "raw_offset": self.offset,
            "raw_components": self.shape[0] if len(self.shape) == 4 else 1, "raw_spacing": self.spacing, "raw_origin": self.origin,
            "raw_interleaved": self.interleaved, "raw_big_endian": big,
        }  # fmt: skip


class _Memory:
    """The memory of a volume of the library's, which lives as long as an array that looks at it."""

    def __init__(self, handle: Any, address: int, shape: tuple[int, ...], dtype: np.dtype[Any]) -> None:
        self._handle = handle
        self.__array_interface__ = {"version": 3, "shape": shape, "typestr": dtype.str, "data": (address, True)}


@dataclass(frozen=True)
class Volume:
    """A volume that was read: its numbers, which lie where the library read them to, and what is known about them."""

    data: Array  #: (z, y, x), or (components, z, y, x); read-only
    info: VolumeInfo

    @property
    def spacing(self) -> tuple[float, ...]:
        """A voxel's edge lengths (x, y, z)."""
        return self.info.spacing


def _read_options(
    keep: bool, format: VolumeFormat | str, raw: Raw | None, memory_limit: int | None, allow_trailing: bool
) -> Any:
    given = raw._options() if raw is not None else {"format": enum_value(VolumeFormat, format)}
    return filled_options(
        "locus_volume_read_options", io_library().locus_volume_read_options_init, check_io, memory_limit=memory_limit,
        numbers=READ_KEEP if keep else READ_FLOAT, allow_trailing=allow_trailing, **given,
    )  # fmt: skip


def read_volume(
    path: str | os.PathLike[str], *, keep: bool = False, format: VolumeFormat | str = VolumeFormat.AUTO, raw: Raw | None = None,
    memory_limit: int | None = None, allow_trailing: bool = False,
) -> Volume:  # fmt: skip
    """Read a volume file.

    Parameters
    ----------
    path : path-like
    keep : bool
        Keep the file's own type of numbers, instead of float32 with slope and intercept applied.
    format : VolumeFormat or str
        By default told by the first bytes.
    raw : Raw, optional
        For a file without a header.
    memory_limit : int, optional
        Most bytes the numbers may take.
    allow_trailing : bool
        Bytes after the numbers are fine.

    Raises
    ------
    IoError, FormatError, UnsupportedError, ArgumentError, OutOfMemoryError
    """
    io = io_library()
    options = _read_options(keep, format, raw, memory_limit, allow_trailing)
    made = ffi.new("locus_volume **")
    check_io(io.locus_volume_read(os.fsencode(path), options, made))
    handle = ffi.gc(made[0], io.locus_volume_destroy)
    info = empty_struct("locus_volume_info")
    check_io(io.locus_volume_get_info(handle, info))
    shape = tuple(reversed(list(info.dims)))
    if info.components > 1:
        shape = (info.components, *shape)
    address = int(ffi.cast("uintptr_t", io.locus_volume_data(handle)))
    data = np.asarray(_Memory(handle, address, shape, _DTYPES[Voxel(info.type)]))
    return Volume(data, filled(VolumeInfo, info))


def read_volume_info(
    path: str | os.PathLike[str], *, keep: bool = False, format: VolumeFormat | str = VolumeFormat.AUTO, raw: Raw | None = None
) -> VolumeInfo:
    """What `read_volume` would give, from the file's header alone."""
    info = empty_struct("locus_volume_info")
    check_io(io_library().locus_volume_read_info(os.fsencode(path), _read_options(keep, format, raw, None, False), info))
    return filled(VolumeInfo, info)


def write_volume(
    path: str | os.PathLike[str], data: Array, *, spacing: tuple[float, ...] = (1.0, 1.0, 1.0),
    origin: tuple[float, ...] = (0.0, 0.0, 0.0), direction: tuple[float, ...] | None = None,
    format: VolumeFormat | str = VolumeFormat.AUTO, compression: int = 0,
) -> None:  # fmt: skip
    """Write an array (z, y, x) or (components, z, y, x) as MetaImage or NRRD, by the ending of the path.

    Parameters
    ----------
    path : path-like
    data : ndarray
        C-contiguous arrays are written from where they lie.
    spacing, origin : tuple of float
        (x, y, z).
    direction : tuple of float, optional
        Unit vectors along the grid's x, y and z axes, nine numbers.
    format : VolumeFormat or str
    compression : int
        0 for none, 1 (fast) to 9 (small).
    """
    io = io_library()
    if data.ndim not in (3, 4) or data.dtype not in _VOXELS:
        raise ValueError(f"data must be (z, y, x) or (components, z, y, x) of 8- to 64-bit numbers, not {data.dtype} {data.shape}")
    array = np.ascontiguousarray(data)
    info = filled_options(
        "locus_volume_info", io.locus_volume_info_init, check_io, dims=array.shape[-3:][::-1], type=_VOXELS[array.dtype],
        components=array.shape[0] if array.ndim == 4 else 1, spacing=spacing, origin=origin, direction=direction,
    )  # fmt: skip
    options = filled_options(
        "locus_volume_write_options", io.locus_volume_write_options_init, check_io, format=enum_value(VolumeFormat, format),
        compression=compression,
    )  # fmt: skip
    check_io(io.locus_volume_write(os.fsencode(path), info, pointer(array), options))
