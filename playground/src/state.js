/* How the numbers of a velocity are called, by the group of a problem file. */

/* of a text: those of a named group; where its Lagrangian is stated, one letter for all */
export function velocity(schema, text) {
  const name = text.match(/^\s*group\s*=\s*"([^"]*)"/m)?.[1] ?? text.match(/^\s*of\s*=\s*"([^"]*)"/m)?.[1] ?? "";
  const factors = name.split(/\s*[x×]\s*(?=[A-Z])/).map((x) => schema.groups[x.replaceAll(" ", "")]);
  if (factors.some((x) => !x)) return [];
  const stated = /^\s*\[\s*(lagrangian|inertia)\s*\]/m.test(text), d = factors.reduce((sum, x) => sum + x.d, 0);
  const shift = factors.length === 1 && !stated ? factors[0].w : 0;
  const counted = (letter, count) => Array.from({ length: count }, (_, k) => `${letter}_${k + 1}`);
  return [...counted("zeta", d - shift), ...counted("w", shift)];
}
