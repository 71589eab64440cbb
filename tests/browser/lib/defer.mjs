// What a test has begun ends with it, the latest first.
const stacks = new WeakMap();

export function defer(t, end) {
  if (!stacks.has(t)) {
    stacks.set(t, []);
    t.after(async () => {
      const failures = [];
      for (const step of stacks.get(t).reverse()) await step().catch((error) => failures.push(error));
      if (failures.length) throw failures[0];
    });
  }
  stacks.get(t).push(end);
}
