// The panes of the panel: a tab list with arrow keys; pressing the open one folds the panel.
import { find } from './dom.js';
import { on, set, state } from './state.js';

const names = ['selection', 'top', 'alerts', 'stream'];
const panel = () => document.querySelector('.panel');
export const small = () => matchMedia('(max-width: 720px)').matches;

function show() {
  for (const name of names) {
    const chosen = state.tab === name;
    const tab = find(`tab-${name}`);
    tab.setAttribute('aria-selected', chosen);
    tab.tabIndex = chosen ? 0 : -1;
    find(`pane-${name}`).hidden = !chosen;
  }
  dispatchEvent(new CustomEvent('pane', { detail: state.tab }));
}

export function open(name) {
  panel().classList.remove('folded');
  set({ tab: name });
}

export const fold = () => panel().classList.add('folded');

export function start() {
  if (!names.includes(state.tab)) set({ tab: names[0] });
  names.forEach((name, i) => {
    const tab = find(`tab-${name}`);
    tab.addEventListener('click', () => {
      if (state.tab === name) panel().classList.toggle('folded');
      else open(name);
    });
    tab.addEventListener('keydown', ({ key }) => {
      const to = { ArrowRight: i + 1, ArrowLeft: i - 1, Home: 0, End: names.length - 1 }[key];
      if (to === undefined) return;
      const next = names[(to + names.length) % names.length];
      open(next);
      find(`tab-${next}`).focus();
    });
  });
  if (small()) fold();
  on(['tab'], show);
  show();
}
