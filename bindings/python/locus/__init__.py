"""Locus: data that changes all the time, close in memory.

Two engines: the voxel graph (`Graph`, `Diagram`, `Weights`), exact compliance distances, Voronoi diagrams and interpolation weights
on 3-D volumes; and the PMQ (`Store`, `Snapshot`, `Query`), the live window of a geo-located stream. `read_volume`, `write_volume` and
`Records` read and write files.
"""

from . import constants
from ._library import LIBRARY_PATH, version
from ._structs import AlertsStats, DiagramStats, GraphInfo, PmqStats, RecordsStats, VolumeInfo
from .alerts import ALERT, Alerts
from .constants import (
    EARTH_RADIUS,
    NO_SEED,
    AlertKind,
    BadLines,
    Backend,
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
from .pmq import GROUP, POINT32, TEXT156, Box, Circle, Query, Ranked, Snapshot, Store, pmq_key
from .records import Records
from .volume import Raw, Volume, read_volume, read_volume_info, write_volume
from .weights import Rows, Weights

__all__ = [
    "constants", "LIBRARY_PATH", "version", "ALERT", "AlertKind", "Alerts", "AlertsStats", "DiagramStats", "GraphInfo", "PmqStats", "RecordsStats", "VolumeInfo", "EARTH_RADIUS",
    "NO_SEED", "BadLines", "Backend", "Engine", "Field", "Future", "Index", "Layout", "LogLevel", "Material", "Method", "Metric", "Record",
    "RecordsFormat", "Simd", "TimeUnit", "VolumeFormat", "Voxel", "WeightRule", "Word", "CELL_PAIR", "GROUP", "SEED", "Change", "Diagram",
    "ArgumentError", "BusyError", "CapacityError", "DeviceError", "Error", "FormatError", "InternalError", "IoError", "LibraryError",
    "OutOfMemoryError", "RangeError", "StaleError", "StateError", "StoppedError", "UnsupportedError", "Graph", "VoxelBox", "POINT32",
    "TEXT156", "Box", "Circle", "Query", "Ranked", "Snapshot", "Store", "pmq_key", "Records", "Raw", "Volume", "read_volume",
    "read_volume_info", "write_volume", "Rows", "Weights",
]  # fmt: skip
