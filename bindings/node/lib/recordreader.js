// Records for a store from CSV or newline-delimited JSON, zstd-compressed or not (liblocus_io).
import { Callbacks } from './callbacks.js';
import { CONSTANTS } from './interface.js';
import { Record, RecordsFormat, TimeUnit } from './constants.js';
import { DISPOSE, Handle, INNER, away, filled, guarded, here, must, number64, options, quick } from './call.js';
import { Guard } from './guard.js';
import { ARRAYS } from './records.js';
import { cText } from './struct.js';
import { callable, enumOption, enumValue, pathText, plainText, size } from './values.js';

/** The code of a separator. */
function separatorOf(text) {
  if (text === undefined) return undefined;
  if (typeof text !== 'string' || text.length !== 1) throw new TypeError(`separator must be one character, not '${String(text)}'`);
  return text.charCodeAt(0);
}

export class RecordReader {
  #Records;
  #batch;

  constructor(source, given = {}) {
    const record = enumValue(Record, given.record ?? Record.TEXT156, 'record');
    if (!ARRAYS[record]) throw new RangeError(`record is ${record}, not ${Object.values(Record).join(' or ')}`);
    this.#Records = ARRAYS[record];
    this.#batch = size(given.batch ?? 65536, 'batch');
    const plain = options('locus_records_options_init', {
      record,
      format: enumOption(RecordsFormat, given.format, 'format'),
      time_unit: enumOption(TimeUnit, given.timeUnit, 'timeUnit'),
      bad_lines: given.refuseBadLines ? CONSTANTS.BAD_LINES_REFUSE : CONSTANTS.BAD_LINES_COUNT,
      separator: separatorOf(given.separator),
      max_line: given.maxLine,
    });
    for (const column of ['time', 'latitude', 'longitude', 'text']) {
      const name = given[`${column}Column`];
      if (name !== undefined) plain.point(`${column}_column`, cText(plainText(name, `${column}Column`)));
    }
    const callbacks = new Callbacks();
    const { badLine } = given;
    if (callable(badLine, 'badLine')) {
      plain.set({ bad_line: callbacks.add('locus_bad_line_fn', (line, reason) => void badLine(Number(line), reason), undefined) });
    }
    const made = number64();
    try {
      if (typeof source === 'number') quick('locus_records_open_fd', size(source, 'source'), `descriptor ${source}`, plain, made);
      else quick('locus_records_open', pathText(source, 'source'), plain, made);
    } catch (error) {
      callbacks.release();
      throw error;
    }
    this[INNER] = { guard: new Guard('RecordReader'), callbacks, handle: new Handle(this, 'locus_records_close', made[0], callbacks) };
  }

  get Records() {
    return this.#Records;
  }

  #read(most = this.#batch) {
    const { guard, callbacks, handle } = this[INNER];
    const records = new this.#Records(size(most, 'most'));
    return (work) => {
      work.uses(callbacks);
      return guarded({ writing: [guard] }, function* body() {
        const count = number64();
        yield* must('locus_records_next', handle.address, records.bytes, records.length, count);
        return records.subarray(0, Number(count[0]));
      });
    };
  }

  readSync(most) {
    return here('RecordReader.read', this.#read(most));
  }

  async read(most) {
    return away('RecordReader.read', this.#read(most));
  }

  *[Symbol.iterator]() {
    for (let records = this.readSync(); records.length > 0; records = this.readSync()) yield records;
  }

  async *[Symbol.asyncIterator]() {
    for (let records = await this.read(); records.length > 0; records = await this.read()) yield records;
  }

  get stats() {
    Guard.enter({ reading: [this[INNER].guard] })();
    return filled('locus_records_stats', 'locus_records_get_stats', this[INNER].handle.address);
  }

  dispose() {
    Guard.enter({ writing: [this[INNER].guard] })();
    this[INNER].handle.dispose();
  }

  [DISPOSE]() {
    this.dispose();
  }
}
