// Messages to the user, errors above all: each stays until it is closed or a while has passed; the same text counts once.
import { element, find } from './dom.js';

const shown = new Map();
const STAY_MS = 8000;

export function toast(text, kind = 'note') {
  const message = shown.get(text) ?? make(text, kind);
  clearTimeout(message.timer);
  message.timer = setTimeout(message.close, STAY_MS);
}

function make(text, kind) {
  const close = () => {
    box.remove();
    shown.delete(text);
  };
  const button = element('button.icon', { type: 'button', 'aria-label': 'Close this message', onclick: close }, '✕');
  const box = element(`div.toast.${kind}`, {}, element('p', {}, text), button);
  find('toasts').append(box);
  const message = { close, timer: 0 };
  shown.set(text, message);
  return message;
}

export const report = (error) => {
  if (error.name !== 'AbortError') toast(error.message, 'error');
};
