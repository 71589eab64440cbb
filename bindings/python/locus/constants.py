# Made from the public headers by bindings/python/generate.py: run that, do not edit.
"""The constants of the C headers, which tell what each means."""

from enum import IntEnum
from typing import Final

VERSION_MAJOR: Final = 0
VERSION_MINOR: Final = 1
VERSION_PATCH: Final = 0
VERSION: Final = 100
OK: Final = 0
E_ARGUMENT: Final = 10
E_RANGE: Final = 11
E_CAPACITY: Final = 12
E_STATE: Final = 13
E_UNSUPPORTED: Final = 14
E_STOPPED: Final = 20
E_BUSY: Final = 21
E_STALE: Final = 22
E_MEMORY: Final = 30
E_IO: Final = 31
E_FORMAT: Final = 32
E_DEVICE: Final = 33
E_INTERNAL: Final = 90
NO_HORIZON: Final = 9223372036854775807
NO_LIMIT: Final = 18446744073709551615
EARTH_RADIUS: Final = 6371008.7714
REGION_ALL: Final = 0
REGION_BOX: Final = 1
REGION_CIRCLE: Final = 2
REGION_POLYGON: Final = 3
ORDER_KEY: Final = 0
ORDER_ANY: Final = 1
KEY_END: Final = 1125899906842624
NO_SEED: Final = 4294967295
ALL_SEEDS: Final = 0
READ_FLOAT: Final = 0
READ_KEEP: Final = 1


class LogLevel(IntEnum):
    """LOCUS_LOG_."""

    DEBUG = 10
    INFO = 20
    WARNING = 30


class Record(IntEnum):
    """LOCUS_RECORD_."""

    POINT32 = 32
    TEXT156 = 156


class Layout(IntEnum):
    """LOCUS_LAYOUT_."""

    RING_LEAVES = 0
    PACKED_ARRAY = 1


class Index(IntEnum):
    """LOCUS_INDEX_."""

    IMPLICIT = 0
    EXPLICIT = 1
    HEADS = 2


class Future(IntEnum):
    """LOCUS_FUTURE_."""

    REFUSE = 0
    CLAMP = 1


class Field(IntEnum):
    """LOCUS_FIELD_."""

    DEVICE = 0
    APPLICATION = 1
    LANGUAGE = 2
    CALLER = 3


class AlertKind(IntEnum):
    """LOCUS_ALERT_."""

    JUMP = 0
    RATE = 1
    SHARE = 2


class ColdSync(IntEnum):
    """LOCUS_COLD_SYNC_."""

    OFF = 0
    NORMAL = 1
    FULL = 2


class ColdFull(IntEnum):
    """LOCUS_COLD_FULL_."""

    WAIT = 0
    REFUSE = 1


class WeightRule(IntEnum):
    """LOCUS_WEIGHT_."""

    MEAN_COMPLIANCE = 0
    MAX_COMPLIANCE = 1
    MEAN_STIFFNESS = 2
    UNIFORM = 3
    CALLER = 4


class Material(IntEnum):
    """LOCUS_MATERIAL_."""

    COMPLIANCE = 0
    STIFFNESS = 1


class Word(IntEnum):
    """LOCUS_WORD_."""

    AUTO = 0
    BITS_32 = 32
    BITS_64 = 64


class Backend(IntEnum):
    """LOCUS_BACKEND_."""

    AUTO = 0
    CPU = 1
    CUDA = 2


class Simd(IntEnum):
    """LOCUS_SIMD_."""

    AUTO = 0
    SCALAR = 1
    SSE4 = 2
    AVX2 = 3
    AVX512 = 4
    NEON = 5


class Engine(IntEnum):
    """LOCUS_ENGINE_."""

    AUTO = 0
    HEAP = 1
    BUCKET = 2
    RELAX = 3
    BRICKS = 4
    COMPACT = 5


class Metric(IntEnum):
    """LOCUS_PLACE_."""

    COMPLIANCE = 0
    UNIFORM = 1


class Sync(IntEnum):
    """LOCUS_SYNC_."""

    NONE = 0
    BATCH = 1
    INTERVAL = 2


class Method(IntEnum):
    """LOCUS_METHOD_."""

    SIBSON = 0
    LAPLACE = 1
    DISTANCE_RATIO = 2


class RecordsFormat(IntEnum):
    """LOCUS_RECORDS_."""

    AUTO = 0
    CSV = 1
    NDJSON = 2


class TimeUnit(IntEnum):
    """LOCUS_TIME_."""

    AUTO = 0
    SECONDS = 1
    MILLISECONDS = 2
    MICROSECONDS = 3
    NANOSECONDS = 4


class BadLines(IntEnum):
    """LOCUS_BAD_LINES_."""

    COUNT = 0
    REFUSE = 1


class Voxel(IntEnum):
    """LOCUS_VOXEL_."""

    UINT8 = 1
    INT8 = 2
    UINT16 = 3
    INT16 = 4
    UINT32 = 5
    INT32 = 6
    UINT64 = 7
    INT64 = 8
    FLOAT32 = 9
    FLOAT64 = 10


class VolumeFormat(IntEnum):
    """LOCUS_VOLUME_."""

    AUTO = 0
    METAIMAGE = 1
    NRRD = 2
    NIFTI = 3
    RAW = 4
