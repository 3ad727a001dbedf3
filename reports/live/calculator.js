// A model that calculates itself: inputs are put in, what follows from them is found anew.
export function calculator({functions, keys, values, runs, steps, fixed}) {
  const number = new Map(keys.map((key, i) => [key, i])), now = new Array(keys.length), readers = keys.map(() => []);
  const inputs = new Set(), still = new Set(fixed);
  for (const [i, value] of values) now[i] = Array.isArray(value) ? column(value) : value;
  const calls = [];
  const cells = new Map(runs);
  for (const step of steps) calls.push({act: functions[step[0]], rows: step[1], gives: step[2], takes: step[3]});
  for (const {rows, gives} of calls) if (rows) for (const i of gives) now[i] = rows < 0 ? new Array(-rows) : new Float64Array(rows);
  for (const [i] of values) if (!still.has(i)) inputs.add(i);
  // A run is filled where it is read first; what it holds is known to the step that reads it.
  const feeds = i => cells.get(i) ?? [i];
  calls.forEach((call, n) => { for (const i of call.takes) for (const each of new Set([i, ...feeds(i)])) readers[each].push(n); });
  const dirty = new Uint8Array(calls.length);

  function run() {
    for (let n = 0; n < calls.length; n++) {
      if (!dirty[n]) continue;
      dirty[n] = 0;
      const {act, rows, gives, takes} = calls[n];
      for (const i of takes) if (cells.has(i)) now[i] = column(cells.get(i).map(each => now[each]));
      const taken = takes.map(i => now[i]);
      if (rows) act(Math.abs(rows), ...gives.map(i => now[i]), ...taken);
      else {
        const value = act(...taken);
        if (Object.is(value, now[gives[0]])) continue; // nothing that follows from it changes
        now[gives[0]] = value;
      }
      for (const i of gives) for (const each of readers[i]) dirty[each] = 1;
    }
  }

  dirty.fill(1);
  run();
  return {
    keys: () => [...number.keys()],
    has: key => number.has(key),
    isFixed: key => still.has(number.get(key)),
    get(key) {
      const i = number.get(key);
      return cells.has(i) ? column(cells.get(i).map(each => now[each])) : now[i];
    },
    set(changes) {
      for (const [key, value] of Object.entries(changes)) {
        const i = number.get(key);
        if (i === undefined || !inputs.has(i)) throw new RangeError(key);
        if (Object.is(now[i], value)) continue;
        now[i] = value;
        for (const each of readers[i]) dirty[each] = 1;
      }
      run();
    },
  };
}

function column(values) {
  return values.every(each => typeof each === "number") ? Float64Array.from(values) : [...values];
}
