"""Locus: data that changes all the time, close in memory.

Two engines: the voxel graph (`Graph`, `Diagram`, `Weights`), exact compliance distances, Voronoi diagrams and interpolation weights
on 3-D volumes; and the PMQ (`Store`, `Snapshot`, `Query`), the live window of a geo-located stream, with `Cold` for what leaves it.
`read_volume`, `write_volume` and `Records` read and write files.
"""

from . import constants
from ._library import LIBRARY_PATH, version
from ._structs import (
    AlertsStats,
    ColdStats,
    DiagramStats,
    GraphInfo,
    PmqFileInfo,
    PmqLogStats,
    PmqRecovery,
    PmqStats,
    RecordsStats,
    VolumeInfo,
)
from .alerts import ALERT, Alerts
from .cold import Cold
from .constants import (
    EARTH_RADIUS,
    NO_SEED,
    AlertKind,
    BadLines,
    Backend,
    ColdFull,
    ColdSync,
    Engine,
    Field,
    Future,
    Index,
    Layout,
    LogLevel,
    Material,
    Method,
    Metric,
    Record,
    RecordsFormat,
    Simd,
    Sync,
    TimeUnit,
    VolumeFormat,
    Voxel,
    WeightRule,
    Word,
)
from .diagram import CELL_PAIR, SEED, Change, Diagram
from .errors import (
    ArgumentError,
    BusyError,
    CapacityError,
    DeviceError,
    Error,
    FormatError,
    InternalError,
    IoError,
    LibraryError,
    OutOfMemoryError,
    RangeError,
    StaleError,
    StateError,
    StoppedError,
    UnsupportedError,
)
from .graph import Graph, VoxelBox
from .pmq import GROUP, POINT32, TEXT156, Box, Circle, Query, Ranked, Snapshot, Store, file_info, pmq_key
from .records import Records
from .volume import Raw, Volume, read_volume, read_volume_info, write_volume
from .weights import Rows, Weights

__all__ = [
    "ALERT", "AlertKind", "Alerts", "AlertsStats", "ArgumentError", "Backend", "BadLines", "Box", "BusyError",
    "CapacityError", "CELL_PAIR", "Change", "Circle", "Cold", "ColdFull", "ColdStats", "ColdSync", "constants", "DeviceError", "Diagram", "DiagramStats", "EARTH_RADIUS",
    "Engine", "Error", "Field", "file_info", "FormatError", "Future", "Graph", "GraphInfo", "GROUP", "Index", "InternalError",
    "IoError", "Layout", "LIBRARY_PATH", "LibraryError", "LogLevel", "Material", "Method", "Metric", "NO_SEED",
    "OutOfMemoryError", "pmq_key", "PmqFileInfo", "PmqLogStats", "PmqRecovery", "PmqStats", "POINT32", "Query", "RangeError",
    "Ranked", "Raw", "read_volume", "read_volume_info", "Record", "Records", "RecordsFormat", "RecordsStats", "Rows", "SEED",
    "Simd", "Snapshot", "StaleError", "StateError", "StoppedError", "Store", "Sync", "TEXT156", "TimeUnit",
    "UnsupportedError", "version", "Volume", "VolumeFormat", "VolumeInfo", "Voxel", "VoxelBox", "WeightRule", "Weights",
    "Word", "write_volume",
]  # fmt: skip
