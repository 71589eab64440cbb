"""Exceptions, progress, Ctrl-C and threads across the C boundary."""

import os
import signal
import subprocess
import sys
import textwrap
import threading
import time

import locus
import numpy as np
import pytest
from conftest import NOON, asked_beside_the_writer, posts


class Mine(Exception):
    pass


def raising(*_):
    raise Mine


def solvable(shape=(40, 40, 40), **options):
    diagram = locus.Diagram(locus.Graph(np.ones(shape, np.float32), **options), engine="heap")
    diagram.add_seeds([(0, 0, 0)])
    return diagram


def test_every_status_has_its_class():
    numbers = {name: value for name, value in vars(locus.constants).items() if name.startswith("E_")}
    assert set(locus.errors.CLASSES) == set(numbers.values())
    with pytest.raises(ValueError, match="dims|dimensions"):
        locus.Graph()
    with pytest.raises(locus.ArgumentError, match="connectivity is 7") as caught:
        locus.Graph(np.ones(3), connectivity=7)
    assert caught.value.status == locus.constants.E_ARGUMENT and caught.value.name == "LOCUS_E_ARGUMENT"
    assert isinstance(caught.value, ValueError) and isinstance(caught.value, locus.Error)
    with pytest.raises(locus.StateError):
        locus.Diagram(locus.Graph(np.ones(3))).labels()
    with pytest.raises(OverflowError):
        locus.Graph(np.ones(3), connectivity=-1)


def test_progress_reports_and_cancels():
    told = []
    solvable().solve(told.append)
    assert told == sorted(told) and 0 <= told[0] and told[-1] <= 1
    diagram = solvable()
    with pytest.raises(locus.StoppedError):
        diagram.solve(lambda fraction: False)
    with pytest.raises(locus.StateError):
        diagram.labels()
    with pytest.raises(locus.StoppedError):
        diagram.place_seeds(5, progress=lambda fraction: False)
    assert len(diagram.seeds) == 1
    diagram.solve()
    with pytest.raises(locus.StoppedError):
        locus.Weights(diagram, progress=lambda fraction: False)


def test_exceptions_come_out_of_calls(random):
    diagram = solvable()
    for call in (
        lambda: diagram.solve(raising),
        lambda: diagram.update(raising),
        lambda: diagram.place_seeds(3, progress=raising),
        lambda: locus.Weights(diagram.solve(), progress=raising),
    ):
        with pytest.raises(Mine):
            call()
    store = locus.Store()
    store.insert(posts(random, 10, locus.POINT32), NOON + 10**9)
    calls = []
    bad = locus.Query(filter=lambda record: calls.append(1) or raising())
    for call in (
        lambda: store.count(bad),
        lambda: store.read(bad),
        lambda: store.erase(bad),
        lambda: store.visit(raising),
        lambda: store.visit(lambda record: None, bad),
        lambda: store.groups(raising),
        lambda: store.weighted_tile(raising, 0, 0, 0),
        lambda: list(store.pages(5, bad)),
    ):
        calls.clear()
        with pytest.raises(Mine):
            call()
        assert len(calls) <= 1
    assert len(store) == 10
    removing = locus.Store(remove=raising)
    with pytest.raises(Mine):
        removing.insert(posts(random, 10, locus.POINT32), NOON + 10**9)
        removing.sweep(NOON + 10**9)
    assert len(removing) == 10


def test_weight_functions(random):
    material = np.ones((4, 5, 6), np.float32)
    lengths = []

    def weight(u, v, length):
        assert u < v
        lengths.append(length)
        return 2 * length

    graph = locus.Graph(material, weight_rule="caller", weight=weight, material_range=(1, 4), connectivity=6)
    diagram = locus.Diagram(graph)
    diagram.add_seeds([(0, 0, 0)])
    del graph
    assert diagram.solve().distances()[3, 4, 5] == 24 and set(lengths) == {1.0}
    bad = locus.Graph(material, weight_rule="caller", weight=raising, material_range=(1, 4))
    diagram = locus.Diagram(bad)
    diagram.add_seeds([(0, 0, 0)])
    with pytest.raises(Mine):
        diagram.solve()


@pytest.mark.parametrize("engine", ["heap", "bucket", "relax", "bricks"])
def test_a_weight_function_that_raises_leaves_no_result(engine):
    left = [40]

    def weight(u, v, length):
        left[0] -= 1
        return raising() if left[0] < 0 else 2 * length

    graph = locus.Graph(np.ones((4, 5, 6), np.float32), weight_rule="caller", weight=weight, material_range=(1, 4), threads=1)
    diagram = locus.Diagram(graph, engine=engine)
    diagram.add_seeds([(0, 0, 0)])
    with pytest.raises(Mine):
        diagram.solve()
    with pytest.raises(locus.StateError):
        diagram.labels()
    left[0] = 10**6
    assert diagram.solve().distances()[0, 0, 1] == 2
    left[0] = 0
    graph.set_box(locus.VoxelBox((3, 3, 3), (1, 1, 1)), 2)
    with pytest.raises(Mine):
        diagram.update()
    with pytest.raises(locus.StateError):
        diagram.labels()


def test_logs():
    lines = []
    locus.Graph(np.ones(3), log=lambda level, text: lines.append((level, text)))
    assert lines and lines[0][0] in set(locus.LogLevel) and isinstance(lines[0][1], str)


def test_an_interrupt_cancels_a_call_that_reports_progress():
    diagram = solvable()
    with pytest.raises(KeyboardInterrupt):
        diagram.solve(lambda fraction: os.kill(os.getpid(), signal.SIGINT))
    with pytest.raises(locus.StateError):
        diagram.labels()


def test_an_interrupt_cancels_a_call_that_does_not():
    diagram = solvable((128, 128, 128))

    def interrupt():
        while not diagram._guard._writing:
            pass
        os.kill(os.getpid(), signal.SIGINT)

    thread = threading.Thread(target=interrupt)
    thread.start()
    with pytest.raises(KeyboardInterrupt):
        diagram.solve()
    thread.join()
    with pytest.raises(locus.StateError):
        diagram.labels()


def test_other_threads_run_during_a_call():
    """The interpreter's lock is released: a thread counts on while the main one is inside one call without callbacks into Python."""
    store = locus.Store()
    random = np.random.default_rng(3)
    records = posts(random, 1_000_000, locus.POINT32)
    counted, done = [0], threading.Event()

    def count():
        while not done.is_set():
            counted[0] += 1
            time.sleep(0)

    thread = threading.Thread(target=count)
    before = sys.getswitchinterval()
    # Nobody has to give the lock up within this time: the other thread runs only where the call lets go of it.
    sys.setswitchinterval(1000)
    try:
        thread.start()
        start = counted[0]
        store.insert(records, NOON + 10**13)
        during = counted[0] - start
    finally:
        done.set()
        sys.setswitchinterval(before)
        thread.join()
    assert during > 0


def test_calls_that_exclude_each_other_are_refused():
    diagram = solvable()
    refused = []

    def inside(fraction):
        for call in (diagram.solve, diagram.labels, lambda: diagram.graph.set_box(None, 2.0), lambda: diagram.add_seeds([(1, 1, 1)])):
            try:
                call()
            except locus.BusyError as error:
                refused.append(str(error))
        return False

    with pytest.raises(locus.StoppedError):
        diagram.solve(inside)
    assert len(refused) == 4 and refused[0].startswith("Diagram") and refused[2].startswith("Graph")
    diagram.solve()


def test_readers_beside_the_writer(random):
    store = locus.Store()
    records = posts(random, 20000, locus.POINT32)
    assert asked_beside_the_writer(store, records, lambda: store.count() % 100 or len(store.read()) % 100)
    assert len(store) == 20000


def test_objects_end_well_at_exit():
    program = textwrap.dedent(
        """
        import locus, numpy as np
        graph = locus.Graph(np.ones((4, 4, 4)), log=lambda level, text: None)
        diagram = locus.Diagram(graph); diagram.add_seeds([(0, 0, 0)]); diagram.solve()
        weights = locus.Weights(diagram)
        store = locus.Store(sink=print)
        store.cycle = store
        store.insert(np.zeros(5, locus.POINT32), 5)
        moment = store.snapshot()
        """
    )
    done = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True, check=False)
    assert (done.returncode, done.stdout, done.stderr) == (0, "", "")
