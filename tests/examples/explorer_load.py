#!/usr/bin/env python3
"""The explorer under load: tests/examples/explorer_load.py PROGRAM [--records N] [--rate N] [--listeners N] [--keep] [--page] ...

Fills a window from the demo stream, measures the writer alone, then beside event listeners and maps that ask for tiles, and prints what
tiles take, how long a page needs in Chromium until it can be used (--page), and how the insert's p99 with clients compares with that
without. The clients run on the same machine as the server: what they cost it is printed, too. Fails where an answer is wrong or missing,
never because something was slow."""
import argparse
import asyncio
import json
import os
import pathlib
import random
import re
import resource
import signal
import subprocess
import sys
import tempfile
import time

HERE = pathlib.Path(__file__).resolve().parent
CITIES = [(0.5226, 0.3449), (0.2056, 0.3758), (0.8881, 0.3938), (0.4996, 0.3325), (0.7147, 0.4182)]  # mercator x, y
DEEPEST = 15
PATIENCE = 60  # seconds

options = argparse.ArgumentParser()
options.add_argument("program")
options.add_argument("--records", type=int, default=10_000_000)
options.add_argument("--rate", type=int, default=20_000)
options.add_argument("--listeners", type=int, default=100)
options.add_argument("--maps", type=int, default=2, help="clients that ask for tiles")
options.add_argument("--tiles", type=float, default=20, help="tiles a second of each of them, at random times")
options.add_argument("--seconds", type=float, default=60, help="of each measurement; the server's figures are of its last minute")
options.add_argument("--keep", action="store_true", help="what leaves the window goes into a database")
options.add_argument("--page", type=int, nargs="?", const=5, default=0, metavar="TIMES", help="open the page in Chromium")
options = options.parse_args()


class Connection:
    """HTTP/1.1 over one connection, which is made anew when the server has closed it."""

    def __init__(self, port):
        self.port = port
        self.reader = self.writer = None

    async def open(self, request):
        self.close()
        self.reader, self.writer = await asyncio.open_connection("127.0.0.1", self.port)
        self.writer.write(request)
        return await self.reader.readuntil(b"\r\n\r\n")

    async def get(self, path):
        request = f"GET {path} HTTP/1.1\r\nHost: localhost\r\n\r\n".encode()
        head = None
        if self.writer:
            try:
                self.writer.write(request)
                head = await self.reader.readuntil(b"\r\n\r\n")
            except (asyncio.IncompleteReadError, ConnectionError):
                pass
        head = head or await self.open(request)
        length = int(re.search(rb"(?i)content-length: (\d+)", head).group(1))
        body = await self.reader.readexactly(length)
        if b" 200 " not in head.split(b"\r\n", 1)[0]:
            raise AssertionError(f"{path}: {head.splitlines()[0]!r} {body[:300]!r}")
        return body

    def close(self):
        if self.writer:
            self.writer.close()
        self.reader = self.writer = None


async def listen(port, events):
    """An event listener: counts what it is told."""
    connection = Connection(port)
    try:
        head = await connection.open(b"GET /events HTTP/1.1\r\nHost: localhost\r\n\r\n")
        assert b" 200 " in head, head
        me = len(events)
        events.append(0)
        while piece := await connection.reader.read(65536):
            events[me] += piece.count(b"event: ")
        raise AssertionError("a listener was cut off")
    finally:
        connection.close()


async def look_around(port, seed, latencies):
    """A map that is looked at from the world down to a street, at cities and beside them."""
    choice = random.Random(seed)
    connection = Connection(port)
    try:
        while True:
            zoom = choice.randrange(DEEPEST)
            size = 1 << zoom
            x, y = [min(size - 1, max(0, int(place * size) + choice.randrange(-1, 2))) for place in choice.choice(CITIES)]
            begin = time.perf_counter()
            body = await connection.get(f"/tiles/{zoom}/{x}/{y}.png?blur={choice.choice((0, 2))}")
            latencies.append((time.perf_counter() - begin, zoom))
            assert body.startswith(b"\x89PNG"), body[:20]
            await asyncio.sleep(choice.expovariate(options.tiles))
    finally:
        connection.close()


async def open_pages(port, times):
    """Milliseconds until the page can be used, for a browser that opens it so many times."""
    program = await asyncio.create_subprocess_exec("node", str(HERE.parent / "browser" / "interactive.mjs"), f"http://127.0.0.1:{port}",
                                                   str(times), stdout=subprocess.PIPE)
    out, _ = await program.communicate()
    assert program.returncode == 0, "the page was not ready"
    return [float(line) for line in out.split()]


def quantile(values, part):
    return sorted(values)[min(len(values) - 1, int(part * len(values)))]


def milliseconds(values):
    return ", ".join(f"{name} {quantile(values, part) * 1e3:.1f}" for name, part in (("p50", 0.5), ("p99", 0.99), ("max", 1))) + " ms"


def show(title, now):
    print(f"{title}: {now['records']:,} records, {now['rate']:,.0f} arrivals/s, {now['resident'] / 1e9:.2f} GB", flush=True)
    for name, what in (("insert", "wall"), ("insert_cpu", "processor")):
        figures = now[name]
        print(f"  a batch, {what} time: p50 {figures['p50']:.0f} us, p99 {figures['p99']:.0f} us, max {figures['max']:.0f} us "
              f"({figures['batches']:,} batches)", flush=True)
    if now["cold"]:
        print(f"  database: {now['cold']['records']:,} records, {now['cold']['queued']:,} queued, waited for {now['cold']['waits']} times",
              flush=True)


def show_tiles(latencies):
    print(f"tiles: {len(latencies):,}: {milliseconds([seconds for seconds, _ in latencies])}")
    for first, last in ((0, 3), (4, 8), (9, DEEPEST - 1)):
        some = [seconds for seconds, zoom in latencies if first <= zoom <= last]
        if some:
            print(f"  zoom {first}..{last}: {milliseconds(some)}", flush=True)


def seconds_used(who):
    usage = resource.getrusage(who)
    return usage.ru_utime + usage.ru_stime


async def measure(server, port):
    statistics = Connection(port)

    async def stats():
        return json.loads(await statistics.get("/stats"))

    begin = time.monotonic()
    while (await stats())["source"]["state"] != "live":
        await asyncio.sleep(0.5)
    print(f"filled in {time.monotonic() - begin:.0f} s", flush=True)
    await asyncio.sleep(options.seconds)
    alone = await stats()
    show("alone", alone)

    events, latencies = [], []
    used, since = seconds_used(resource.RUSAGE_SELF), time.monotonic()
    clients = [asyncio.create_task(listen(port, events)) for _ in range(options.listeners)]
    clients += [asyncio.create_task(look_around(port, i, latencies)) for i in range(options.maps)]
    await beside(clients, asyncio.sleep(options.seconds))
    busy = await stats()
    used = (seconds_used(resource.RUSAGE_SELF) - used) / (time.monotonic() - since)
    assert busy["listeners"] >= options.listeners == len(events), busy["listeners"]
    assert min(events, default=1) > 0, "a listener was told nothing"
    show(f"with {busy['listeners']} listeners and {options.maps} maps", busy)
    show_tiles(latencies)
    print(f"events: {sum(events):,}; these clients took {100 * used:.0f} % of a core")
    for name, what in (("insert", "wall"), ("insert_cpu", "processor")):
        print(f"the insert's p99 with clients over that without, {what} time: {busy[name]['p99'] / alone[name]['p99']:.2f}", flush=True)
    if options.page:
        latencies.clear()
        times = await beside(clients, open_pages(port, options.page))
        print("beside them a browser: the page can be used after " + ", ".join(f"{ms:.0f}" for ms in times) + " ms")
        show_tiles(latencies)
    for task in clients:
        task.cancel()
    await asyncio.gather(*clients, return_exceptions=True)
    statistics.close()


async def beside(clients, work):
    """What `work` answers, unless a client fails before."""
    task = asyncio.create_task(work)
    done, _ = await asyncio.wait([task, *clients], return_when=asyncio.FIRST_COMPLETED)
    for first in done:
        first.result()
    return task.result()


with tempfile.TemporaryDirectory() as folder:
    command = [options.program, "--port", "0", "--rate", str(options.rate), "--horizon", str(options.records / options.rate),
               "--listeners", str(options.listeners + 8)]
    if options.keep:
        command += ["--data", folder, "--keep", "86400"]
    server = subprocess.Popen(command, stdout=subprocess.PIPE, text=True)
    try:
        asyncio.run(measure(server, int(re.search(r":(\d+)  ", server.stdout.readline()).group(1))))
    finally:
        server.send_signal(signal.SIGTERM)
        status = server.wait(PATIENCE)
    sys.exit(status)
