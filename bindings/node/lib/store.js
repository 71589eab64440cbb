// The PMQ: the live window of a stream of geo-located records, in memory, sorted along the Z-curve.
import { Callbacks } from './callbacks.js';
import { attach, outside } from './cold.js';
import { Future, Index, Layout, Record, Sync } from './constants.js';
import { DISPOSE, Handle, INNER, Made, PROGRESS, away, filled, guarded, here, must, number64, options, quick } from './call.js';
import { LocusError } from './errors.js';
import { Guard } from './guard.js';
import { native } from './library.js';
import { copyFrom } from './native.js';
import { Shown, cQuery } from './query.js';
import { Reader } from './reader.js';
import { ARRAYS } from './records.js';
import { Struct } from './struct.js';
import { callable, enumOption, enumValue, microseconds, pathText, real } from './values.js';

const ROOM = 4096;

/** Collects the records that leave a store, and hands them on in arrays. An array that the caller's function has not taken, for it
 *  threw, is handed over again first, with the next call. */
class Sink {
  #function;
  #Records;
  #memory;
  #count = 0;
  #waiting = [];

  constructor(own, record) {
    this.#function = own;
    this.#Records = ARRAYS[record];
    this.#memory = new this.#Records(ROOM);
  }

  take(address) {
    copyFrom(address, this.#memory.subarray(this.#count, this.#count + 1).bytes);
    this.#count += 1;
    if (this.#count === ROOM) this.flush();
    return 0;
  }

  /** Hand over what is there. */
  flush() {
    if (this.#count > 0) this.#waiting.push(this.#memory.slice(0, this.#count));
    this.#count = 0;
    while (this.#waiting.length > 0) {
      this.#function(this.#waiting[0]);
      this.#waiting.shift();
    }
  }
}

/** The functions of a store as callbacks, the sink, and the options that name them. */
function callbacksOf({ remove, sink, log }, record) {
  const callbacks = new Callbacks();
  const fields = {};
  const collected = callable(sink, 'sink') && new Sink(sink, record);
  if (callable(remove, 'remove')) {
    const shown = new Shown(record);
    fields.remove = callbacks.add('locus_remove_fn', (address) => (remove(shown.next(address)) ? 1 : 0), -1);
  }
  if (collected) fields.sink = callbacks.add('locus_sink_fn', (address) => collected.take(address), 1);
  if (callable(log, 'log')) fields.log = callbacks.add('locus_log_fn', (level, text) => void log(level, text), undefined);
  return { callbacks, sink: collected, fields };
}

function storeOptions(given, record, fields) {
  return options('locus_pmq_options_init', {
    record,
    layout: enumOption(Layout, given.layout, 'layout'),
    index: enumOption(Index, given.index, 'index'),
    future: enumOption(Future, given.future, 'future'),
    horizon: given.horizon === undefined ? undefined : microseconds(given.horizon, 'horizon'),
    max_records: given.maxRecords,
    max_bytes: given.maxBytes,
    segment_slots: given.segmentSlots,
    rho_leaf: given.rhoLeaf,
    tau_leaf: given.tauLeaf,
    rho_root: given.rhoRoot,
    tau_root: given.tauRoot,
    snapshot_bytes: given.snapshotBytes,
    ...fields,
  });
}

function logOptions({ sync, redeliver, syncInterval, syncBytes, keep, repair }) {
  return options('locus_pmq_log_options_init', {
    sync: enumOption(Sync, sync, 'sync'),
    redeliver: redeliver === undefined ? undefined : Number(redeliver),
    sync_interval: syncInterval === undefined ? undefined : microseconds(syncInterval, 'syncInterval'),
    sync_bytes: syncBytes,
    keep,
    repair: repair === undefined ? undefined : Number(repair),
  });
}

/** What makes a store: `create` is given its options and where the handle goes, and returns what it found. */
function* make(work, given, create) {
  const record = enumValue(Record, given.record ?? Record.POINT32, 'record');
  if (!ARRAYS[record]) throw new RangeError(`record is ${record}, not ${Object.values(Record).join(' or ')}`);
  const { callbacks, sink, fields } = callbacksOf(given, record);
  const { cold } = given;
  const made = number64();
  let detach;
  try {
    work.uses(callbacks);
    work.listen(given);
    const plain = storeOptions(given, record, fields);
    detach = attach(cold, plain);
    const recovery = yield* create(plain, made);
    return { address: made[0], callbacks, sink, record, recovery, cold, detach };
  } catch (error) {
    native.get('locus_pmq_destroy')(made[0]);
    callbacks.release();
    detach?.();
    throw error;
  }
}

const creating = (work, given) =>
  make(work, given, function* create(plain, made) {
    yield* must('locus_pmq_create', plain, made);
  });

const loading = (path, given) => (work) => {
  const file = pathText(path);
  const told = { record: given.record ?? fileInfo(path).record, ...given };
  return make(work, told, function* create(plain, made) {
    yield* must('locus_pmq_load', file, plain, PROGRESS, null, made);
  });
};

const opening = (folder, given) => (work) =>
  make(work, given, function* create(plain, made) {
    const recovery = new Struct('locus_pmq_recovery');
    yield* must('locus_pmq_open', pathText(folder, 'folder'), plain, logOptions(given), PROGRESS, null, recovery, made);
    return recovery.read();
  });

/** One moment of a store, for several questions. */
export class Snapshot extends Reader {
  constructor(store) {
    super();
    if (!(store instanceof Store)) throw new TypeError('a snapshot is made of a Store');
    const made = number64();
    quick('locus_pmq_snapshot_create', store[INNER].store.address, made);
    const snapshot = new Handle(this, 'locus_pmq_snapshot_destroy', made[0]);
    // The store lives as long as its snapshots, and so does its guard.
    this[INNER] = { ...store[INNER], snapshot, of: store };
  }

  dispose() {
    Guard.enter({ writing: [this[INNER].guard] })();
    this[INNER].snapshot.dispose();
  }

  [DISPOSE]() {
    this.dispose();
  }
}

export class Store extends Reader {
  constructor(given = {}) {
    super();
    const { address, callbacks, sink, record, recovery, cold, detach } =
      given instanceof Made ? given.made : here('new Store', (work) => creating(work, given));
    // Behind it go its functions, and it lets go of its tier.
    const release = () => (callbacks.release(), detach?.());
    const store = new Handle(this, 'locus_pmq_destroy', address, { release });
    // What watches the store (Alerts), and how many changes are at work, on this thread and on workers.
    const changes = { watchers: new Set(), ended: [], here: 0, away: 0 };
    this[INNER] = { guard: new Guard('Store'), store, callbacks, sink, record, cold, changes };
    this.recovery = recovery;
  }

  static loadSync(path, given = {}) {
    return new Store(new Made(here('Store.load', loading(path, given))));
  }

  static async load(path, given = {}) {
    return new Store(new Made(await away('Store.load', loading(path, given))));
  }

  static openSync(folder, given = {}) {
    return new Store(new Made(here('Store.open', opening(folder, given))));
  }

  static async open(folder, given = {}) {
    return new Store(new Made(await away('Store.open', opening(folder, given))));
  }

  get #address() {
    return this[INNER].store.address;
  }

  /** A change: behind it the sink gets what left. */
  #changing(body) {
    const { guard, callbacks, sink, cold, changes } = this[INNER];
    return (work) => {
      outside(cold);
      work.uses(callbacks);
      for (const watcher of changes.watchers) work.uses(watcher[INNER].callbacks);
      const place = work.here ? 'here' : 'away';
      return guarded({ reading: [guard] }, function* whole() {
        changes[place] += 1;
        try {
          const result = yield* body(work);
          sink?.flush();
          return result;
        } catch (error) {
          if (error instanceof LocusError) sink?.flush();
          throw error;
        } finally {
          changes[place] -= 1;
          if (changes.here === 0) for (const ended of changes.ended.splice(0)) ended.release();
        }
      });
    };
  }

  #insert(records, now) {
    const { Records } = this;
    if (!(records instanceof Records)) {
      const given = records?.constructor?.name ?? String(records);
      throw new TypeError(`records must be a ${Records.name}, not ${given}`);
    }
    const clock = microseconds(now, 'now');
    return this.#changing(() => must('locus_pmq_insert', this.#address, records.bytes, records.length, clock));
  }

  insertSync(records, now) {
    here('Store.insert', this.#insert(records, now));
  }

  async insert(records, now) {
    await away('Store.insert', this.#insert(records, now));
  }

  #sweep(now) {
    const clock = microseconds(now, 'now');
    return this.#changing(function* body() {
      const evicted = number64();
      yield* must('locus_pmq_sweep', this.#address, clock, evicted);
      return Number(evicted[0]);
    }.bind(this));
  }

  sweepSync(now) {
    return here('Store.sweep', this.#sweep(now));
  }

  async sweep(now) {
    return away('Store.sweep', this.#sweep(now));
  }

  #erase(query) {
    return this.#changing(function* body(work) {
      const asked = cQuery(query, this[INNER].record, (run) => work.callback('locus_filter_fn', run, 0));
      const erased = number64();
      yield* must('locus_pmq_erase', this.#address, asked, erased);
      return Number(erased[0]);
    }.bind(this));
  }

  eraseSync(query) {
    return here('Store.erase', this.#erase(query));
  }

  async erase(query) {
    return away('Store.erase', this.#erase(query));
  }

  snapshot() {
    return new Snapshot(this);
  }

  #attach(folder, given) {
    const path = pathText(folder, 'folder');
    const plain = logOptions(given);
    return (work) => {
      work.listen(given);
      return guarded({ reading: [this[INNER].guard] }, () => must('locus_pmq_attach', this.#address, path, plain, PROGRESS, null));
    };
  }

  attachSync(folder, given = {}) {
    here('Store.attach', this.#attach(folder, given));
  }

  async attach(folder, given = {}) {
    await away('Store.attach', this.#attach(folder, given));
  }

  #checkpoint(listening) {
    return (work) => {
      work.listen(listening);
      return guarded({ reading: [this[INNER].guard] }, () => must('locus_pmq_checkpoint', this.#address, PROGRESS, null));
    };
  }

  checkpointSync(listening) {
    here('Store.checkpoint', this.#checkpoint(listening));
  }

  async checkpoint(listening) {
    await away('Store.checkpoint', this.#checkpoint(listening));
  }

  /** A call without arguments, beside readers. */
  #plain(name) {
    return () => guarded({ reading: [this[INNER].guard] }, () => must(name, this.#address));
  }

  flushSync() {
    here('Store.flush', this.#plain('locus_pmq_sync'));
  }

  async flush() {
    await away('Store.flush', this.#plain('locus_pmq_sync'));
  }

  checkSync() {
    here('Store.check', this.#plain('locus_pmq_check'));
  }

  async check() {
    await away('Store.check', this.#plain('locus_pmq_check'));
  }

  get stats() {
    return filled('locus_pmq_stats', 'locus_pmq_get_stats', this.#address);
  }

  get logStats() {
    return filled('locus_pmq_log_stats', 'locus_pmq_get_log_stats', this.#address);
  }

  dispose() {
    Guard.enter({ writing: [this[INNER].guard] })();
    this[INNER].store.dispose();
  }

  [DISPOSE]() {
    this.dispose();
  }
}

/** What a saved file says of itself. */
export function fileInfo(path) {
  return filled('locus_pmq_file_info', 'locus_pmq_get_file_info', pathText(path));
}

/** The key of a place: the Morton code of its Web-Mercator tile at zoom 25. */
export function pmqKey(latitude, longitude) {
  const key = number64();
  quick('locus_pmq_key', real(latitude, 'latitude'), real(longitude, 'longitude'), key);
  return Number(key[0]);
}

