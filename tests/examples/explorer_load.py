#!/usr/bin/env python3
"""The explorer under load: tests/examples/explorer_load.py PROGRAM [--records N] [--rate N] [--listeners N] [--seconds N]

Fills a window, measures the writer alone, then with event listeners and map clients, and prints tile latencies and the ratio of
the insert's p99 with clients to that without. Wall times are those of a machine that also runs the clients."""
import argparse
import http.client
import json
import random
import re
import signal
import socket
import subprocess
import threading
import time

options = argparse.ArgumentParser()
options.add_argument("program")
options.add_argument("--records", type=int, default=10_000_000)
options.add_argument("--rate", type=int, default=20_000)
options.add_argument("--listeners", type=int, default=100)
options.add_argument("--clients", type=int, default=2, help="threads that ask for tiles")
options.add_argument("--tiles", type=float, default=20, help="tiles a second of each of them")
options.add_argument("--seconds", type=int, default=65, help="of each measurement; statistics are of the last minute")
options = options.parse_args()

window = options.records / options.rate
server = subprocess.Popen([options.program, "--port", "0", "--rate", str(options.rate), "--horizon", str(window)], stdout=subprocess.PIPE, text=True)
port = int(re.search(r":(\d+)  ", server.stdout.readline()).group(1))


def stats():
    connection = http.client.HTTPConnection("127.0.0.1", port, timeout=60)
    connection.request("GET", "/stats")
    answer = json.load(connection.getresponse())
    connection.close()
    return answer


def show(title, now):
    parts = [f"{name}: p50 {now[name]['p50']:.0f} us, p99 {now[name]['p99']:.0f} us, max {now[name]['max']:.0f} us" for name in ("insert", "insert_cpu")]
    print(f"{title}: {now['records']:,} records, {now['rate']:,.0f} arrivals/s, {now['bytes'] / 1e9:.2f} GB; {'; '.join(parts)}", flush=True)


def listen(events, stop):
    connection = socket.create_connection(("127.0.0.1", port), 60)
    connection.sendall(b"GET /events HTTP/1.1\r\nHost: localhost\r\n\r\n")
    connection.settimeout(1)
    while not stop.is_set():
        try:
            piece = connection.recv(65536)
        except TimeoutError:
            continue
        if not piece:
            break
        events.append(piece.count(b"event: "))
    connection.close()


def ask_tiles(seed, latencies, stop):
    """A map that is looked at from the world down to a street, cities more often than not."""
    choice = random.Random(seed)
    places = [(0.5226, 0.3449), (0.2056, 0.3758), (0.8881, 0.3938), (0.4996, 0.3325), (0.7147, 0.4182)]  # mercator x, y of large cities
    connection = http.client.HTTPConnection("127.0.0.1", port, timeout=60)
    while not stop.is_set():
        zoom = choice.randrange(0, 15)
        x, y = choice.choice(places)
        size = 1 << zoom
        tile = [min(size - 1, max(0, int(place * size) + choice.randrange(-1, 2))) for place in (x, y)]
        begin = time.perf_counter()
        connection.request("GET", f"/tiles/{zoom}/{tile[0]}/{tile[1]}.png?scale=log&blur={choice.choice((0, 2))}")
        answer = connection.getresponse()
        answer.read()
        assert answer.status == 200, answer.status
        latencies.append(time.perf_counter() - begin)
        time.sleep(choice.expovariate(options.tiles))


def quantile(values, part):
    return sorted(values)[min(len(values) - 1, int(part * len(values)))]


try:
    begin = time.monotonic()
    while stats()["source"]["state"] != "live":
        time.sleep(1)
    print(f"filled in {time.monotonic() - begin:.0f} s", flush=True)
    time.sleep(options.seconds)
    alone = stats()
    show("alone", alone)
    stop, events, latencies = threading.Event(), [], []
    threads = [threading.Thread(target=listen, args=(events, stop)) for _ in range(options.listeners)]
    threads += [threading.Thread(target=ask_tiles, args=(i, latencies, stop)) for i in range(options.clients)]
    for thread in threads:
        thread.start()
    time.sleep(options.seconds)
    busy = stats()
    stop.set()
    for thread in threads:
        thread.join()
    show(f"with {busy['listeners']} listeners and {options.clients} maps", busy)
    print(f"tiles: {len(latencies)}, p50 {quantile(latencies, 0.5) * 1e3:.1f} ms, p99 {quantile(latencies, 0.99) * 1e3:.1f} ms, "
          f"max {max(latencies) * 1e3:.1f} ms; events: {sum(events):,}")
    for name in ("insert", "insert_cpu"):
        print(f"{name}: p99 with clients over p99 without: {busy[name]['p99'] / alone[name]['p99']:.2f}")
finally:
    server.send_signal(signal.SIGTERM)
    server.wait(60)
