"""Stores on disk."""

import locus
import numpy as np
import pytest
from conftest import NOON, posts


def test_files_come_back(tmp_path, random):
    store = locus.Store()
    records = posts(random, 1000, locus.POINT32)
    store.insert(records, NOON + 10**10)
    moment = store.snapshot()
    store.insert(records[:10], NOON + 10**10)
    told = []
    store.save(tmp_path / "now", told.append)
    moment.save(tmp_path / "before")
    assert told == sorted(told) and locus.file_info(tmp_path / "now").records == 1010
    np.testing.assert_array_equal(locus.Store.load(tmp_path / "now").read(), store.read())
    np.testing.assert_array_equal(locus.Store.load(tmp_path / "before", layout="packed_array").read(), moment.read())
    with pytest.raises(locus.ArgumentError):
        locus.Store.load(tmp_path / "now", record="text156")
    with pytest.raises(locus.IoError, match="none"):
        locus.Store.load(tmp_path / "none")
    whole = (tmp_path / "now").read_bytes()
    (tmp_path / "now").write_bytes(whole[:500] + bytes([whole[500] ^ 1]) + whole[501:])
    with pytest.raises(locus.FormatError):
        locus.Store.load(tmp_path / "now")
    with pytest.raises(locus.StoppedError):
        store.save(tmp_path / "before", lambda fraction: False)
    assert locus.file_info(tmp_path / "before").records == 1000


def test_folders_recover(tmp_path, random):
    records = posts(random, 100, locus.POINT32)
    store = locus.Store.open(tmp_path / "folder", sync="interval", sync_interval=np.timedelta64(1, "s"))
    assert store.recovery.created == 1
    store.insert(records, NOON + 10**9)
    assert store.log_stats.changes == 1 and store.log_stats.attached == 1
    store.sync()
    store.checkpoint()
    store.insert(records[:10], NOON + 10**9)
    before = store.read()
    with pytest.raises(locus.BusyError):
        locus.Store.open(tmp_path / "folder")
    del store
    gone = []
    store = locus.Store.open(tmp_path / "folder", sink=gone.append)
    assert (store.recovery.saved, store.recovery.inserted) == (100, 10)
    np.testing.assert_array_equal(store.read(), before)
    store.erase()
    assert sum(map(len, gone)) == 110
    plain = locus.Store()
    with pytest.raises(locus.BusyError):
        plain.attach(tmp_path / "folder")
    plain.attach(tmp_path / "other")
    assert plain.log_stats.attached == 1 and plain.recovery is None
