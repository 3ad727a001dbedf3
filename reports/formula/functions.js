// The functions of the formula language that JavaScript has not, by their names in it.
const fourier = turn => (column, degrees, order) => { // the last row repeats the first
  let sum = 0;
  for (let i = 0; i < column.length - 1; i++) sum += turn(order * (degrees[i] * Math.PI / 180)) * column[i];
  return 2 * sum / (column.length - 1);
};
const wave = turn => (...given) => {
  const order = given.at(-1), degrees = given.at(-2), weights = given.at(-3);
  let sum = 0;
  for (let i = 0; i < degrees.length; i++) sum += turn(order * (degrees[i] * Math.PI / 180)) * (weights ? weights[i] : 1);
  return sum;
};
const most = better => run => {
  let found = run[0];
  for (let i = 1; i < run.length; i++) if (better(run[i], found) || run[i] !== run[i]) found = run[i];
  return found;
};
const summed = (run, count) => {
  let sum = 0;
  for (let i = 0; i < count; i++) sum += run[i];
  return sum;
};
const within = (value, low, high) => Math.min(Math.max(value, low), high);

export const F = {
  rad: x => x * Math.PI / 180, deg: x => x * 180 / Math.PI,
  mod: (a, b) => { const rest = a % b; return rest && (rest < 0) !== (b < 0) ? rest + b : rest; },
  round: (x, decimals = 0) => { // halves away from zero
    const scale = 10 ** decimals;
    return Math.sign(x) * Math.floor(Math.abs(x) * scale + .5) / scale + 0;
  },
  round_up: x => Math.sign(x) * Math.ceil(Math.abs(x)) + 0,
  col_max: most((a, b) => a > b), col_min: most((a, b) => a < b), col_last: run => run[run.length - 1],
  col_sum: run => summed(run, run.length - 1), col_mean: run => summed(run, run.length - 1) / (run.length - 1),
  run_sum: run => summed(run, run.length),
  rank: (x, run) => run.reduce((place, each) => place + (each < x), 1),
  first_largest: run => run.indexOf(F.col_max(run)) + 1,
  place: (x, run) => { // a binary search; an angle that is none is beyond all
    let low = 0, high = run.length;
    while (low < high) {
      const middle = (low + high) >> 1;
      if (x < run[middle]) high = middle; else low = middle + 1;
    }
    return within(low, 1, run.length - 1);
  },
  element: (run, number) => run[within(Math.trunc(number) - 1, 0, run.length - 1)],
  following: (run, i) => run[Math.min(i + 1, run.length - 1)],
  previous: (run, i) => i ? run[i - 1] : 0,
  running_sum: (run, i) => summed(run, i + 1),
  fourier_cos: fourier(Math.cos), fourier_sin: fourier(Math.sin), wave_cos: wave(Math.cos), wave_sin: wave(Math.sin),
};
