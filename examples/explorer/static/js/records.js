// A list of records: text, place, time; the mouse or the focus on one shows it on the map. Text of the stream is text only.
import { element } from './dom.js';
import { count, metres, moment, position, readable } from './format.js';

// What a record says of itself.
const words = (record) => readable(record.text ?? '') || 'no text';

function extra(record) {
  const parts = [];
  if (Number.isFinite(record.score)) parts.push(`score ${record.score.toFixed(3)}`);
  if (Number.isFinite(record.distance)) parts.push(metres(record.distance));
  return parts.join(' · ');
}

// `chosen(record or null)`: pointed at; `opened(record)`: clicked or Enter.
export function list(records, { chosen, opened }) {
  const items = records.map((record) => {
    const item = element('li', { tabIndex: 0 },
      element('p.text', {}, words(record)),
      element('p.meta', {}, element('span', {}, moment(record.time)), element('span', {}, extra(record) || position(record.lat, record.lon))));
    item.addEventListener('pointerenter', () => chosen(record));
    item.addEventListener('pointerleave', () => chosen(null));
    item.addEventListener('focus', () => chosen(record));
    item.addEventListener('blur', () => chosen(null));
    item.addEventListener('click', () => opened(record));
    item.addEventListener('keydown', (event) => {
      if (event.key === 'Enter') opened(record);
      const to = { ArrowDown: item.nextElementSibling, ArrowUp: item.previousElementSibling }[event.key];
      if (to) {
        event.preventDefault();
        to.focus();
      }
    });
    return item;
  });
  return element('ol.records', {}, ...items);
}

// Buttons to turn pages of `size` records among `total`; `more`: there is a page after this one; `turn(page)`.
export function pager(page, size, total, more, turn) {
  const button = (text, to, can, label) =>
    element('button', { type: 'button', disabled: !can, 'aria-label': label, onclick: () => turn(to) }, text);
  const [first, end] = [Math.min(total, page * size + 1), Math.min(total, (page + 1) * size)];
  return element('div.pager', {}, button('‹', page - 1, page > 0, 'Previous page'),
    element('span', {}, `${count(first)}–${count(end)} of ${count(total)}`), button('›', page + 1, more, 'Next page'));
}
