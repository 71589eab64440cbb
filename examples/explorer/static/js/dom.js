// Elements without markup: text goes through textContent only, so nothing that comes with the stream can become an element.
export const find = (id) => document.getElementById(id);

// element('button.primary', { type: 'button', onclick }, 'text', child, ...)
export function element(kind, properties = {}, ...children) {
  const [name, ...classes] = kind.split('.');
  const made = document.createElement(name);
  if (classes.length) made.className = classes.join(' ');
  for (const [key, value] of Object.entries(properties)) {
    if (key in made && !key.startsWith('aria-')) made[key] = value;
    else made.setAttribute(key, value);
  }
  made.append(...children.filter((child) => child !== null && child !== undefined));
  return made;
}

// A labelled slider over `steps`, the values it can take; `change(value)` comes while it moves.
export function slider({ id, label, steps, value, text, change }) {
  const nearest = (wanted) => steps.reduce((best, step, i) => (Math.abs(step - wanted) < Math.abs(steps[best] - wanted) ? i : best), 0);
  const output = element('output', { htmlFor: id });
  const input = element('input', { id, type: 'range', min: 0, max: steps.length - 1, step: 1 });
  const show = (shown) => {
    output.textContent = text(shown);
    input.setAttribute('aria-valuetext', text(shown));
  };
  input.value = nearest(value);
  show(value);
  input.addEventListener('input', () => {
    show(steps[input.value]);
    change(steps[input.value]);
  });
  const set = (wanted) => {
    input.value = nearest(wanted);
    show(wanted);
  };
  return { row: element('div.slider', {}, element('label', { htmlFor: id }, label), output, input), set };
}

// The colour that a custom property has in the theme of now, for canvases.
let probe = null;
export function colour(name) {
  if (!probe) {
    probe = element('span', { hidden: true });
    document.body.append(probe);
  }
  probe.style.color = `var(${name})`;
  return getComputedStyle(probe).color;
}

// A canvas as large as it is shown, in device pixels; the context counts in CSS pixels.
export function context(canvas) {
  const { width, height } = canvas.getBoundingClientRect();
  const ratio = devicePixelRatio || 1;
  const [w, h] = [Math.round(width * ratio), Math.round(height * ratio)];
  if (canvas.width !== w || canvas.height !== h) Object.assign(canvas, { width: w, height: h });
  const pen = canvas.getContext('2d');
  pen.setTransform(ratio, 0, 0, ratio, 0, 0);
  pen.clearRect(0, 0, width, height);
  return { pen, width, height };
}

export const debounced = (wait, call) => {
  let timer = 0;
  return (...args) => {
    clearTimeout(timer);
    timer = setTimeout(() => call(...args), wait);
  };
};

export const calm = () => matchMedia('(prefers-reduced-motion: reduce)').matches;
