"""Alerts and fences."""

import threading

import locus
import numpy as np
import pytest
from conftest import NOON, posts


class Mine(Exception):
    pass


def raising(*_):
    raise Mine


def test_fences(random):
    store, shown = locus.Store(), []
    alerts = locus.Alerts(store, fence=lambda fence, record: shown.append((fence, int(record["spare"]))))
    alerts.add_fence(5, locus.Query(box=(-30, -60, 30, 60)))
    alerts.add_fence(4, locus.Query(circle=(0, 0, 3e6), filter=lambda record: record["device"] == 1))
    records = posts(random, 2000, locus.POINT32)
    store.insert(records, int(records["time"].max()))
    inside = (np.abs(records["latitude"]) <= 30) & (np.abs(records["longitude"]) <= 60)
    assert [one for fence, one in shown if fence == 5] == records["spare"][inside].tolist()
    assert 0 < len([one for fence, one in shown if fence == 4]) < 100
    assert alerts.stats.fences == 2 and alerts.stats.shown == len(shown)
    alerts.remove_fence(5)
    with pytest.raises(locus.ArgumentError):
        alerts.remove_fence(5)
    alerts.add_fence(6, locus.Query(filter=raising))
    with pytest.raises(Mine):
        store.insert(records, int(records["time"].max()))
    assert len(store) == 4000
    alerts.close()
    alerts.close()
    shown.clear()
    store.insert(records, int(records["time"].max()))
    assert not shown
    with pytest.raises(locus.ArgumentError):
        alerts.active()


def rush(store, count=100, latitude=48.85, longitude=2.35):
    records = np.zeros(count, locus.POINT32)
    records["latitude"], records["longitude"] = latitude, longitude
    for minute in range(5):
        records["time"] = NOON + minute * 60_000_000
        store.insert(records, NOON + minute * 60_000_000)


def test_alerts():
    store, told = locus.Store(), []
    alerts = locus.Alerts(store, rate=0.5, minimum=50, alert=told.append)
    rush(store)
    assert len(told) > 0 and told[0]["kind"] in set(locus.AlertKind)
    assert told[0]["box"]["south"] <= 48.85 <= told[0]["box"]["north"] and told[0]["number"] == 1
    assert alerts.active()["number"].tolist() == sorted((int(one["number"]) for one in told), reverse=True)
    assert alerts.active().dtype == locus.ALERT
    throwing = locus.Store()
    locus.Alerts(throwing, rate=0.5, minimum=50, alert=raising)
    with pytest.raises(Mine):
        rush(throwing)
    stopping = locus.Store()
    locus.Alerts(stopping, rate=0.5, minimum=50, alert=lambda alert: False)
    with pytest.raises(locus.StoppedError):
        rush(stopping)
    with pytest.raises(locus.ArgumentError, match="minimum"):
        locus.Alerts(store, minimum=-1)


def test_a_callback_may_ask_and_close(random):
    store, counts = locus.Store(), []
    alerts = locus.Alerts(store, fence=lambda fence, record: (counts.append(len(store)), alerts.close()) and None)
    alerts.add_fence(1, locus.Query())
    store.insert(posts(random, 10, locus.POINT32), NOON + 10**9)
    assert counts == [10]


def test_closing_beside_an_insert(random):
    store = locus.Store()
    records = posts(random, 1000, locus.POINT32)

    def watch():
        for number in range(50):
            alerts = locus.Alerts(store, fence=lambda fence, record: None)
            alerts.add_fence(number, locus.Query(filter=lambda record: True))
            alerts.close()

    thread = threading.Thread(target=watch)
    thread.start()
    stored = 0
    while thread.is_alive():
        try:
            store.insert(records, int(records["time"].max()))
            stored += 1000
        except locus.BusyError:
            pass
    thread.join()
    assert len(store) == stored
