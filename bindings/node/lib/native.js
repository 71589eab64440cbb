// The functions of the libraries, as koffi calls them: for the main thread and for the workers alike.
import koffi from 'koffi';
import { FUNCTIONS } from './interface.js';

/** The functions that tell what went wrong. */
const TEXTS = { liblocus: 'locus_last_error', liblocus_io: 'locus_io_last_error', liblocus_cold: 'locus_cold_last_error' };

/** Opens a library when one of its functions is first asked for, and declares each function once. */
export class Native {
  #open;
  #libraries = new Map();
  #functions = new Map();

  /** @param {(name: string) => string} open the path of liblocus, liblocus_io or liblocus_cold */
  constructor(open) {
    this.#open = open;
  }

  /** The function of a name. */
  get(name) {
    let found = this.#functions.get(name);
    if (!found) {
      const [library, result, parameters] = FUNCTIONS[name];
      found = this.library(library).func(name, result, parameters);
      this.#functions.set(name, found);
    }
    return found;
  }

  /** liblocus, liblocus_io or liblocus_cold. */
  library(name) {
    let library = this.#libraries.get(name);
    if (!library) {
      library = koffi.load(this.#open(name));
      this.#libraries.set(name, library);
    }
    return library;
  }

  /** Call a function; where it fails, the text of the error, which belongs to this thread, comes with its status. */
  call(name, args) {
    const [library, result] = FUNCTIONS[name];
    const value = this.get(name)(...args);
    if (result !== 'int32_t') return { status: 0, value };
    return value === 0 ? { status: 0 } : { status: value, text: this.get(TEXTS[library])(), code: this.get('locus_status_name')(value) };
  }
}

/** Copy bytes from an address of the library's into an array. */
const memcpy = koffi.load(null).func('memcpy', 'void *', ['void *', 'void *', 'size_t']);
export function copyFrom(address, array) {
  if (array.byteLength > 0) memcpy(array, address, array.byteLength);
  return array;
}
