// The cold tier: what leaves a store goes into an SQLite database, and a question sees both (liblocus_cold).
import { ColdFull, ColdSync, Record } from './constants.js';
import { DISPOSE, Handle, INNER, Made, away, check, filled, guarded, here, must, number64, options, quick } from './call.js';
import { refusal } from './errors.js';
import { Guard } from './guard.js';
import { native } from './library.js';
import { cQuery } from './query.js';
import { reading, showing } from './reader.js';
import { ARRAYS } from './records.js';
import { enumOption, enumValue, integer, microseconds, pathText } from './values.js';

/** A length of time among the options. */
const span = (value, name) => (value === undefined ? undefined : microseconds(value, name));

/** The tiers that are open: a process that exits writes what they have queued. */
const tiers = new Set();
process.on('exit', () => tiers.forEach((address) => native.get('locus_cold_flush')(address)));

/** What opens a tier. */
const opening = (path, given) =>
  function* body() {
    const record = enumValue(Record, given.record ?? Record.POINT32, 'record');
    if (!ARRAYS[record]) throw new RangeError(`record is ${record}, not ${Object.values(Record).join(' or ')}`);
    const plain = options('locus_cold_options_init', {
      record,
      sync: enumOption(ColdSync, given.sync, 'sync'),
      when_full: enumOption(ColdFull, given.whenFull, 'whenFull'),
      queue_bytes: given.queueBytes,
      batch_records: given.batchRecords,
      delay: span(given.delay, 'delay'),
      run_records: given.runRecords,
      cache_bytes: given.cacheBytes,
      max_age: span(given.maxAge, 'maxAge'),
      max_bytes: given.maxBytes,
    });
    const made = number64();
    yield* must('locus_cold_open', pathText(path), plain, made);
    return { address: made[0], record };
  };

/** A function that a tier calls must not call into it, nor change its store. */
export function outside(cold) {
  if (cold?.[INNER].inside) throw refusal('BUSY', 'Cold: it is at work, and this is its callback');
}

/** Let a tier be the sink of a store's options; returns what to call when the store has ended, nothing without a tier. */
export function attach(cold, plain) {
  if (cold === undefined) return undefined;
  if (!(cold instanceof Cold)) throw new TypeError(`cold must be a Cold, not ${String(cold)}`);
  const inner = cold[INNER];
  outside(cold);
  Guard.enter({ writing: [inner.guard] })();
  if (inner.attached) throw refusal('STATE', 'Cold: another store is attached');
  quick('locus_cold_attach', inner.handle.address, plain);
  inner.attached = true;
  return () => {
    inner.attached = false;
  };
}

export class Cold {
  constructor(path, given = {}) {
    const { address, record } = path instanceof Made ? path.made : here('new Cold', opening(path, given));
    tiers.add(address);
    const handle = new Handle(this, 'locus_cold_close', address, { release: () => tiers.delete(address) });
    // Questions are readers; what stands alone (attaching, rewinding) is a writer. Inside: a Sync question calls functions.
    this[INNER] = { guard: new Guard('Cold'), handle, record, inside: false, attached: false };
  }

  static async open(path, given = {}) {
    return new Cold(new Made(await away('Cold.open', opening(path, given))));
  }

  /** The class of the records' arrays. */
  get Records() {
    return ARRAYS[this[INNER].record];
  }

  /** A question: its body is given the tier, the store and the query as C has them. */
  #asking(of, query, body) {
    const inner = this[INNER];
    return (work) => {
      outside(this);
      const store = of?.[INNER];
      if (of !== undefined && of !== null && store?.cold !== this) throw refusal('ARGUMENT', 'Cold: the store was made without this tier');
      const asked = cQuery(query, inner.record, (run) => work.callback('locus_filter_fn', run, 0), store?.snapshot?.address);
      return guarded({ reading: store ? [inner.guard, store.guard] : [inner.guard] }, function* whole() {
        inner.inside = work.here;
        try {
          return yield* body([inner.handle.address, store?.store.address ?? null, asked], work);
        } finally {
          if (work.here) inner.inside = false;
        }
      });
    };
  }

  #count(store, query) {
    return this.#asking(store, query, function* body(asked) {
      const count = number64();
      yield* must('locus_cold_count', ...asked, count);
      return Number(count[0]);
    });
  }

  countSync(store, query) {
    return here('Cold.count', this.#count(store, query));
  }

  async count(store, query) {
    return away('Cold.count', this.#count(store, query));
  }

  #read(store, query, out) {
    return this.#asking(store, query, reading(this.Records, out, 'locus_cold_count', 'locus_cold_read'));
  }

  readSync(store, query, out) {
    return here('Cold.read', this.#read(store, query, out));
  }

  async read(store, query, out) {
    return away('Cold.read', this.#read(store, query, out));
  }

  visitSync(visitor, store, query) {
    return here('Cold.visit', this.#asking(store, query, showing(this[INNER].record, visitor, 'locus_cold_visit')));
  }

  /** A call beside questions, or alone. */
  #plain(name, args = [], kind = 'reading') {
    return () => {
      const { guard, handle } = this[INNER];
      outside(this);
      return guarded({ [kind]: [guard] }, () => must(name, handle.address, ...args));
    };
  }

  flushSync() {
    here('Cold.flush', this.#plain('locus_cold_flush'));
  }

  async flush() {
    await away('Cold.flush', this.#plain('locus_cold_flush'));
  }

  sweep(now) {
    here('Cold.sweep', this.#plain('locus_cold_sweep', [microseconds(now, 'now')]));
  }

  #rewind(received) {
    return this.#plain('locus_cold_rewind', [integer(received, 'uint64_t', 'received')], 'writing');
  }

  rewindSync(received) {
    here('Cold.rewind', this.#rewind(received));
  }

  async rewind(received) {
    await away('Cold.rewind', this.#rewind(received));
  }

  checkSync() {
    here('Cold.check', this.#plain('locus_cold_check'));
  }

  async check() {
    await away('Cold.check', this.#plain('locus_cold_check'));
  }

  get stats() {
    outside(this);
    return filled('locus_cold_stats', 'locus_cold_get_stats', this[INNER].handle.address);
  }

  dispose() {
    const { guard, handle, attached } = this[INNER];
    outside(this);
    if (attached) throw refusal('STATE', 'Cold: a store is attached, dispose of it first');
    Guard.enter({ writing: [guard] })();
    handle.dispose();
  }

  [DISPOSE]() {
    this.dispose();
  }
}
