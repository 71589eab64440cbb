// What happens in a stream: regions where more arrives than their history leads to expect, and records inside fences.
import { Callbacks, stopsAtFalse } from './callbacks.js';
import { Status } from './constants.js';
import { DISPOSE, Handle, INNER, call, check, filled, here, number64, options, quick } from './call.js';
import { refusal } from './errors.js';
import { copyFrom } from './native.js';
import { Shown, cQuery } from './query.js';
import { StructArray } from './records.js';
import { Store } from './store.js';
import { callable, integer, microseconds } from './values.js';

/** A length of time among the options. */
const span = (value, name) => (value === undefined ? undefined : microseconds(value, name));

export class Alerts {
  constructor(store, given = {}) {
    if (!(store instanceof Store)) throw new TypeError('alerts watch a Store');
    const callbacks = new Callbacks();
    const plain = options('locus_alerts_options_init', {
      zoom_from: given.zoomFrom,
      zoom_to: given.zoomTo,
      half_life: span(given.halfLife, 'halfLife'),
      history: span(given.history, 'history'),
      cool_down: span(given.coolDown, 'coolDown'),
      minimum: given.minimum,
      factor: given.factor,
      rate: given.rate,
      share: given.share,
      max_bytes: given.maxBytes,
    });
    const { alert, fence } = given;
    if (callable(alert, 'alert')) {
      const told = new StructArray('locus_alert', 1);
      const run = (address) => {
        copyFrom(address, told.bytes);
        return stopsAtFalse(alert(told.read()[0]));
      };
      plain.set({ alert: callbacks.add('locus_alert_fn', run, 1) });
    }
    if (callable(fence, 'fence')) {
      const shown = new Shown(store[INNER].record);
      const run = (id, address) => stopsAtFalse(fence(Number(id), shown.copy(address)));
      plain.set({ fence: callbacks.add('locus_fence_fn', run, 1) });
    }
    const made = number64();
    quick('locus_alerts_create', store[INNER].store.address, plain, made);
    this.store = store;
    // Where a change of the store ends this object, its functions end with the change.
    const { changes } = store[INNER];
    const release = () => (changes.here > 0 ? changes.ended.push(callbacks) : callbacks.release());
    this[INNER] = { callbacks, handle: new Handle(this, 'locus_alerts_destroy', made[0], { release }) };
    changes.watchers.add(this);
  }

  get #address() {
    return this[INNER].handle.address;
  }

  active() {
    const count = number64();
    const address = this.#address;
    return here('Alerts.active', function* body() {
      for (let room = 256; ; room = Number(count[0])) {
        const alerts = new StructArray('locus_alert', room);
        const told = yield call('locus_alerts_active', address, alerts.bytes, room, count);
        if (told.status === Status.CAPACITY) continue;
        check(told);
        return alerts.read(Number(count[0]));
      }
    });
  }

  addFence(id, query) {
    // The filter of a fence stays, also of a removed one, until the object ends.
    const { callbacks } = this[INNER];
    const asked = cQuery(query, this.store[INNER].record, (run) => callbacks.add('locus_filter_fn', run, 0));
    quick('locus_alerts_add_fence', this.#address, integer(id, 'uint64_t', 'id'), asked);
  }

  removeFence(id) {
    quick('locus_alerts_remove_fence', this.#address, integer(id, 'uint64_t', 'id'));
  }

  get stats() {
    return filled('locus_alerts_stats', 'locus_alerts_get_stats', this.#address);
  }

  dispose() {
    const { changes } = this.store[INNER];
    if (!changes.watchers.has(this)) return;
    if (changes.away > 0) throw refusal('BUSY', 'Alerts: a change of the store is at work');
    changes.watchers.delete(this);
    this[INNER].handle.dispose();
  }

  [DISPOSE]() {
    this.dispose();
  }
}

