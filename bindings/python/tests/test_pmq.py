"""Stores against plain arrays of records."""

import datetime

import locus
import numpy as np
import pytest
from conftest import NOON, metres, posts

LAYOUTS = [{}, {"layout": "packed_array"}, {"layout": "packed_array", "index": "explicit"}]


@pytest.fixture(params=LAYOUTS, ids=["ring", "implicit", "explicit"])
def filled(request, random):
    records = posts(random, 3000, locus.POINT32)
    store = locus.Store(**request.param)
    for batch in np.array_split(records, 7):
        store.insert(batch, int(batch["time"].max()))
    return store, records


def same(found, wanted):
    assert sorted(found["spare"].tolist()) == sorted(wanted["spare"].tolist())


def test_regions_and_times(filled):
    store, records = filled
    lat, lon = records["latitude"], records["longitude"]
    inside = (lat >= -30) & (lat <= 50) & (lon >= -20) & (lon <= 70)
    box = locus.Query(box=locus.Box(-30, -20, 50, 70))
    same(store.read(box), records[inside])
    assert store.count(box) == inside.sum() and len(store) == 3000
    same(store.read(locus.Query(box=box.box, any_order=True)), records[inside])
    across = locus.Query(box=(-90, 170, 90, -170))
    same(store.read(across), records[(lon >= 170) | (lon <= -170)])
    same(store.read(locus.Query(circle=(10, 20, 3e6))), records[metres(10, 20, lat, lon) <= 3e6])
    ring = [(-30, -20), (-30, 70), (50, 70), (50, -20)]
    hole = np.array([(0, 0), (0, 10), (10, 10), (10, 0)], float)
    in_hole = (lat > 0) & (lat < 10) & (lon > 0) & (lon < 10)
    same(store.read(locus.Query(polygon=[ring, hole])), records[inside & ~in_hole])
    late = records["time"] >= NOON + 1_000_000_000
    same(store.read(locus.Query(since=np.datetime64(NOON + 1_000_000_000, "us"))), records[late])
    until = datetime.datetime.fromtimestamp(1_700_000_010, datetime.timezone.utc)
    assert store.count(locus.Query(until=until)) == 11
    assert store.count(locus.Query(until=until.replace(tzinfo=None))) == 11
    filtered = locus.Query(filter=lambda record: record["device"] == 3, since=NOON)
    same(store.read(filtered), records[records["device"] == 3])
    with pytest.raises(ValueError, match="one region"):
        store.count(locus.Query(box=(0, 0, 1, 1), circle=(0, 0, 1)))


def test_order_pages_visits(filled):
    store, records = filled
    everything = store.read()
    keys = [locus.pmq_key(float(one["latitude"]), float(one["longitude"])) for one in everything]
    assert keys == sorted(keys)
    np.testing.assert_array_equal(np.concatenate(list(store.pages(100))), everything)
    seen = []
    assert store.visit(lambda record: seen.append(int(record["spare"]))) is True
    assert seen == everything["spare"].tolist()
    kept = []
    assert store.visit(lambda record: kept.append(record) or len(kept) < 3) is False
    assert [int(one["spare"]) for one in kept] == seen[:3]
    room = np.empty(3000, locus.POINT32)
    assert np.shares_memory(store.read(out=room), room)
    with pytest.raises(locus.CapacityError, match="3000"):
        store.read(out=room[:10])


def test_pages_of_one_place(random):
    store = locus.Store()
    records = posts(random, 300, locus.POINT32)
    records["latitude"], records["longitude"] = 1, 2
    store.insert(records, NOON + 10**9)
    np.testing.assert_array_equal(np.concatenate(list(store.pages(7))), records)


def test_groups_and_tiles(filled):
    store, records = filled
    values, counts = np.unique(records["device"], return_counts=True)
    groups = store.groups("device")
    assert dict(zip(groups["value"].tolist(), groups["count"].tolist())) == dict(zip(values.tolist(), counts.tolist()))
    assert np.all(np.diff(groups["count"].astype(int)) <= 0)
    by_call = store.groups(lambda record: int(record["spare"]))
    assert len(by_call) == 3000 and set(by_call["count"].tolist()) == {1}
    bins = store.tile(0, 0, 0, 2)
    assert bins.shape == (4, 4) and bins.sum() == 3000
    column = np.minimum((records["longitude"] + 180) / 90, 3).astype(int)
    assert bins.sum(axis=0).tolist() == np.bincount(column, minlength=4).tolist()
    weighted = store.weighted_tile(lambda record: record["device"], 0, 0, 0, 2)
    assert weighted.dtype == np.float64 and weighted.sum() == records["device"].sum()
    with pytest.raises(locus.ArgumentError):
        store.weighted_tile(lambda record: float("nan"), 0, 0, 0, 2)


def test_nearest_and_best(filled):
    store, records = filled
    far = metres(40, 50, records["latitude"], records["longitude"])
    found = store.nearest(10, 40, 50)
    np.testing.assert_allclose(found.values, np.sort(far)[:10], rtol=1e-9)
    assert found.records["spare"].tolist() == records["spare"][np.argsort(far)[:10]].tolist()
    now = int(records["time"].max())
    age = now - records["time"]
    score = 0.5 * far / 5e6 + 0.5 * age / 2e9
    score[(far > 5e6) | (age > 2e9)] = np.inf
    best = store.topk(8, 40, 50, radius=5e6, alpha=0.5, period=datetime.timedelta(seconds=2000))
    np.testing.assert_allclose(best.values, np.sort(score)[:8], rtol=1e-9)
    assert len(store.nearest(5000, 0, 0).records) == 3000
    with pytest.raises(locus.ArgumentError):
        store.nearest(0, 0, 0)


def test_windows_and_sinks(random):
    records = posts(random, 10000, locus.POINT32)
    gone = []
    store = locus.Store(horizon=np.timedelta64(1000, "s"), sink=gone.append, remove=lambda record: record["device"] == 4)
    now = int(records["time"].max())
    store.insert(records, now)
    store.sweep(now)
    leaves = (records["time"] < now - 1_000_000_000) | (records["device"] == 4)
    same(np.concatenate(gone), records[leaves])
    same(store.read(), records[~leaves])
    assert all(len(batch) <= 4096 for batch in gone) and gone[0].dtype == locus.POINT32
    gone.clear()
    assert store.erase(locus.Query(box=(0, -180, 90, 180))) == sum(len(batch) for batch in gone) > 0
    store.check()
    assert store.stats.erased == sum(len(batch) for batch in gone)
    limited = locus.Store(max_records=500)
    limited.insert(records, now)
    assert 468 <= len(limited) <= 500


def test_a_sink_that_raises_loses_nothing(random):
    taken, full = [], [True]

    def sink(records):
        if full[0]:
            raise OSError("the disk is full")
        taken.append(records)

    store = locus.Store(sink=sink)
    store.insert(posts(random, 9000, locus.POINT32), NOON + 10**10)
    with pytest.raises(OSError, match="the disk is full"):
        store.erase()
    with pytest.raises(OSError, match="the disk is full"):
        store.sweep(NOON + 10**10)
    full[0] = False
    store.sweep(NOON + 10**10)
    assert sorted(np.concatenate(taken)["spare"].tolist()) == list(range(9000))


def test_snapshots(random):
    store = locus.Store()
    store.insert(posts(random, 100, locus.POINT32), NOON + 10**9)
    before = store.snapshot()
    store.insert(posts(random, 50, locus.POINT32), NOON + 10**9)
    assert len(before) == 100 and len(store) == 150
    assert len(before.read(locus.Query(since=NOON))) == 100
    assert before.tile(0, 0, 0, 0).tolist() == [[100]]
    assert sum(map(len, before.pages(7))) == 100
    del store
    assert len(before) == 100
    with pytest.raises(locus.UnsupportedError):
        locus.Store(layout="packed_array").snapshot()


def test_texts():
    store = locus.Store("text156")
    records = np.zeros(2, locus.TEXT156)
    records["text"] = ["Bonjour".encode(), "日本".encode()]
    records["time"] = NOON
    store.insert(records, np.datetime64(NOON, "us"))
    assert {text.decode() for text in store.read()["text"]} == {"Bonjour", "日本"}
    assert store.count(locus.Query(filter=lambda record: record["text"].startswith(b"Bon"))) == 1
    assert store.read()["time"].dtype == np.int64
    assert store.read()["time"].copy().view("datetime64[us]")[0] == np.datetime64(NOON, "us")


def test_errors_name_the_record(random):
    store = locus.Store()
    records = posts(random, 5, locus.POINT32)
    records["latitude"][3] = 91
    with pytest.raises(locus.ArgumentError, match="91"):
        store.insert(records, NOON + 10**9)
    assert len(store) == 0 and store.dtype == locus.POINT32
    with pytest.raises(ValueError, match="dtype"):
        store.insert(np.zeros(3, locus.TEXT156), NOON)
    with pytest.raises(ValueError, match="point32, text156"):
        locus.Store("point64")
    assert locus.pmq_key(0, 0) == 3 << 48


def test_nothing_is_kept_alive(random):
    import gc
    import weakref

    class Sink:
        def __call__(self, records):
            pass

    sink = Sink()
    gone = weakref.ref(sink)
    store = locus.Store(sink=sink)
    store.insert(posts(random, 10, locus.POINT32), NOON + 10**9)
    del store, sink
    gc.collect()
    assert gone() is None


def test_expired_records_until_they_leave(random):
    store = locus.Store(horizon=np.timedelta64(1000, "s"))
    store.insert(posts(random, 1000, locus.POINT32), NOON + 10**9)
    store.insert(posts(random, 0, locus.POINT32), NOON + 10**9 + 10**7)
    assert store.count() == 990 <= store.count(locus.Query(expired=True)) == store.stats.stored
    with pytest.raises(locus.ArgumentError, match="expired"):
        store.erase(locus.Query(expired=True))
