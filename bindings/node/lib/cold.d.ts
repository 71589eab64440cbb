// The cold tier.
import type { BusyError, ColdFullName, ColdSyncName, Disposable, Member, Path, RecordName, Span, StoppedError, Time } from './common.js';
import type { ArrayOf, FilteredQuery, Point32, Query, RecordArrayConstructor, Snapshot, Store, View } from './stream.js';

export interface ColdOptions {
  /** The layout of the records, that of the store; Point32. */
  record?: Member<RecordName>;
  /** How the file is made safe against loss of power; NORMAL. */
  sync?: Member<ColdSyncName>;
  /** Whether a change of the store waits while the queue is full, or is a `StoppedError`; WAIT. */
  whenFull?: Member<ColdFullName>;
  /** How long a record is kept, see `sweep`. */
  maxAge?: Span;
  /** The file's pages in use; beyond, what came first goes. */
  maxBytes?: number;
  /** As in locus_cold_options. */
  queueBytes?: number;
  batchRecords?: number;
  delay?: Span;
  runRecords?: number;
  cacheBytes?: number;
}

export interface ColdStats {
  received: number;
  written: number;
  removed: number;
  stored: number;
  runs: number;
  queueBytes: number;
  fileBytes: number;
  freeBytes: number;
  transactions: number;
  waits: number;
  now: number;
  failure: number;
}

/** Whom to ask beside the tier: its store, at the present or at a snapshot's moment. Nobody: the tier alone. */
export type Beside<Value> = Store<Value> | Snapshot<Value> | null | undefined;

/**
 * An SQLite database that takes over what leaves a store, in the background, and answers together with it (liblocus_cold, which is loaded
 * when a tier is first opened). Make the tier first, then the store with `new Store({ cold })`. Each record that was inserted, and that
 * retention has not removed, is in an answer once. Any number may ask at the same time. A process that exits writes what is queued;
 * `flush` to learn of failures.
 */
export class Cold<Value = Point32> implements Disposable {
  /** Open the database, or make it. One tier at a time has it open: another is a `BusyError`. */
  constructor(path: Path, options?: ColdOptions);
  static open<Value = Point32>(path: Path, options?: ColdOptions): Promise<Cold<Value>>;
  /** The class of the records' arrays. */
  readonly Records: RecordArrayConstructor<Value, ArrayOf<Value>>;
  /** How many records the query selects in the store and in the tier. */
  count(store?: Beside<Value>, query?: Query<Value>): Promise<number>;
  countSync(store?: Beside<Value>, query?: FilteredQuery<Value>): number;
  /** Copy them, in the store's order, and records of one place as they came, into `out` or new memory. */
  read(store?: Beside<Value>, query?: Query<Value>, out?: ArrayOf<Value>): Promise<ArrayOf<Value>>;
  readSync(store?: Beside<Value>, query?: FilteredQuery<Value>, out?: ArrayOf<Value>): ArrayOf<Value>;
  /**
   * Show them one by one, each valid during the call only, until `visitor` returns false. True: all were shown. The visitor must not call
   * into the tier or change the store: that is a `BusyError`.
   */
  visitSync(visitor: (record: View<Value>) => unknown, store?: Beside<Value>, query?: FilteredQuery<Value>): boolean;
  /** Wait until what has left the store by now is in the file. Records that cannot be written, as on a full disk, stay queued. */
  flush(): Promise<void>;
  flushSync(): void;
  /** Set the tier's clock, which never runs back: records older than `maxAge` are in no answer any more, and are removed. */
  sweep(now: Time): void;
  /** Forget what was taken over when `stats.received` had been `received` or more: for a store that was loaded again. */
  rewind(received: number | bigint): Promise<void>;
  rewindSync(received: number | bigint): void;
  /** Verify the whole file. */
  check(): Promise<void>;
  checkSync(): void;
  /** How many records came, were written and removed; the file's and the queue's size; the latest failure, a number of `Status`. */
  readonly stats: ColdStats;
  /** Write what is queued and close the file; the store has to be disposed of before. */
  dispose(): void;
  [Symbol.dispose](): void;
}
