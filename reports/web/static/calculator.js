// A model that calculates itself: inputs are put in, what is asked for is found anew if it has to be.
export function calculator({functions, keys, values, runs, steps, fixed}) {
  const number = new Map(keys.map((key, i) => [key, i])), now = new Array(keys.length);
  const cells = new Map(runs), still = new Set(fixed), inputs = new Set();
  for (const [i, value] of values) {
    now[i] = Array.isArray(value) ? column(value) : value;
    if (!still.has(i) && !Array.isArray(value)) inputs.add(i);
  }
  const calls = steps.map(([act, rows, gives, takes]) => {
    for (const i of rows ? gives : []) now[i] = rows < 0 ? new Array(-rows) : new Float64Array(rows);
    return {act: functions[act], rows: Math.abs(rows), gives, takes, isStale: true};
  });
  const maker = new Array(keys.length), readers = keys.map(() => []); // calls, by what they give and take
  for (const call of calls) {
    for (const i of call.gives) maker[i] = call;
    for (const i of call.takes) for (const each of cells.get(i) ?? [i]) readers[each].push(call);
  }

  function spoil(i) { // all that follows from a value
    const waiting = [...readers[i]];
    while (waiting.length) {
      const call = waiting.pop();
      if (call.isStale) continue;
      call.isStale = true;
      for (const each of call.gives) waiting.push(...readers[each]);
    }
  }

  function value(i) {
    if (cells.has(i)) return column(cells.get(i).map(value));
    const call = maker[i];
    if (call?.isStale) {
      const taken = call.takes.map(value);
      if (call.rows) call.act(call.rows, ...call.gives.map(each => now[each]), ...taken);
      else now[i] = call.act(...taken);
      call.isStale = false;
    }
    return now[i];
  }

  return {
    keys: () => [...number.keys()],
    has: key => number.has(key),
    isInput: key => inputs.has(number.get(key)),
    isFixed: key => still.has(number.get(key)),
    know: values => { for (const [key, value] of Object.entries(values)) if (number.has(key)) now[number.get(key)] = Array.isArray(value) ? column(value) : value; },
    get: key => number.has(key) ? value(number.get(key)) : undefined, // a column is the model's own
    set(changes) {
      for (const [key, value] of Object.entries(changes)) {
        const i = number.get(key);
        if (!inputs.has(i)) throw new RangeError(key);
        if (Object.is(now[i], value)) continue;
        now[i] = value;
        spoil(i);
      }
    },
  };
}

function column(values) {
  return values.every(each => typeof each === "number") ? Float64Array.from(values) : [...values];
}
