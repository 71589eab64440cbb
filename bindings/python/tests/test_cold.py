"""The cold tier, against a store that keeps everything."""

import gc
import os
import sqlite3
import subprocess
import sys
import threading
from pathlib import Path

import locus
import numpy as np
import pytest
from conftest import NOON, asked_beside_the_writer, posts

MINUTE = 60_000_000


def both(path, records, *, cold=None, **options):
    """A window of some minutes with its tier, and a store that keeps everything."""
    tier = locus.Cold(path, **(cold or {}))
    store = locus.Store(horizon=np.timedelta64(3, "m"), cold=tier, **options)
    everything = locus.Store()
    for batch in np.array_split(records, 50):
        for one in (store, everything):
            one.insert(batch, int(batch["time"].max()))
    return tier, store, everything


@pytest.mark.parametrize("layout", ["ring_leaves", "packed_array"])
def test_store_and_tier_answer_together(tmp_path, random, layout):
    records = posts(random, 2000, locus.POINT32)
    records["latitude"] = random.uniform(40, 60, 2000)
    records["latitude"][::7] = 48.5  # places with several records
    records["longitude"][::7] = 2.5
    tier, store, everything = both(tmp_path / "tier.db", records, layout=layout)
    for when in ("at once", "in the file"):
        assert tier.count(store) == 2000 and store.count() < 250, when
        np.testing.assert_array_equal(tier.read(store), everything.read())
        for query in (
            locus.Query(box=(45, -20, 55, 60)),
            locus.Query(circle=(48.5, 2.5, 2_000_000), since=NOON + 5 * MINUTE, until=NOON + 31 * MINUTE),
            locus.Query(polygon=[[(41, -100), (59, -90), (50, 100)]]),
            locus.Query(filter=lambda record: record["device"] == 3),
        ):
            np.testing.assert_array_equal(tier.read(store, query), everything.read(query))
            assert tier.count(store, query) == everything.count(query)
        store.sweep(int(records["time"].max()))
        tier.flush()
    tier.check()
    alone = tier.read()
    assert len(alone) == tier.count() == 2000 - store.count()
    assert set(alone["spare"]) | set(store.read()["spare"]) == set(records["spare"])
    out = np.zeros(2000, locus.POINT32)
    assert tier.read(store, out=out).base is out
    with pytest.raises(locus.CapacityError, match="there are 2000"):
        tier.read(store, out=out[:10])
    with pytest.raises(ValueError, match="out must be"):
        tier.read(store, out=np.zeros(10))
    stats = tier.stats
    assert isinstance(stats, locus.ColdStats) and stats.received == stats.written == len(alone) and stats.failure == 0


def test_the_moment_of_a_snapshot(tmp_path, random):
    records = posts(random, 1000, locus.POINT32)
    tier, store, everything = both(tmp_path / "tier.db", records)
    moment = store.snapshot()
    store.insert(records[-1:], int(records["time"].max()))
    store.erase()
    np.testing.assert_array_equal(tier.read(moment), everything.read())
    assert tier.count(store) == tier.count() == 1001


def test_visitors(tmp_path, random):
    records = posts(random, 500, locus.POINT32)
    tier, store, everything = both(tmp_path / "tier.db", records)
    seen = []
    assert tier.visit(lambda record: seen.append(record["spare"]), store) is True
    assert seen == everything.read()["spare"].tolist()
    assert tier.visit(lambda record: len(seen) < 500, store) is False
    calls = []
    for call in (
        lambda: tier.visit(lambda record: calls.append(1) or 1 / 0, store),
        lambda: tier.count(store, locus.Query(filter=lambda record: calls.append(1) or 1 / 0)),
    ):
        calls.clear()
        with pytest.raises(ZeroDivisionError):
            call()
        assert len(calls) == 1
    refused = []

    def inside(record):
        late = int(records["time"].max())
        for call in (
            tier.count, tier.flush, tier.check, lambda: tier.stats, lambda: tier.sweep(late), lambda: tier.rewind(0),
            lambda: store.insert(records[:0], late), lambda: store.sweep(late), store.erase,
        ):  # fmt: skip
            with pytest.raises(locus.BusyError):
                call()
            refused.append(1)
        return False

    assert tier.visit(inside, store) is False and len(refused) == 9
    assert tier.count(store) == 500


def test_age_restart_and_rewind(tmp_path, random):
    records = posts(random, 600, locus.POINT32)
    path = tmp_path / "tier.db"
    tier, store, _ = both(path, records, cold={"max_age": np.timedelta64(5, "m"), "sync": "full"})
    end = int(records["time"].max())
    store.sweep(end)
    tier.sweep(end)
    tier.flush()
    young = np.count_nonzero(records["time"] >= end - 5 * MINUTE)
    assert tier.count(store) == young and tier.stats.removed == 600 - young
    with pytest.raises(locus.ArgumentError, match="now is 0"):
        tier.sweep(0)
    with pytest.raises(locus.StateError, match="attached"):
        tier.rewind(0)
    with pytest.raises(locus.BusyError, match="open already"):
        locus.Cold(path)
    kept, received = tier.count(), tier.stats.received
    del tier  # the store keeps it
    with pytest.raises(locus.BusyError):
        locus.Cold(path)
    del store
    gc.collect()
    with pytest.raises(locus.ArgumentError, match="holds records of 32 bytes"):
        locus.Cold(path, "text156")
    tier = locus.Cold(path)
    assert tier.count() == kept
    tier.rewind(received - 10)
    assert tier.count() == kept - 10
    assert sqlite3.connect(path).execute("SELECT sum(1) FROM runs").fetchone()[0] >= 1


def test_one_store_at_a_time(tmp_path, random):
    tier = locus.Cold(tmp_path / "tier.db")
    store = locus.Store(cold=tier)
    with pytest.raises(locus.StateError, match="another store"):
        locus.Store(cold=tier)
    with pytest.raises(locus.ArgumentError, match="without this tier"):
        tier.count(locus.Store())
    with pytest.raises(ValueError, match="not both"):
        locus.Store(sink=print, cold=tier)
    store.insert(posts(random, 10, locus.POINT32), NOON + 10**9)
    store.erase()
    store.save(tmp_path / "store")
    del store
    gc.collect()
    with pytest.raises(locus.ArgumentError, match="record is 156"):
        locus.Store("text156", cold=tier)
    again = locus.Store.load(tmp_path / "store", cold=tier)
    again.insert(posts(random, 5, locus.POINT32), NOON + 10**9)
    assert tier.count(again) == 15


def blocked(path, random, when_full):
    """A tier with room for some 32,768 records in its queue, a store of 60,000 for it, and what keeps it from writing."""
    tier = locus.Cold(path, when_full=when_full, queue_bytes=1 << 20, delay=1000)
    store = locus.Store(cold=tier)
    records = posts(random, 60_000, locus.POINT32)
    store.insert(records, int(records["time"].max()))
    other = sqlite3.connect(path, isolation_level=None, check_same_thread=False)
    other.execute("BEGIN IMMEDIATE")
    return tier, store, other, int(records["time"].max())


def test_a_full_queue_refuses(tmp_path, random):
    tier, store, other, now = blocked(tmp_path / "tier.db", random, "refuse")
    with pytest.raises(locus.StoppedError):
        store.erase()
    assert store.count() == 0 and store.stats.pending > 0
    with pytest.raises(locus.StateError, match="sweep it"):
        tier.count(store)
    other.rollback()
    while store.stats.pending > 0:
        tier.flush()
        try:
            store.sweep(now)
        except locus.StoppedError:
            pass
    assert tier.count(store) == tier.count() == 60_000


def test_a_full_queue_makes_the_store_wait(tmp_path, random):
    tier, store, other, _ = blocked(tmp_path / "tier.db", random, "wait")
    release = threading.Timer(0.2, other.rollback)
    release.start()
    assert store.erase() == 60_000
    release.join()
    assert tier.count(store) == tier.count() == 60_000 and tier.stats.waits > 0


def test_other_threads_ask_beside_the_writer(tmp_path, random):
    records = posts(random, 20_000, locus.POINT32)
    tier = locus.Cold(tmp_path / "tier.db", queue_bytes=1 << 20)
    store = locus.Store(horizon=np.timedelta64(3, "m"), cold=tier)
    assert asked_beside_the_writer(store, records, lambda: tier.count(store) % 100 or len(tier.read(store)) % 100)
    assert tier.count(store) == 20_000


def test_texts(tmp_path):
    tier = locus.Cold(tmp_path / "tier.db", "text156")
    store = locus.Store("text156", cold=tier)
    record = np.zeros(1, locus.TEXT156)
    record["text"], record["time"] = "Zürich".encode(), NOON
    store.insert(record, NOON)
    store.erase()
    assert tier.dtype == locus.TEXT156 and tier.read(store)["text"].tolist() == ["Zürich".encode()]


def test_errors(tmp_path):
    with pytest.raises(locus.IoError, match="none/tier.db"):
        locus.Cold(tmp_path / "none" / "tier.db")
    (tmp_path / "text").write_text("this is no database")
    with pytest.raises(locus.FormatError, match="text"):
        locus.Cold(tmp_path / "text")
    with pytest.raises(locus.ArgumentError, match="queue_bytes is 1"):
        locus.Cold(tmp_path / "tier.db", queue_bytes=1)
    with pytest.raises(ValueError, match="'slow' is not one of"):
        locus.Cold(tmp_path / "tier.db", sync="slow")


def test_only_the_tier_needs_its_library():
    program = "import locus; locus.Store().count(); locus.Cold('tier.db')"
    environment = {**os.environ, "PYTHONPATH": str(Path(locus.__file__).parents[1]), "LOCUS_COLD_LIBRARY": "/none/liblocus_cold.so"}
    done = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True, check=False, env=environment)
    assert done.returncode == 1 and "LibraryError: LOCUS_COLD_LIBRARY is /none/liblocus_cold.so" in done.stderr, done.stderr


def test_a_tier_ends_well_at_exit(tmp_path):
    program = (
        "import locus, numpy as np\n"
        f"tier = locus.Cold({str(tmp_path / 'tier.db')!r}); store = locus.Store(cold=tier)\n"
        "store.insert(np.zeros(10, locus.POINT32), 0); store.erase()"
    )
    environment = {**os.environ, "PYTHONPATH": str(Path(locus.__file__).parents[1])}
    done = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True, check=False, env=environment)
    assert (done.returncode, done.stderr) == (0, "")
    assert locus.Cold(tmp_path / "tier.db").count() == 10
