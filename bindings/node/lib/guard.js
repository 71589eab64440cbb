// Keep calls apart that the library does not allow beside each other: while a promise's call is at work on an object, or from within a
// callback, another one could come. Instead of a crash that is a BusyError.
import { refusal } from './errors.js';

/** Any number of readers, or one writer, of what a name says. */
export class Guard {
  #name;
  #readers = 0;
  #writing = false;

  constructor(name) {
    this.#name = name;
  }

  get idle() {
    return !this.#writing && this.#readers === 0;
  }

  #enter(writing) {
    if (this.#writing || (writing && this.#readers > 0)) {
      throw refusal('BUSY', `${this.#name}: another call is at work on it that excludes this one`);
    }
    if (writing) this.#writing = true;
    else this.#readers += 1;
    return () => {
      if (writing) this.#writing = false;
      else this.#readers -= 1;
    };
  }

  /** Enter several guards, some to read and some to write, or none; returns what leaves them. */
  static enter({ reading = [], writing = [] }) {
    const leave = [];
    try {
      for (const guard of reading) leave.push(guard.#enter(false));
      for (const guard of writing) leave.push(guard.#enter(true));
    } catch (error) {
      for (const one of leave) one();
      throw error;
    }
    return () => {
      for (const one of leave) one();
    };
  }
}
