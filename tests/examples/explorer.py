#!/usr/bin/env python3
"""The explorer's HTTP interface from end to end, good input and bad: tests/examples/explorer.py PROGRAM [WRAPPER...]

Answers are compared with brute force over the records that were posted. WRAPPER runs the program (Valgrind)."""
import atexit
import http.client
import json
import math
import os
import random
import re
import signal
import socket
import struct
import subprocess
import sys
import tempfile
import time
import unittest
import zlib

PROGRAM, *WRAPPER = sys.argv[1:]
PATIENCE = 120 if WRAPPER else 20
NDJSON = "application/x-ndjson"
EARTH = 6371008.7714
NASTY = ["<script>alert(1)</script>", "\"><img src=x onerror=alert(2)>", "\u0000\u0001\u001b[31m\u007f", "\u202eright to left",
         "a\u2028b", "']}]};--", "\ud83d\ude00 caf\u00e9", "x" * 139 + "\u00e9"]


class Server:
    """A running explorer on a free port."""

    def __init__(self, *options, stdin=subprocess.DEVNULL, env=None):
        command = WRAPPER + [PROGRAM, "--port", "0", *options]
        self.process = subprocess.Popen(command, stdin=stdin, stdout=subprocess.PIPE, text=True, env=env)
        atexit.register(self.process.kill)  # a test that fails leaves it running
        line = self.process.stdout.readline()
        found = re.search(r":(\d+)  ", line)
        if not found:
            raise RuntimeError("no port in: " + line)
        self.port = int(found.group(1))

    def ask(self, path, method="GET", body=None, **headers):
        connection = http.client.HTTPConnection("127.0.0.1", self.port, timeout=PATIENCE)
        try:
            connection.request(method, path, body, {name.replace("_", "-"): value for name, value in headers.items()})
            answer = connection.getresponse()
            return answer.status, answer.headers, answer.read()
        finally:
            connection.close()

    def json(self, path, status=200, **more):
        got, _, body = self.ask(path, **more)
        if got != status:
            raise AssertionError(f"{path}: {got} {body[:300]!r}, not {status}")
        return json.loads(body)

    def ingest(self, records, query="", status=200, **headers):
        headers.setdefault("Content_Type", NDJSON)
        body = "".join((r if isinstance(r, str) else json.dumps(r)) + "\n" for r in records).encode()
        return self.json("/ingest" + query, status, method="POST", body=body, **headers)

    def pages(self, query):
        found, after = [], None
        for _ in range(100):
            page = self.json("/records?" + query + (f"&after={after}" if after else ""))
            found += page["records"]
            after = page["next"]
            if not after:
                return found
        raise AssertionError("no end of pages")

    def wait(self, good, what):
        end = time.monotonic() + PATIENCE
        while time.monotonic() < end:
            if good():
                return
            time.sleep(0.05)
        raise AssertionError("not in time: " + what)

    def stop(self, number=signal.SIGTERM):
        self.process.send_signal(number)
        status = self.process.wait(PATIENCE)
        rest = self.process.stdout.read()
        self.process.stdout.close()
        return status, rest


def metres(a, b):
    degree = math.pi / 180
    height = math.sin((b[0] - a[0]) * degree / 2)
    width = math.sin((b[1] - a[1]) * degree / 2)
    square = height ** 2 + math.cos(a[0] * degree) * math.cos(b[0] * degree) * width ** 2
    return 2 * EARTH * math.asin(min(1, math.sqrt(square)))


def as_float32(number):
    return struct.unpack("f", struct.pack("f", number))[0]


def pixels(png):
    """Width, height, and the palette index and alpha of each pixel of an indexed PNG without interlace."""
    assert png[:8] == b"\x89PNG\r\n\x1a\n", png[:8]
    place, data, alpha = 8, b"", b""
    while place < len(png):
        size, kind = struct.unpack(">I4s", png[place:place + 8])
        chunk = png[place + 8:place + 8 + size]
        if kind == b"IHDR":
            width, height, depth, colour = struct.unpack(">IIBB", chunk[:10])
        data += chunk if kind == b"IDAT" else b""
        alpha = chunk if kind == b"tRNS" else alpha
        place += 12 + size
    assert colour == 3, colour
    raw, row, rows = zlib.decompress(data), width * depth // 8, []
    for y in range(height):
        assert raw[y * (row + 1)] == 0 or rows or raw[0] in range(5)
        rows.append(unfilter(raw[y * (row + 1)], raw[y * (row + 1) + 1:(y + 1) * (row + 1)], rows[-1] if rows else bytes(row)))
    per_byte = 8 // depth
    mask = (1 << depth) - 1
    indices = [[rows[y][x // per_byte] >> (8 - depth - x % per_byte * depth) & mask for x in range(width)] for y in range(height)]
    return indices, [[alpha[i] if i < len(alpha) else 255 for i in line] for line in indices]


def unfilter(kind, line, above):
    result = bytearray(line)
    for i in range(len(result)):
        left, up, corner = (result[i - 1] if i else 0), above[i], (above[i - 1] if i else 0)
        if kind == 4:
            guess = left + up - corner
            best = min((abs(guess - left), 0, left), (abs(guess - up), 1, up), (abs(guess - corner), 2, corner))[2]
        else:
            best = (0, left, up, (left + up) // 2)[kind]
        result[i] = (result[i] + best) & 255
    return bytes(result)


class Answers(unittest.TestCase):
    """Queries against brute force, on records that stay."""

    @classmethod
    def setUpClass(cls):
        cls.server = Server("--empty", "--horizon", "0")
        choice = random.Random(7)
        cls.now = int(time.time()) * 1000000
        cls.records = []
        for i in range(1500):
            centre = choice.choice([(48.85, 2.35), (-36.8, 179.9), (89.9, 10), (0, 0)])
            lat = max(-90, min(90, choice.gauss(centre[0], 2)))
            lon = (choice.gauss(centre[1], 3) + 180) % 360 - 180
            text = NASTY[i % len(NASTY)] if i % 5 == 0 else f"post number{chr(97 + i % 7) * 3} {i}"
            cls.records.append({"time": cls.now - choice.randrange(3600) * 1000000, "lat": as_float32(lat), "lon": as_float32(lon), "text": text})
        for begin in range(0, 1500, 500):
            batch = [dict(r, time=r["time"] / 1e6) for r in cls.records[begin:begin + 500]]
            answer = cls.server.ingest(batch)
            assert answer["stored"] == 500 and answer["bad"] == 0, answer

    @classmethod
    def tearDownClass(cls):
        status, rest = cls.server.stop()
        assert status == 0 and "stopped" in rest, (status, rest)

    def inside(self, good):
        return [r for r in self.records if good(r)]

    def test_count(self):
        ask = lambda query: self.server.json("/count?" + query)["count"]
        self.assertEqual(ask(""), 1500)
        self.assertEqual(ask("box=47,1,50,4"), len(self.inside(lambda r: 47 <= r["lat"] <= 50 and 1 <= r["lon"] <= 4)))
        wrap = self.inside(lambda r: -40 <= r["lat"] <= -30 and (r["lon"] >= 178 or r["lon"] <= -178))
        self.assertGreater(len(wrap), 50)
        self.assertEqual(ask("box=-40,178,-30,-178"), len(wrap))
        self.assertEqual(ask("circle=48.85,2.35,100000"), len(self.inside(lambda r: metres((48.85, 2.35), (r["lat"], r["lon"])) <= 1e5)))
        self.assertEqual(ask("circle=90,0,200000"), len(self.inside(lambda r: metres((90, 0), (r["lat"], r["lon"])) <= 2e5)))
        hole = self.inside(lambda r: 46 <= r["lat"] <= 51 and 0 <= r["lon"] <= 5 and not (48 < r["lat"] < 49 and 2 < r["lon"] < 3))
        self.assertEqual(ask("polygon=46,0,46,5,51,5,51,0;48,2,48,3,49,3,49,2"), len(hole))
        middle = self.now - 1800 * 1000000
        self.assertEqual(ask(f"from={middle}"), len(self.inside(lambda r: r["time"] >= middle)))
        self.assertEqual(ask(f"to={middle}&box=47,1,50,4"),
                         len(self.inside(lambda r: r["time"] <= middle and 47 <= r["lat"] <= 50 and 1 <= r["lon"] <= 4)))
        self.assertEqual(ask(f"to={middle}&last=600"), len(self.inside(lambda r: middle - 600 * 1000000 <= r["time"] <= middle)))

    def test_records(self):
        key = lambda r: (r["time"], r["lat"], r["lon"], r["text"])
        wanted = sorted((r["time"], r["lat"], r["lon"]) for r in self.records)
        for order in ("newest", "place"):
            for limit in (1000, 170):
                found = self.server.pages(f"order={order}&limit={limit}")
                self.assertEqual(sorted((r["time"], r["lat"], r["lon"]) for r in found), wanted)
        newest = self.server.pages("box=47,1,50,4&limit=7")
        self.assertEqual([r["time"] for r in newest], sorted((r["time"] for r in newest), reverse=True))
        self.assertEqual(len(set(map(key, newest))), len(newest))

    def test_one_place(self):
        """Many records of one place and one time: pages still show each once."""
        server = Server("--empty", "--horizon", "0")
        moment = self.now / 1e6
        server.ingest([{"time": moment, "lat": 1, "lon": 2, "text": str(i)} for i in range(230)])
        for order in ("newest", "place"):
            found = server.pages(f"order={order}&limit=50")
            self.assertEqual(sorted(int(r["text"]) for r in found), list(range(230)))
        server.stop()

    def test_texts(self):
        texts = {r["text"] for r in self.server.json("/records?limit=1000")["records"]}
        self.assertIn(NASTY[0], texts)
        self.assertIn(NASTY[2].replace("\u0000", " "), texts)
        self.assertIn("x" * 139, texts)  # cut before the character that does not fit
        _, headers, body = self.server.ask("/records?limit=1000")
        self.assertEqual(headers["Content-Type"], "application/json")
        self.assertFalse([b for b in body if b < 0x20])

    def test_topk(self):
        answer = self.server.json("/topk?lat=48.85&lon=2.35&k=20&alpha=0.4&radius=200000&period=3000")
        score = lambda r: 0.4 * metres((48.85, 2.35), (r["lat"], r["lon"])) / 2e5
        self.assertEqual(len(answer["records"]), 20)
        scores = [r["score"] for r in answer["records"]]
        self.assertEqual(scores, sorted(scores))
        for r in answer["records"]:
            self.assertAlmostEqual(r["score"], score(r) + 0.6 * r["age"] / 3000, delta=0.001)
            self.assertAlmostEqual(r["distance"], metres((48.85, 2.35), (r["lat"], r["lon"])), delta=0.01)
        now = answer["now"]
        best = sorted(score(r) + 0.6 * (now - r["time"]) / 3e9 for r in self.records
                      if metres((48.85, 2.35), (r["lat"], r["lon"])) <= 2e5 and now - r["time"] <= 3e9)[:20]
        for ours, theirs in zip(scores, best):
            self.assertAlmostEqual(ours, theirs, delta=0.001)  # the clock goes on between the two
        near = self.server.json("/nearest?lat=-36.8&lon=179.9&k=5")["records"]
        wanted = sorted(metres((-36.8, 179.9), (r["lat"], r["lon"])) for r in self.records)[:5]
        for r, distance in zip(near, wanted):
            self.assertAlmostEqual(r["distance"], distance, delta=0.01)

    def test_aggregate(self):
        answer = self.server.json("/aggregate?by=time&step=600")
        groups = {}
        for r in self.records:
            begin = r["time"] // 600000000 * 600000000
            groups[begin] = groups.get(begin, 0) + 1
        self.assertEqual({g["from"]: g["count"] for g in answer["groups"]}, groups)
        self.assertEqual(answer["total"], 1500)
        cells = {}
        for r in self.records:
            x, y = mercator(r, 6)
            cells[x, y] = cells.get((x, y), 0) + 1
        answer = self.server.json("/aggregate?by=cell&z=6&k=1000")
        self.assertEqual({(g["x"], g["y"]): g["count"] for g in answer["groups"]}, cells)
        counts = [g["count"] for g in answer["groups"]]
        self.assertEqual(counts, sorted(counts, reverse=True))
        top = self.server.json("/aggregate?by=word&k=2")["groups"]
        self.assertEqual(top[0], {"word": "post", "count": sum("post number" in r["text"] for r in self.records)})
        self.server.json("/aggregate?by=time&step=0.5", 400)

    def test_tiles(self):
        totals = [self.server.json(f"/tiles/2/{x}/{y}.json?bins=1")["total"] for x in range(4) for y in range(4)]
        self.assertEqual(sum(totals), 1500)
        bins = [[0] * 256 for _ in range(256)]
        for r in self.records:
            x, y = mercator(r, 9)
            if x // 256 == 1 and y // 256 == 0:
                bins[y % 256][x % 256] += 1
        tile = self.server.json("/tiles/1/1/0.json")
        self.assertEqual(tile["counts"], [count for row in bins for count in row])
        status, headers, png = self.server.ask("/tiles/1/1/0.png?scale=linear")
        self.assertEqual((status, headers["Content-Type"]), (200, "image/png"))
        indices, alphas = pixels(png)
        self.assertEqual((len(indices), len(indices[0])), (256, 256))
        for y in range(256):
            for x in range(256):
                self.assertEqual(alphas[y][x] > 0, bins[y][x] > 0, (x, y))
        _, _, png = self.server.ask("/tiles/20/5/5.png")
        self.assertFalse(any(a for row in pixels(png)[1] for a in row))
        for query in ("map=magma&scale=quantile", "map=viridis&blur=2", "map=grey&bins=16&high=5", "scale=linear&last=60", "blur=4&bins=1"):
            status, _, png = self.server.ask("/tiles/0/0/0.png?" + query)
            self.assertEqual(status, 200)
            pixels(png)

    def test_blur_has_no_seams(self):
        """The heat of a tile with its neighbours': with enough of it everywhere, the halves of a smoothed world fit."""
        one = pixels(self.server.ask("/tiles/0/0/0.png?blur=2&bins=128&high=100")[2])[0]
        four = {(x, y): pixels(self.server.ask(f"/tiles/1/{x}/{y}.png?blur=2&bins=64&high=100")[2])[0] for x in (0, 1) for y in (0, 1)}
        for y in range(128):
            for x in range(128):
                tile = four[x // 64, y // 64]
                self.assertEqual(one[y * 2][x * 2], tile[y % 64 * 4][x % 64 * 4], (x, y))

    def test_etag(self):
        _, headers, png = self.server.ask("/tiles/3/4/2.png")
        tag = headers["ETag"]
        status, again, body = self.server.ask("/tiles/3/4/2.png", If_None_Match=tag)
        self.assertEqual((status, body, again["ETag"]), (304, b"", tag))
        self.assertEqual(self.server.ask("/tiles/3/4/2.png?map=magma", If_None_Match=tag)[0], 200)
        version = int(headers["Locus-Version"])
        self.assertEqual(version, self.server.json("/count")["version"])

    def test_scale(self):
        for kind in ("log", "linear", "quantile"):
            answer = self.server.json(f"/scale?z=4&scale={kind}&map=viridis")
            values = [s["value"] for s in answer["stops"]]
            self.assertEqual(len(values), 9)
            self.assertEqual(values, sorted(values))
            self.assertEqual((values[0], values[-1]), (answer["low"], answer["high"]))
            self.assertTrue(all(re.fullmatch("#[0-9a-f]{6}", s["colour"]) for s in answer["stops"]))
        self.assertEqual(self.server.json("/scale?z=4&high=64")["high"], 64)

    def test_itself(self):
        stats = self.server.json("/stats")
        self.assertEqual((stats["records"], stats["source"]["state"]), (1500, "live"))
        self.assertGreater(stats["insert"]["batches"], 0)
        self.assertIsNone(stats["cold"])
        info = self.server.json("/info")
        self.assertEqual((info["horizon"], info["cold"], info["keep"]), (None, False, None))
        self.assertEqual(self.server.json("/healthz"), {"status": "ok"})
        _, headers, body = self.server.ask("/metrics")
        self.assertTrue(headers["Content-Type"].startswith("text/plain"))
        lines = body.decode().splitlines()
        self.assertIn("locus_records 1500", lines)
        buckets = [float(l.split()[1]) for l in lines if l.startswith("locus_insert_seconds_bucket")]
        self.assertEqual(buckets, sorted(buckets))
        self.assertTrue(all(l.startswith("#") or re.fullmatch(r'[a-z_]+(\{le="[^"]+"\})? \S+', l) for l in lines))

    def test_wrong(self):
        wrong = {"/count?tiers=both": "tiers: both, but nothing is kept", "/count?tiers=all": "tiers: all", "/topk?lat=1&lon=1&tiers=both": "tiers: no such",
                 "/count?lat=1": "lat: no such parameter", "/count?box=1,2,3": "box: 3 numbers", "/count?box=1,2,3,x": "box: x is not a number",
                 "/count?box=91,0,92,1": "outside -90..90", "/count?box=5,0,4,1": "south is greater", "/count?box=1,2,3,nan": "nan is not",
                 "/count?circle=1,2,-1": "radius", "/count?circle=1,2,1e9": "radius", "/count?polygon=1,2,3,4": "ring of 4",
                 "/count?polygon=0,0,1,1,0,1,1,0": "polygon", "/count?box=1,2,3,4&circle=1,2,3": "one of them", "/count?from=x": "from: x",
                 "/count?from=1&from=2": "given 2 times", "/count?from=1&last=2": "from is given", "/count?last=-1": "last: -1",
                 "/count?polygon=" + ",".join(["1"] * 2100): "1000 positions", "/records?limit=0": "limit: 0", "/records?limit=100000": "limit",
                 "/records?order=size": "order: size", "/records?after=zz": "after: zz", "/records?order=place&after=5": "after: 5",
                 "/topk?lon=1": "lat: missing", "/topk?lat=1&lon=1&k=0": "k: 0", "/topk?lat=1&lon=1&alpha=2": "alpha: 2 is outside 0..1",
                 "/topk?lat=1&lon=1&radius=0": "radius", "/topk?lat=91&lon=1": "lat: 91", "/nearest?lat=1": "lon: missing",
                 "/aggregate": "by: missing", "/aggregate?by=time": "step: missing", "/aggregate?by=cell&z=26": "z: 26",
                 "/tiles/1/1/1.png?map=jet": "map: jet is none of", "/tiles/1/1/1.png?bins=3": "bins: 3", "/tiles/1/1/1.png?blur=9": "blur: 9",
                 "/tiles/1/1/1.png?high=0": "high: 0", "/tiles/1/1/1.json?map=magma": "map: no such", "/scale": "z: missing",
                 "/alerts?since=-1": "since: -1", "/ingest?x=%00": "method"}
        for path, text in wrong.items():
            status, headers, body = self.server.ask(path)
            self.assertIn(status, (400, 405), path)
            answer = json.loads(body)
            self.assertEqual(answer["status"], status)
            self.assertIn(text, answer["error"], path)
            self.assertEqual(headers["Content-Type"], "application/json")
        for path in ("/none", "/tiles/26/0/0.png", "/tiles/1/2/0.png", "/tiles/1/0/0.gif", "/tiles/1/0", "/tiles/-1/0/0.png", "/tiles/1/0/0.pngx",
                     "/../main.cpp", "/..%2f..%2fmain.cpp", "/%2e%2e/main.cpp", "/js/../../main.cpp", "/.hidden", "//etc/passwd", "/js/"):
            self.assertIn(self.server.ask(path)[0], (400, 404), path)
        status, headers, _ = self.server.ask("/count", method="DELETE")
        self.assertEqual((status, headers["Allow"]), (405, "GET, HEAD"))
        self.assertEqual(self.server.ask("/count?" + "a" * 9000)[0] in (400, 414), True)

    def test_ingest_refused(self):
        post = lambda body, status, **headers: self.server.json("/ingest", status, method="POST", body=body, **headers)
        before = self.server.json("/count")["count"]
        good = {"time": time.time(), "lat": 1, "lon": 2}
        answer = self.server.ingest([good, {"time": 1, "lat": 91, "lon": 0}, "{"], status=400)
        self.assertIn("line 2", answer["error"])
        self.assertIn("91", answer["error"])
        post("{}", 415, Content_Type="text/plain")
        post("{}", 403, Content_Type=NDJSON, Origin="http://evil.example")
        self.assertEqual(self.server.ingest([])["stored"], 0)
        self.server.ingest([good], query="?bad_lines=maybe", status=400)
        self.assertEqual(self.server.ask("/ingest")[0], 405)
        self.assertEqual(self.server.json("/count")["count"], before)

    def test_headers(self):
        for path in ("/", "/count", "/none", "/tiles/0/0/0.png", "/events?x=1"):
            _, headers, _ = self.server.ask(path, method="HEAD")
            self.assertIn("default-src 'none'", headers["Content-Security-Policy"])
            self.assertNotIn("unsafe", headers["Content-Security-Policy"])
            self.assertEqual(headers["X-Content-Type-Options"], "nosniff")
            self.assertIsNone(headers["Access-Control-Allow-Origin"])
        self.assertEqual(self.server.ask("/count", Host="evil.example")[0], 421)
        self.assertEqual(self.server.ask("/count", Host="localhost:99")[0], 200)
        status, headers, body = self.server.ask("/")
        self.assertEqual((status, headers["Content-Type"]), (200, "text/html; charset=utf-8"))
        self.assertIn(b"<html", body)
        self.assertEqual(self.server.ask("/", If_None_Match=headers["ETag"])[0], 304)


def mercator(record, level):
    """Bin of the world, 2^level bins a side."""
    lat = max(-85.0511287798066, min(85.0511287798066, record["lat"]))
    y = 0.5 - math.asinh(math.tan(math.radians(lat))) / (2 * math.pi)
    size = 1 << level
    return min(size - 1, int((record["lon"] + 180) / 360 * size)), max(0, min(size - 1, int(y * size)))


class Events(unittest.TestCase):
    def listen(self, server):
        connection = socket.create_connection(("127.0.0.1", server.port), PATIENCE)
        connection.sendall(b"GET /events HTTP/1.1\r\nHost: localhost\r\n\r\n")
        return connection

    def until(self, connection, mark):
        text = b""
        while mark not in text:
            piece = connection.recv(65536)
            self.assertTrue(piece, text)
            text += piece
        return text.decode()

    def test_events(self):
        server = Server("--empty", "--listeners", "3")
        listeners = [self.listen(server) for _ in range(3)]
        for one in listeners:
            text = self.until(one, b"event: stats")
            self.assertIn("text/event-stream", text)
            self.assertIn("retry: 2000", text)
        fourth = self.listen(server)
        self.assertIn("503", self.until(fourth, b"}"))
        stored = server.ingest([{"time": time.time(), "lat": 1, "lon": 2, "text": "a\nevent: fake"}])
        for one in listeners:
            self.until(one, b'event: version\ndata: {"version":%d' % stored["version"])
        listeners[0].close()
        server.wait(lambda: server.json("/stats")["listeners"] == 2, "the listener that went away")
        status, _ = server.stop()
        self.assertEqual(status, 0)
        for one in listeners[1:] + [fourth]:
            one.close()

    def test_slow_clients(self):
        """Those who send or read too slowly are cut off, and the others do not notice."""
        server = Server("--empty", "--request-seconds", "1")
        slow = socket.create_connection(("127.0.0.1", server.port), PATIENCE)
        slow.sendall(b"GET /count HTT")
        body = socket.create_connection(("127.0.0.1", server.port), PATIENCE)
        body.sendall(b"POST /ingest HTTP/1.1\r\nHost: localhost\r\nContent-Type: application/x-ndjson\r\nContent-Length: 100\r\n\r\n{")
        self.assertEqual(server.json("/count")["count"], 0)
        for one in (slow, body):
            while one.recv(4096):
                pass
            one.close()
        self.assertEqual(server.stop(signal.SIGINT)[0], 0)


class Sources(unittest.TestCase):
    def test_window(self):
        """Records leave at the horizon, and the version tells."""
        server = Server("--empty", "--horizon", "1.5")
        stored = server.ingest([{"time": time.time() + 1000, "lat": 1, "lon": 2}])  # set to now
        self.assertEqual(server.json("/count")["count"], 1)
        server.wait(lambda: server.json("/count")["count"] == 0, "expiry")
        server.wait(lambda: server.json("/count")["version"] > stored["version"], "a version after the expiry")
        server.stop()

    def test_demo(self):
        server = Server("--rate", "2000", "--prefill", "20", "--horizon", "60")
        server.wait(lambda: server.json("/stats")["source"]["state"] == "live", "the demo stream")
        first = server.json("/stats")
        self.assertGreater(first["records"], 10000)
        server.wait(lambda: server.json("/stats")["records"] > first["records"] + 1000, "more records")
        self.assertEqual(server.stop()[0], 0)

    def test_alerts(self):
        """The bursts in the past that a demo stream begins with are found, and told in order."""
        server = Server("--rate", "30", "--prefill", "5400", "--horizon", "5400")
        server.wait(lambda: server.json("/stats")["source"]["state"] == "live", "the demo stream")
        server.wait(lambda: server.json("/alerts")["last"] > 0, "an alert")
        alerts = server.json("/alerts")["alerts"]
        self.assertEqual([a["id"] for a in alerts], sorted((a["id"] for a in alerts), reverse=True))
        for a in alerts:
            self.assertEqual(a["kind"], "jump")
            self.assertGreater(a["rate"], a["expected"])
            self.assertGreater(len(a["text"]), 5)
            box = a["box"]
            x, y = mercator({"lat": (box["south"] + box["north"]) / 2, "lon": (box["west"] + box["east"]) / 2}, a["z"])
            self.assertEqual((x, y), (a["x"], a["y"]))
        first = alerts[-1]["id"]
        self.assertEqual(server.json(f"/alerts?since={first}")["alerts"], alerts[:-1])
        connection = socket.create_connection(("127.0.0.1", server.port), PATIENCE)
        connection.sendall(b"GET /events HTTP/1.1\r\nHost: localhost\r\nLast-Event-ID: 0\r\n\r\n")
        text = b""
        while b"event: alert" not in text:
            text += connection.recv(65536)
        self.assertIn(b"id: %d\n" % first, text)
        connection.close()
        server.stop()

    def test_file(self):
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, "stream.csv")
            with open(path, "w") as file:
                file.write("when,lat,lon,note\n")
                for i in range(100):
                    file.write(f"{1700000000 + i * 100},10.{i:03},20,row {i}\n")
            server = Server("--csv", path, "--time", "when", "--text", "note", "--speed", "5000", "--horizon", "5000")
            server.wait(lambda: server.json("/stats")["source"]["state"] == "ended", "the end of the file")

            def settled():  # what was read last may still be in the queue, and the figures a moment old
                stats = server.json("/stats")
                return stats["inserted"] == 100 and server.json("/count")["count"] == stats["records"]

            server.wait(settled, "all rows")
            stats = server.json("/stats")
            self.assertLessEqual(stats["now"], 1700009900 * 1000000 + 2000 * 1000000)
            self.assertLess(stats["records"], 60)
            server.stop()
            server = Server("--csv", path)
            server.wait(lambda: server.json("/stats")["source"]["state"] == "failed", "the failure")
            self.assertIn("no column 'time'", server.json("/stats")["source"]["remarks"][0])
            server.stop()

    def test_standard_input(self):
        server = Server("--json", "-", stdin=subprocess.PIPE)
        for i in range(3):
            server.process.stdin.write(json.dumps({"time": 1700000000 + i, "lat": 1, "lon": 2, "text": "row"}) + "\n")
            server.process.stdin.flush()
            server.wait(lambda: server.json("/count")["count"] == i + 1, f"row {i}")
        self.assertEqual(server.stop()[0], 0)  # while the input stays open
        server.process.stdin.close()

    def test_folder(self):
        """What was acknowledged is there again, after an end of any kind."""
        with tempfile.TemporaryDirectory() as parent:
            folder = os.path.join(parent, "window")
            for end in (signal.SIGKILL, signal.SIGTERM, signal.SIGKILL):
                server = Server("--empty", "--data", folder)
                before = server.json("/count")["count"]
                server.ingest([{"time": time.time(), "lat": 1, "lon": 2, "text": f"{before} and {i}"} for i in range(100)])
                self.assertEqual(server.stop(end)[0], 0 if end == signal.SIGTERM else -end)
            server = Server("--empty", "--data", folder)
            texts = [r["text"] for r in server.json("/records?limit=1000")["records"]]
            self.assertEqual(sorted(texts), sorted(f"{b} and {i}" for b in (0, 100, 200) for i in range(100)))
            again = subprocess.run([PROGRAM, "--empty", "--port", "0", "--data", folder], capture_output=True, text=True, timeout=PATIENCE)
            self.assertEqual(again.returncode, 1)
            self.assertIn(folder, again.stderr)
            server.stop()

    def test_older(self):
        """Window and database have every record once together, also after an end of any kind and while they move."""
        with tempfile.TemporaryDirectory() as folder:
            options = ("--empty", "--data", folder, "--horizon", "2", "--keep", "3600", "--save", "1")
            choice, sent = random.Random(11), []
            for end in (signal.SIGKILL, signal.SIGTERM, signal.SIGKILL, signal.SIGKILL):
                server = Server(*options)
                self.assertEqual(server.json("/count?tiers=both")["count"], len(sent))
                for _ in range(6):
                    now = int(time.time() * 1000) * 1000
                    batch = [{"time": now - choice.randrange(2500) * 1000, "lat": as_float32(choice.uniform(40, 60)),
                              "lon": as_float32(choice.uniform(-10, 10)), "text": f"record {len(sent) + i}"} for i in range(200)]
                    server.ingest([dict(r, time=r["time"] / 1e6) for r in batch])
                    sent += batch
                    self.assertEqual(server.json("/count?tiers=both")["count"], len(sent))
                    time.sleep(0.3)
                server.stop(end)
            server = Server(*options)
            server.wait(lambda: server.json("/count")["count"] == 0, "the end of the window")
            server.wait(lambda: server.json("/stats")["cold"]["records"] == len(sent), "all records in the database")
            self.check_older(server, sent)
            server.stop()
            self.check_older_ends(folder)

    def check_older(self, server, sent):
        count = lambda query: server.json("/count?tiers=both&" + query)["count"]
        inside = lambda good: sum(1 for r in sent if good(r))
        middle = sorted(r["time"] for r in sent)[len(sent) // 2]
        self.assertEqual(count(f"to={middle}"), inside(lambda r: r["time"] <= middle))
        self.assertEqual(count(f"from={middle}&box=45,-5,55,5"),
                         inside(lambda r: r["time"] >= middle and 45 <= r["lat"] <= 55 and -5 <= r["lon"] <= 5))
        self.assertEqual(count("circle=50,0,300000"), inside(lambda r: metres((50, 0), (r["lat"], r["lon"])) <= 3e5))
        self.assertEqual(count("polygon=45,-5,45,5,55,5,55,-5;48,-1,48,1,52,1,52,-1"),
                         inside(lambda r: 45 <= r["lat"] <= 55 and -5 <= r["lon"] <= 5 and not (48 < r["lat"] < 52 and -1 < r["lon"] < 1)))
        key = lambda r: (r["time"], r["lat"], r["lon"], r["text"])
        for order in ("newest", "place"):
            found = server.pages(f"tiers=both&order={order}&limit=170")
            self.assertEqual(sorted(map(key, found)), sorted(map(key, sent)))
            if order == "newest":
                self.assertEqual([r["time"] for r in found], sorted((r["time"] for r in sent), reverse=True))
        self.assertEqual(server.json("/records")["records"], [])
        self.assertEqual(server.json("/aggregate?by=cell&z=0&tiers=both")["total"], len(sent))
        stats = server.json("/stats")["cold"]
        self.assertEqual((stats["queued"], stats["removed"], stats["error"]), (0, 0, None))
        self.assertIn(f"locus_cold_records {len(sent)}", server.ask("/metrics")[2].decode().splitlines())
        self.assertEqual(server.json("/healthz"), {"status": "ok", "cold": "ok"})
        info = server.json("/info")
        self.assertEqual((info["cold"], info["keep"]), (True, 3600))
        self.assertIn("circle", server.json("/count?tiers=both&circle=1,2,-1", 400)["error"])

    def check_older_ends(self, folder):
        """Records become too old; a database that is another one, or none, is told at the start."""
        server = Server("--empty", "--data", folder, "--horizon", "1", "--keep", "1")
        server.wait(lambda: server.json("/count?tiers=both")["count"] == 0, "what is too old")
        server.stop()
        start = lambda: subprocess.run([PROGRAM, "--empty", "--port", "0", "--data", folder, "--keep", "1"], capture_output=True, text=True,
                                       timeout=PATIENCE)
        path = os.path.join(folder, "older.db")
        os.remove(path)
        gone = start()
        self.assertEqual(gone.returncode, 1)
        self.assertIn("another file", gone.stderr)
        with open(path, "w") as file:
            file.write("no database" * 100)
        wrong = start()
        self.assertEqual(wrong.returncode, 1)
        self.assertIn(path, wrong.stderr)
        with open(os.path.join(folder, "older.marks"), "w") as file:
            file.write("1 2\n3\n")
        wrong = start()
        self.assertEqual(wrong.returncode, 1)
        self.assertIn("older.marks: line 2", wrong.stderr)

    def test_token(self):
        good = [{"time": time.time(), "lat": 1, "lon": 2}]
        server = Server("--empty", "--bind", "0.0.0.0")
        server.ingest(good, status=403)
        server.stop()
        server = Server("--empty", "--bind", "0.0.0.0", env={**os.environ, "LOCUS_EXPLORER_TOKEN": "secret"})
        server.ingest(good, status=401)
        server.ingest(good, status=401, Authorization="Bearer secre")
        server.ingest(good, status=401, Authorization="Bearer secretsecret")
        self.assertEqual(server.ingest(good, Authorization="Bearer secret")["stored"], 1)
        server.stop()

    def test_body_limit(self):
        server = Server("--empty", "--max-body", "1")
        line = json.dumps({"time": time.time(), "lat": 1, "lon": 2, "text": "x" * 100})
        try:
            status = server.ask("/ingest", method="POST", body=(line + "\n") * 20000, Content_Type=NDJSON)[0]
        except (ConnectionError, http.client.HTTPException):
            status = 413  # cut off while it was still sending
        self.assertEqual(status, 413)
        self.assertEqual(server.json("/count")["count"], 0)
        self.assertEqual(server.ingest([line, "nonsense"], query="?bad_lines=count")["bad"], 1)
        server.stop()

    def test_command_line(self):
        run = lambda *options: subprocess.run([PROGRAM, *options], capture_output=True, text=True, timeout=PATIENCE)
        self.assertIn("--horizon", run("--help").stdout)
        self.assertEqual(run("--no-such").returncode, 2)
        self.assertEqual(run("--port", "70000").returncode, 2)
        self.assertEqual(run("--empty", "--csv", "x").returncode, 2)
        for wrong, told in ((("--keep", "60"), "--data"), (("--data", "x", "--keep", "-1"), "--keep"), (("--data", "x", "--keep-mb", "20"), "--keep"),
                            (("--data", "x", "--keep", "60", "--keep-mb", "3"), "--keep-mb")):
            self.assertEqual(run(*wrong).returncode, 2)
            self.assertIn(told, run(*wrong).stderr)
        wrong = run("--static", "/nowhere", "--port", "0")
        self.assertEqual(wrong.returncode, 1)
        self.assertIn("/nowhere", wrong.stderr)
        server = Server("--empty")
        taken = run("--empty", "--port", str(server.port))
        self.assertEqual(taken.returncode, 1)
        self.assertIn("in use", taken.stderr)
        server.stop()


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1], verbosity=1)
