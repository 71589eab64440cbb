// JavaScript functions as callbacks of the library. They run on the thread they belong to, so only calls on this thread call them.
import koffi from 'koffi';
import { CALLBACKS } from './interface.js';

const TYPES = new Map();

/** The koffi type of a callback, such as locus_filter_fn. */
export function callbackType(kind) {
  let type = TYPES.get(kind);
  if (!type) {
    const [result, parameters] = CALLBACKS[kind];
    type = koffi.pointer(koffi.proto(kind, result, parameters));
    TYPES.set(kind, type);
  }
  return type;
}

/** The callbacks of one call, or of one object, and the first thing that one of them threw. */
export class Callbacks {
  #pointers = [];
  #thrown = [];
  #users = 1;

  /** How many functions there are. */
  get size() {
    return this.#pointers.length;
  }

  /** Whether a function has thrown. */
  get failed() {
    return this.#thrown.length > 0;
  }

  /**
   * Make a function a callback.
   * @param {string} kind its C type
   * @param {Function} run given what the library says, it returns what the library is told
   * @param {number|bigint|undefined} stop what the library is told where it throws, and from then on
   * @returns {bigint} the address for the library
   */
  add(kind, run, stop) {
    const thrown = this.#thrown;
    // Nothing may be thrown through the library's frames.
    const guarded = (...args) => {
      if (thrown.length > 0) return stop;
      try {
        return run(...args);
      } catch (error) {
        thrown.push(error);
        return stop;
      }
    };
    const pointer = koffi.register(guarded, callbackType(kind));
    this.#pointers.push(pointer);
    return pointer;
  }

  /** Throw what a callback has thrown. */
  rethrow() {
    if (this.#thrown.length > 0) throw this.#thrown.splice(0)[0];
  }

  /** One more object whose calls may call them. */
  retain() {
    this.#users += 1;
    return this;
  }

  /** One object less; behind the last one the library must not call them any more. */
  release() {
    this.#users -= 1;
    if (this.#users > 0) return;
    for (const pointer of this.#pointers.splice(0)) koffi.unregister(pointer);
  }
}

/** The answer of a function that may stop a call: false stops. */
export const stopsAtFalse = (answer) => (answer === false ? 1 : 0);
