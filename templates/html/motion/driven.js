/* The module with inputs in time: each of page.signals, of input i an expression u of t, or values at times with lines between
 * them unless they are held, goes on until the reader sets the input to another number than it has on the page. */
function driven(module, page) {
  let p = [], signals = [];
  const number = (tree, t) => valued({ PARAMETERS: [...module.PARAMETERS, "t"] }, [...p, t]).number(tree);
  const value = ({ u, times, values, held }, t) => {
    if (!times) return number(u, t);
    const k = max(0, times.findLastIndex((x) => x <= t)), far = (t - times[k]) / (times[k + 1] - times[k]);
    return values[k] + (far && !held ? far * (values[k + 1] - values[k]) : 0);
  };
  const at = (t, given) => {
    const u = [...given];
    for (const x of signals) if (u[x.i] === page.u[x.i]) u[x.i] = value(x, t);
    return u;
  };
  const timed = ["rhs", "outputs", "multiplier"].filter((f) => module[f]).map((f) => [f, (t, x, k, u) => module[f](t, x, k, at(t, u))]);
  return {
    ...module, ...Object.fromEntries(timed),
    constants(parameters) {
      p = parameters;
      signals = page.signals.map(({ times, values, ...x }) => ({ ...x, times: times?.map(number), values: values?.map(number) }));
      return module.constants(p);
    },
    gauss_to(m, k, u, end, tol) {
      m.inputs = (t) => at(t, u);
      const stops = signals.flatMap((x) => x.times ?? []).filter((t) => t > m.t && t < end).sort((a, b) => a - b);
      return [...stops, end].reduce((fault, t) => fault || module.gauss_to(m, k, u, t, tol), 0);
    },
  };
}
