// An explorer server of the test's own, on a free port.
import { spawn } from 'node:child_process';
import { once } from 'node:events';
import { defer } from './defer.mjs';

const START_MS = 60000;

// A test that is ended from outside leaves no server behind.
process.once('SIGTERM', () => process.exit(143));

const lines = (records) => records.map((record) => `${JSON.stringify(record)}\n`).join('');

export class Explorer {
  // `args`: of the program; it is stopped when the test `t` ends.
  static async start(t, args, port = 0) {
    const server = new Explorer();
    server.process = spawn(process.env.EXPLORER, ['--port', String(port), ...args], { stdio: 'pipe' });
    defer(t, () => server.stop());
    process.once('exit', () => server.process.kill());
    server.url = await server.address();
    return server;
  }

  // What it prints names the address that it serves.
  address() {
    return new Promise((resolve, reject) => {
      let output = '';
      const timer = setTimeout(() => reject(new Error(`no address within ${START_MS} ms: ${output}`)), START_MS);
      const read = (bytes) => {
        output += bytes;
        const found = output.match(/http:\/\/127\.0\.0\.1:\d+/);
        if (!found) return;
        clearTimeout(timer);
        resolve(found[0]);
      };
      this.process.stdout.on('data', read);
      this.process.stderr.on('data', read);
      this.process.on('exit', (status) => reject(new Error(`the server ended with ${status}: ${output}`)));
    });
  }

  async stop() {
    if (this.process.exitCode !== null || this.process.signalCode !== null) return;
    this.process.kill('SIGTERM');
    await once(this.process, 'exit');
  }

  get port() {
    return Number(new URL(this.url).port);
  }

  async get(path) {
    const answer = await fetch(this.url + path);
    if (!answer.ok) throw new Error(`${path}: ${answer.status} ${await answer.text()}`);
    return answer.json();
  }

  // Write records to its standard input, which it reads with --json -.
  feed(records) {
    this.process.stdin.write(lines(records));
  }

  // Store records; they can be asked for when this returns.
  async ingest(records) {
    const body = lines(records);
    const answer = await fetch(`${this.url}/ingest`, { method: 'POST', headers: { 'Content-Type': 'application/x-ndjson' }, body });
    if (!answer.ok) throw new Error(`/ingest: ${answer.status} ${await answer.text()}`);
    return answer.json();
  }
}

// Records around a place, `gap` degrees from each other along a diagonal, a second apart, the last one now.
export const around = ({ lat, lon, count, gap = 0.001, text = (i) => `post ${i}` }) => {
  const now = Date.now() * 1000;
  return Array.from({ length: count }, (_, i) =>
    ({ time: now - (count - i) * 1e6, lat: lat + (i - count / 2) * gap, lon: lon + (i - count / 2) * gap, text: text(i) }));
};
