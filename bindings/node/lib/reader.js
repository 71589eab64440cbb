// The questions to a store or to a snapshot of it; each is answered from one moment, beside the writer too.
import { CONSTANTS } from './interface.js';
import { Field, Status } from './constants.js';
import { INNER, PROGRESS, away, call, check, guarded, here, must, number64, options } from './call.js';
import { Shown, cQuery } from './query.js';
import { ARRAYS, StructArray } from './records.js';
import { enumValue, integer, microseconds, pathText, real, size, writable } from './values.js';

/** A tile's side in bins. */
const sideOf = (log2Bins) => 2 ** Math.min(size(log2Bins, 'log2Bins'), 8);

/** A tile and its bins, checked. */
const tileArgs = (tile) => tile.map(([name, value]) => Number(integer(value, 'uint32_t', name)));

/** The body of a question that reads into `out` or new memory, by the functions that count and read. */
export function reading(Records, out, counting, copying) {
  if (out && !(out instanceof Records)) throw new TypeError(`out must be a ${Records.name}, not ${out.constructor?.name}`);
  return function* body(asked) {
    const count = number64();
    let array = out;
    if (!array) {
      yield* must(counting, ...asked, count);
      array = new Records(Number(count[0]));
    }
    for (;;) {
      const told = yield call(copying, ...asked, array.bytes, array.length, count);
      if (out || told.status !== Status.CAPACITY) check(told);
      if (told.status === 0) return array.subarray(0, Number(count[0]));
      // Records came in between the two calls.
      array = new Records(Number(count[0]));
    }
  };
}

/** The body of a question that shows records to a function, until that returns false. */
export function showing(record, visitor, visiting) {
  const shown = new Shown(record);
  let stopped = false;
  return function* body(asked, work) {
    const visit = work.callback('locus_visit_fn', (address) => {
      stopped = visitor(shown.next(address)) === false;
      return stopped ? 1 : 0;
    }, 1);
    const told = yield call(visiting, ...asked, visit, null);
    if (!stopped) check(told);
    return !stopped;
  };
}

/** What Store and Snapshot have in common. */
export class Reader {
  /** The class of the records' arrays. */
  get Records() {
    return ARRAYS[this[INNER].record];
  }

  /** A question: its body is given the store and the query as C has it. */
  #asking(query, body) {
    const { guard, record } = this[INNER];
    return (work) => {
      const asked = cQuery(query, record, (run) => work.callback('locus_filter_fn', run, 0), this[INNER].snapshot?.address);
      return guarded({ reading: [guard] }, () => body(this[INNER].store.address, asked, work));
    };
  }

  #count(query) {
    const count = number64();
    return this.#asking(query, function* body(store, asked) {
      yield* must('locus_pmq_count', store, asked, count);
      return Number(count[0]);
    });
  }

  countSync(query) {
    return here(`${this.constructor.name}.count`, this.#count(query));
  }

  async count(query) {
    return away(`${this.constructor.name}.count`, this.#count(query));
  }

  #read(query, out) {
    const body = reading(this.Records, out, 'locus_pmq_count', 'locus_pmq_read');
    return this.#asking(query, (store, asked) => body([store, asked]));
  }

  readSync(query, out) {
    return here(`${this.constructor.name}.read`, this.#read(query, out));
  }

  async read(query, out) {
    return away(`${this.constructor.name}.read`, this.#read(query, out));
  }

  visitSync(visitor, query) {
    const body = showing(this[INNER].record, visitor, 'locus_pmq_visit');
    return here(`${this.constructor.name}.visit`, this.#asking(query, (store, asked, work) => body([store, asked], work)));
  }

  /** The next page at a cursor, { records, size }: where one place holds more than a page, the size grows. */
  #page(query, cursor, most) {
    const { Records } = this;
    return this.#asking(query, function* body(store, asked) {
      const count = number64();
      for (let room = most; ; room = Number(count[0])) {
        const page = new Records(room);
        const told = yield call('locus_pmq_read_page', store, asked, cursor.bytes, page.bytes, room, count);
        if (told.status === Status.CAPACITY) continue;
        check(told);
        return { records: page.subarray(0, Number(count[0])), size: room };
      }
    });
  }

  *pagesSync({ size: most = 65536, query } = {}) {
    const cursor = new StructArray('locus_pmq_cursor', 1);
    for (let room = size(most, 'size'); ; ) {
      const page = here(`${this.constructor.name}.pages`, this.#page(query, cursor, room));
      if (page.records.length === 0) return;
      yield page.records;
      room = page.size;
    }
  }

  async *pages({ size: most = 65536, query } = {}) {
    const cursor = new StructArray('locus_pmq_cursor', 1);
    for (let room = size(most, 'size'); ; ) {
      const page = await away(`${this.constructor.name}.pages`, this.#page(query, cursor, room));
      if (page.records.length === 0) return;
      yield page.records;
      room = page.size;
    }
  }

  #groups(field, query) {
    const { record } = this[INNER];
    const own = typeof field === 'function';
    return this.#asking(query, function* body(store, asked, work) {
      const count = number64();
      const shown = new Shown(record);
      const kind = own ? CONSTANTS.FIELD_CALLER : enumValue(Field, field, 'field');
      const answer = (address) => integer(field(shown.next(address)), 'uint64_t', "the function's answer");
      const group = own ? work.callback('locus_group_fn', answer, 0n) : null;
      for (let room = 64; ; room = Number(count[0])) {
        const groups = new StructArray('locus_pmq_group', room);
        const told = yield call('locus_pmq_groups', store, asked, kind, group, null, groups.bytes, room, count);
        if (told.status === Status.CAPACITY) continue;
        check(told);
        return groups.read(Number(count[0]));
      }
    });
  }

  groupsSync(field, query) {
    return here(`${this.constructor.name}.groups`, this.#groups(field, query));
  }

  async groups(field, query) {
    return away(`${this.constructor.name}.groups`, this.#groups(field, query));
  }

  #tile({ zoom, x, y, log2Bins = 8, query, out }) {
    const [z, column, row, log2] = tileArgs(Object.entries({ zoom, x, y, log2Bins }));
    const side = sideOf(log2Bins);
    const bins = writable(out, Uint32Array, side * side);
    return this.#asking(query, function* body(store, asked) {
      yield* must('locus_pmq_tile', store, z, column, row, log2, asked, bins, bins.length, null);
      return bins;
    });
  }

  tileSync(tile) {
    return here(`${this.constructor.name}.tile`, this.#tile(tile));
  }

  async tile(tile) {
    return away(`${this.constructor.name}.tile`, this.#tile(tile));
  }

  weightedTileSync(weight, { zoom, x, y, log2Bins = 8, query, out }) {
    const [z, column, row, log2] = tileArgs(Object.entries({ zoom, x, y, log2Bins }));
    const side = sideOf(log2Bins);
    const bins = writable(out, Float64Array, side * side);
    const shown = new Shown(this[INNER].record);
    return here(`${this.constructor.name}.weightedTile`, this.#asking(query, function* body(store, asked, work) {
      const told = (address) => real(weight(shown.next(address)), "the weight function's answer");
      const callback = work.callback('locus_record_weight_fn', told, NaN);
      yield* must('locus_pmq_weighted_tile', store, z, column, row, log2, asked, callback, null, bins, bins.length, null);
      return bins;
    }));
  }

  /** The best k records and their numbers: `before` are the arguments before the query, `after` those behind it. */
  #best(name, k, query, before) {
    const { Records } = this;
    const room = size(k, 'k');
    return this.#asking(query, function* body(store, asked) {
      const [records, values, count] = [new Records(room), new Float64Array(room), number64()];
      yield* must(name, store, ...before, asked, room, records.bytes, values, count);
      const found = Number(count[0]);
      return { records: records.subarray(0, found), values: values.subarray(0, found) };
    });
  }

  #topk(k, { latitude, longitude, radius, alpha, period, query }) {
    const score = options('locus_pmq_score_init', {
      latitude, longitude, radius, alpha, period: period === undefined ? undefined : microseconds(period, 'period'),
    });
    return this.#best('locus_pmq_topk', k, query, [score]);
  }

  topkSync(k, given) {
    return here(`${this.constructor.name}.topk`, this.#topk(k, given));
  }

  async topk(k, given) {
    return away(`${this.constructor.name}.topk`, this.#topk(k, given));
  }

  #nearest(k, { latitude, longitude, query }) {
    return this.#best('locus_pmq_nearest', k, query, [real(latitude, 'latitude'), real(longitude, 'longitude')]);
  }

  nearestSync(k, given) {
    return here(`${this.constructor.name}.nearest`, this.#nearest(k, given));
  }

  async nearest(k, given) {
    return away(`${this.constructor.name}.nearest`, this.#nearest(k, given));
  }

  #save(path, listening) {
    const file = pathText(path);
    const { guard, store, snapshot } = this[INNER];
    return (work) => {
      work.listen(listening);
      const body = () => must('locus_pmq_save', store.address, snapshot?.address ?? null, file, PROGRESS, null);
      return guarded({ reading: [guard] }, body);
    };
  }

  saveSync(path, listening) {
    here(`${this.constructor.name}.save`, this.#save(path, listening));
  }

  async save(path, listening) {
    await away(`${this.constructor.name}.save`, this.#save(path, listening));
  }
}

