// Dark, light, or as the system has it.
import { find } from './dom.js';
import { on, set, state } from './state.js';

const order = ['auto', 'dark', 'light'];
const names = { auto: 'as the system', dark: 'dark', light: 'light' };

export const next = () => set({ theme: order[(order.indexOf(state.theme) + 1) % order.length] });

export function start(redraw) {
  const button = find('theme');
  const apply = () => {
    if (state.theme === 'auto') delete document.documentElement.dataset.theme;
    else document.documentElement.dataset.theme = state.theme;
    button.setAttribute('aria-label', `Theme: ${names[state.theme]}`);
    button.title = `Theme: ${names[state.theme]}`;
    redraw();
  };
  button.addEventListener('click', next);
  on(['theme'], apply);
  matchMedia('(prefers-color-scheme: light)').addEventListener('change', apply);
  if (!order.includes(state.theme)) set({ theme: 'auto' });
  apply();
}
