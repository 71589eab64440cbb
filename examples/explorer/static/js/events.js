// The server's events over a connection that comes back by itself, with the state of the connection for the user to see.
const FIRST_WAIT_MS = 500;
const LONGEST_WAIT_MS = 15000;

// `hear` has a function for each kind of event; `tell(state, seconds)` hears: connecting, live, lost (with the seconds until the next try).
export function listen(path, hear, tell) {
  let wait = FIRST_WAIT_MS;
  let source = null;
  let timer = 0;

  const open = () => {
    clearTimeout(timer);
    tell('connecting');
    source = new EventSource(path);
    source.onopen = () => {
      wait = FIRST_WAIT_MS;
      tell('live');
    };
    source.onerror = () => {
      source.close();
      tell('lost', wait / 1000);
      timer = setTimeout(open, wait);
      wait = Math.min(2 * wait, LONGEST_WAIT_MS);
    };
    for (const [kind, call] of Object.entries(hear)) source.addEventListener(kind, ({ data }) => call(JSON.parse(data)));
  };

  // A network that is back, or a page that is looked at again, need not wait.
  const hurry = () => {
    if (source.readyState === EventSource.CLOSED && document.visibilityState === 'visible') open();
  };
  addEventListener('online', hurry);
  document.addEventListener('visibilitychange', hurry);
  open();
}
