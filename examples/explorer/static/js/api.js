// The server's interface (docs/explorer.md): every answer is JSON or a picture, every error a message that can be shown.
const query = (parameters) => {
  const given = Object.entries(parameters).filter(([, value]) => value !== null && value !== undefined);
  return given.length ? `?${new URLSearchParams(given)}` : '';
};

// The server's own words for what went wrong, or the status.
async function refusal(path, answer) {
  const body = await answer.json().catch(() => null);
  return new Error(body?.error ?? `${path}: the server answered ${answer.status}`);
}

export async function fetched(path, parameters = {}, signal = undefined) {
  let answer;
  try {
    answer = await fetch(path + query(parameters), { signal });
  } catch (error) {
    throw error.name === 'AbortError' ? error : new Error('The server cannot be reached.');
  }
  if (!answer.ok) throw await refusal(path, answer);
  return answer;
}

export const get = async (path, parameters, signal) => (await fetched(path, parameters, signal)).json();

export const box = ({ south, west, north, east }) => [south, west, north, east].join();

// Requests of which only the latest counts: `work(get)` is given a get that a newer call ends; one that is not `pressing` gives way to
// what is on its way. Answers undefined when it was overtaken or gave way.
export function latest() {
  let controller = null;
  return async (work, pressing = true) => {
    if (controller && !pressing) return undefined;
    controller?.abort();
    const mine = controller = new AbortController();
    try {
      const answer = await work((path, parameters) => get(path, parameters, mine.signal));
      return mine.signal.aborted ? undefined : answer;
    } catch (error) {
      if (mine.signal.aborted) return undefined;
      throw error;
    } finally {
      if (controller === mine) controller = null;
    }
  };
}
