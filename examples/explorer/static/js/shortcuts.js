// Keys that work everywhere but in fields, and the dialog that lists them.
import { element, find } from './dom.js';

const shown = [
  ['Drag, arrow keys', 'move the map'],
  ['Wheel, + and −', 'zoom'],
  ['Shift + drag', 'select a rectangle'],
  ['S', 'select the middle of the view'],
  ['Click, T', 'best records at that place, at the middle of the view'],
  ['Space', 'pause, go on'],
  ['[ and ]', 'step back and forward in time'],
  ['1 2 3 4', 'selection, top-k, alerts, stream'],
  ['A', 'fly to the latest alert'],
  ['M', 'go to the map'],
  ['D', 'dark, light, as the system'],
  ['Esc', 'clear selection and top-k'],
  ['?', 'this help'],
];

const keys = (text) => text.split(/( and |, | \+ | (?=\d))/).map((part) => (/^( and |, | \+ | )$/.test(part) ? part : element('kbd', {}, part)));

// `actions`: what each key does, by KeyboardEvent.key.
export function start(actions) {
  const dialog = find('help');
  find('keys').append(...shown.flatMap(([key, text]) => [element('dt', {}, ...keys(key)), element('dd', {}, text)]));
  find('help-open').addEventListener('click', () => dialog.showModal());
  find('help-close').addEventListener('click', () => dialog.close());
  addEventListener('keydown', (event) => {
    if (event.ctrlKey || event.altKey || event.metaKey || dialog.open) return;
    const { target, key } = event;
    if (target.matches('select, input:not([type="range"]), textarea')) return;
    if (key === ' ' && target.matches('button, input, [role="tab"]')) return;
    const action = key === '?' ? () => dialog.showModal() : actions[key.length === 1 ? key.toLowerCase() : key];
    if (!action) return;
    event.preventDefault();
    action();
  });
}
