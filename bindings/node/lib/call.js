// Running what a method does, on this thread or as a promise with its calls on a worker. A method is written once, as a generator that
// yields a Call for each call of the library and gets its result back.
import { errorFor, refusal } from './errors.js';
import { Callbacks, stopsAtFalse } from './callbacks.js';
import { Guard } from './guard.js';
import { native } from './library.js';
import { run as runOnWorker } from './pool.js';
import { Struct } from './struct.js';
import { callable } from './values.js';

/** Stands for the address of the callback that reports progress, among the arguments of a call. */
export const PROGRESS = Symbol('progress');

/** What one method does: how its calls run, and what they call back. */
export class Work {
  callbacks = new Callbacks();
  worker = undefined;
  #used = [];

  /**
   * @param {string} method for texts, such as Store.count
   * @param {boolean} here whether calls run on this thread
   */
  constructor(method, here) {
    this.method = method;
    this.here = here;
  }

  /** A function that one call calls back. */
  callback(kind, run, stop) {
    this.#onlyHere(true, 'a function is called');
    return this.callbacks.add(kind, run, stop);
  }

  /** Functions of an object that this call may call. */
  uses(callbacks) {
    this.#onlyHere(callbacks.size > 0, 'functions that were given to the object are called');
    this.#used.push(callbacks);
  }

  #onlyHere(needed, what) {
    if (needed && !this.here) {
      throw refusal('UNSUPPORTED', `${this.method}: ${what}, which only happens on the thread they belong to: use ${this.method}Sync`);
    }
  }

  /** Take the options `progress` and `signal` of a method, and see whether it is cancelled already. */
  listen({ progress, signal } = {}) {
    this.progress = callable(progress, 'progress');
    this.signal = signal;
    signal?.throwIfAborted();
  }

  /** Told how far a call is; whether it shall stop. */
  report(fraction) {
    return stopsAtFalse(this.signal?.aborted ? false : this.progress?.(fraction));
  }

  /** The address for PROGRESS on this thread. */
  progressHere() {
    if (!this.progress && !this.signal) return null;
    return this.callbacks.add('locus_progress_fn', (fraction) => this.report(fraction), 1);
  }

  /** Let a field of a struct point at the callback that reports progress, on the thread that makes the call. */
  progressField(struct, field) {
    this.prepare = (address) => struct.set({ [field]: address });
  }

  /** Throw what was thrown by a callback, or tells that it was cancelled. */
  settle(result) {
    for (const one of [this.callbacks, ...this.#used]) one.rethrow();
    if (result.status !== 0 && this.signal?.aborted) this.signal.throwIfAborted();
  }
}

/** One call of the library and its arguments: numbers, texts, addresses, typed arrays, structs, PROGRESS, or null. */
export function call(name, ...args) {
  return { name, args: args.map((one) => (one instanceof Struct ? one.bytes : one)) };
}

/** Make a call, and throw where it fails. */
export function* must(name, ...args) {
  return check(yield call(name, ...args));
}

/** Throw the error of a result; returns it where there is none. */
export function check(result) {
  if (result.status !== 0) throw errorFor(result.status, result.text, result.code);
  return result;
}

/** Make a call on this thread. */
function callHere(work, { name, args }) {
  const needed = work.prepare || args.includes(PROGRESS);
  const progress = needed ? work.progressHere() : null;
  work.prepare?.(progress);
  const result = native.call(name, args.map((one) => (one === PROGRESS ? progress : one)));
  work.settle(result);
  return result;
}

/** Do it on this thread. */
export function here(method, body) {
  const work = new Work(method, true);
  try {
    const steps = body(work);
    let step = steps.next();
    while (!step.done) step = resumed(steps, () => callHere(work, step.value));
    return step.value;
  } finally {
    work.callbacks.release();
  }
}

/** Go on with the result of a call, or with what it threw. */
function resumed(steps, result) {
  let value;
  try {
    value = result();
  } catch (error) {
    return steps.throw(error);
  }
  return steps.next(value);
}

/** Do it with the calls on a worker. */
export async function away(method, body) {
  const work = new Work(method, false);
  const steps = body(work);
  let step = steps.next();
  while (!step.done) {
    let outcome;
    try {
      const result = await runOnWorker(work, step.value, PROGRESS);
      work.settle(result);
      outcome = () => result;
    } catch (error) {
      outcome = () => {
        throw error;
      };
    }
    step = resumed(steps, outcome);
  }
  return step.value;
}

/** An options struct with its defaults, by the function that gives it these, and the values given; undefined leaves a default. */
export function options(init, values) {
  const made = new Struct(init.replace(/_init$/, ''));
  check(native.call(init, [made.bytes, made.bytes.length]));
  return values ? made.set(values) : made;
}

/** Fill a struct by a call that cannot take long, and read it as an object. */
export function filled(struct, name, ...args) {
  const into = new Struct(struct);
  check(native.call(name, [...args, into.bytes]));
  return into.read();
}

/** A call that cannot take long, on this thread. */
export function quick(name, ...args) {
  return check(native.call(name, call(name, ...args).args));
}

/** What an object keeps for the others of this package: its guard, its callbacks, its handle. */
export const INNER = Symbol('inner');

/** What a constructor takes instead of options where the object was made already. */
export class Made {
  constructor(made) {
    this.made = made;
  }
}

/** Do something between entering guards and leaving them. */
export function* guarded(guards, body) {
  const leave = Guard.enter(guards);
  try {
    return yield* body();
  } finally {
    leave();
  }
}

/** Memory for one number of 64 bits that a call stores. */
export const number64 = () => new BigUint64Array(new ArrayBuffer(8));

/** What `using` calls; Node.js 18 may not have it. */
export const DISPOSE = Symbol.dispose ?? Symbol.for('Symbol.dispose');

/** A handle with its end: freed when the object is disposed of, or else when it is collected. */
export class Handle {
  static #registry = new FinalizationRegistry((end) => end());
  #address;
  #end;

  /**
   * @param {object} owner whose end is the handle's
   * @param {string} destroy the function that ends it
   * @param {bigint} address
   * @param {Callbacks} [callbacks] that go with it
   */
  constructor(owner, destroy, address, callbacks) {
    this.#address = address;
    let ended = false;
    this.#end = () => {
      if (ended) return;
      ended = true;
      native.get(destroy)(address);
      callbacks?.release();
    };
    Handle.#registry.register(owner, this.#end, this);
  }

  /** The address; an error where the object was disposed of. */
  get address() {
    if (this.#address === 0n) throw refusal('STATE', 'the object was disposed of');
    return this.#address;
  }

  dispose() {
    Handle.#registry.unregister(this);
    this.#address = 0n;
    this.#end();
  }
}
