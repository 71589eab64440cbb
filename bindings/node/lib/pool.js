// Workers, threads with an interpreter of their own: each makes one call of the library at a time and fetches the text of its error
// there, on the thread it belongs to. They see this thread's memory by its addresses.
import { availableParallelism, cpus } from 'node:os';
import { Worker } from 'node:worker_threads';
import { FUNCTIONS } from './interface.js';
import { refusal } from './errors.js';
import { pathsFor } from './library.js';
import { addressOf } from './struct.js';

const CORES = availableParallelism?.() ?? cpus().length;
/** Most workers: calls that wait for the disk leave room for others. */
const MOST = Math.max(2, Math.min(CORES, 8));

const CANCEL = 0;
const members = [];
const waiting = [];

/** One worker. */
class Member {
  #worker;
  #ready;
  #control = new Int32Array(new SharedArrayBuffer(4));
  job = null;
  queue = [];

  constructor() {
    this.#worker = new Worker(new URL('./worker.js', import.meta.url), { workerData: { control: this.#control }, execArgv: [] });
    this.#ready = new Promise((resolve, reject) => {
      this.#worker.once('message', resolve);
      this.#worker.once('error', reject);
    });
    // Whoever waits for it is told; nobody may.
    this.#ready.catch(() => {});
    this.#worker.on('error', (error) => this.#ended(error));
    this.#worker.unref();
  }

  /** Make a call; the worker keeps the process alive meanwhile. */
  async start(job) {
    this.job = job;
    this.#worker.ref();
    try {
      const { progress } = await this.#ready;
      if (job.work.signal?.aborted) return this.finish(() => job.reject(job.work.signal.reason));
      this.#worker.on('message', job.told = (message) => this.#told(job, message));
      job.work.signal?.addEventListener('abort', job.cancel = () => this.cancel());
      job.work.prepare?.(progress);
      const args = job.call.args.map((one) => (one === job.progress ? progress : ArrayBuffer.isView(one) ? addressOf(one) : one));
      this.#worker.postMessage({ name: job.call.name, args, paths: pathsFor(FUNCTIONS[job.call.name][0]) });
    } catch (error) {
      this.finish(() => job.reject(error));
    }
    return undefined;
  }

  cancel() {
    Atomics.store(this.#control, CANCEL, 1);
  }

  #told(job, message) {
    if ('fraction' in message) this.#progress(job, message.fraction);
    else this.finish(() => (message.thrown ? job.reject(new TypeError(message.thrown)) : job.resolve(message)));
  }

  #progress(job, fraction) {
    if (job.failed) return;
    try {
      if (job.work.report(fraction)) this.cancel();
    } catch (error) {
      job.failed = { error };
      this.cancel();
    }
  }

  /** The job is done: go on with the next one. */
  finish(settle) {
    const { job } = this;
    this.job = null;
    Atomics.store(this.#control, CANCEL, 0);
    this.#worker.unref();
    if (job.told) this.#worker.off('message', job.told);
    if (job.cancel) job.work.signal.removeEventListener('abort', job.cancel);
    if (job.failed) job.reject(job.failed.error);
    else settle();
    const next = this.queue.shift() ?? waiting.shift();
    if (next) this.start(next);
  }

  /** The worker has ended, which only an error of this package can make it do. */
  #ended(error) {
    members.splice(members.indexOf(this), 1);
    const failed = refusal('INTERNAL', `a worker has ended: ${error.message}`);
    const jobs = [this.job, ...this.queue.splice(0)].filter(Boolean);
    this.job = null;
    for (const job of jobs) job.reject(failed);
    const next = waiting.shift();
    if (next) dispatch(next);
  }

  static {
    // A process that exits waits for its workers: let those stop that can.
    process.on('exit', () => members.forEach((member) => member.cancel()));
  }
}

/** A worker that is idle, or a new one, or none where there are enough. */
function free() {
  const idle = members.find((member) => member.job === null && member.queue.length === 0);
  if (idle || members.length >= MOST) return idle;
  const fresh = new Member();
  members.push(fresh);
  return fresh;
}

/** Give a job to the worker that its object is bound to, or to any. */
function dispatch(job) {
  const bound = job.work.worker;
  if (bound !== undefined && !members.includes(bound)) {
    job.reject(refusal('STATE', `${job.work.method}: the worker that the object is bound to has ended`));
    return;
  }
  const member = bound ?? free();
  if (!member) waiting.push(job);
  else if (member.job) member.queue.push(job);
  else member.start(job);
}

/**
 * Make a call on a worker.
 * @param {import('./call.js').Work} work what it is part of; runs on `work.worker` where that is set
 * @param {{name: string, args: unknown[]}} call
 * @param {symbol} progress stands for the worker's progress callback among the arguments
 * @returns {Promise<{status: number, text?: string, code?: string}>}
 */
export function run(work, call, progress) {
  return new Promise((resolve, reject) => {
    dispatch({ work, call, progress, resolve, reject });
  });
}

/** Choose the worker of all calls of `work`, for an object that is bound to it. */
export function bind(work) {
  work.worker = free() ?? members[0];
}
