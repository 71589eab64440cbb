# Made from the public headers by bindings/python/generate.py: run that, do not edit.
"""What calls report, as dataclasses; the C headers tell what each field means."""

from dataclasses import dataclass


@dataclass(frozen=True)
class PmqStats:
    """locus_pmq_stats."""

    records: int
    stored: int
    pending: int
    slots: int
    bytes: int
    inserted: int
    evicted: int
    erased: int
    batches: int
    moved: int
    rebalances: int
    grows: int
    shrinks: int
    longest_pause_ns: int
    density: float
    now: int


@dataclass(frozen=True)
class AlertsStats:
    """locus_alerts_stats."""

    regions: int
    fences: int
    raised: int
    shown: int
    bytes: int


@dataclass(frozen=True)
class ColdStats:
    """locus_cold_stats."""

    received: int
    written: int
    removed: int
    stored: int
    runs: int
    queue_bytes: int
    file_bytes: int
    free_bytes: int
    transactions: int
    waits: int
    now: int
    failure: int


@dataclass(frozen=True)
class GraphInfo:
    """locus_graph_info."""

    dims: tuple[int, ...]
    spacing: tuple[float, ...]
    passable: int
    bytes: int
    connectivity: int
    weight_rule: int
    word_bits: int
    label_bits: int
    scale: float
    max_exact: int
    max_distance: float
    weight_error: float
    smallest_step: float
    overflow_free: int
    threads: int
    backend: int
    simd: int


@dataclass(frozen=True)
class DiagramStats:
    """locus_diagram_stats."""

    reached: int
    seeds: int
    relaxations: int
    iterations: int
    max_exact: int
    max_distance: float
    seconds_import: float
    seconds_solve: float
    seconds_export: float
    bytes: int
    engine: int
    threads: int
    backend: int


@dataclass(frozen=True)
class PmqFileInfo:
    """locus_pmq_file_info."""

    version: int
    record: int
    records: int
    bytes: int
    now: int


@dataclass(frozen=True)
class PmqRecovery:
    """locus_pmq_recovery."""

    created: int
    skipped: int
    number: int
    saved: int
    changes: int
    inserted: int
    departed: int
    records: int
    cut: int
    now: int


@dataclass(frozen=True)
class PmqLogStats:
    """locus_pmq_log_stats."""

    number: int
    bytes: int
    unsynced: int
    changes: int
    syncs: int
    attached: int
    stopped: int


@dataclass(frozen=True)
class RecordsStats:
    """locus_records_stats."""

    records: int
    bad: int
    cut: int
    repaired: int
    line: int
    bytes_read: int
    bytes: int


@dataclass(frozen=True)
class VolumeInfo:
    """locus_volume_info."""

    dims: tuple[int, ...]
    components: int
    spacing: tuple[float, ...]
    origin: tuple[float, ...]
    direction: tuple[float, ...]
    slope: float
    intercept: float
    type: int
    file_type: int
    format: int
    big_endian: int
