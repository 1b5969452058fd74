/* What the form writes for a new body and a new force, and lists of another length where the group is another. */
import { declared } from "./declared.js";
import { entry, put, raw, tables, withTable, without } from "./source.js";
import { listed, shown, toml } from "./values.js";

/* what a body is stated by that is none of points */
export const OTHERS = ["lagrangian", "inertia", "algebra", "fluid"];

const zeros = (n) => Array(n).fill("0");
const list = (x) => toml(x.join(", "), true);

/* kind → its tables, in Rⁿ */
export const bodies = (n) => ({
  points: zeros(n).map((_, k) => `[[point]]\nmass = "m"\nat = ${list(zeros(n).map((x, j) => (j === k ? "abcdefhk"[k] : x)))}`).join("\n\n"),
  moments: '[body]\nmoments = "symbolic"',
  solid: '[body]\nsolid = "box"\ndensity = "rho"\nsides = ["a", "b", "c"]',
});

export const BODY = ["point", "body", "solid"];

/* a text with other tables of its body; its springs and forces on points stay, and are told where they fit no longer */
export function withBody(text, made) {
  for (let k = tables(text).length - 1; k > 0; --k) if (BODY.includes(tables(text)[k].name)) text = without(text, k);
  return withTable(text, made, ["", "parameters"]);
}

/* the line of a body that has the moments of a mesh, of some density */
export function stated({ m, c, J }) {
  const of = (x) => (x ? `"${x}*rho"` : "0");
  return `given = { m = ${of(m)}, c = [${c.map(of).join(", ")}], J = [${J.map((row) => `[${row.map(of).join(", ")}]`).join(", ")}] }`;
}

/* a problem called by a file, with the body of its line; a new one where the text has none in space */
export function meshed(text, line, schema, file) {
  const group = shown(raw(text, tables(text)[0], "group")), stated = tables(text).some((x) => OTHERS.includes(x.name));
  const before = schema.groups[group]?.n === 3 && !stated ? text : schema.scaffold;
  const name = file.replace(/\.\w+$/, "").replace(/\W+/g, "_").replace(/^[^A-Za-z]*/, "").slice(0, 60);
  const named = name ? put(put(before, 0, "name", JSON.stringify(name)), 0, "title") : before;
  return declared(before, withBody(named, `[body]\n${line}`), new Map([["rho", '{ default = 1000, unit = "kg/m^3", meaning = "density" }']]));
}

/* what the body of a text is: a kind of these, or "given" */
export function bodyOf(text) {
  const all = tables(text), body = all.find((x) => x.name === "body");
  if (entry(body, "moments")) return "moments";
  if (entry(body, "solid") || all.some((x) => x.name === "solid")) return "solid";
  return body ? "given" : "points";
}

/* the table of a new force: "potential.spring", "input.force", "damping" */
export function force(text, name, n) {
  const [section, kind] = name.split("."), all = tables(text);
  const points = all.filter((x) => x.name === "point").length, zero = list(zeros(n));
  const place = points ? "on = 1" : `at = ${zero}`, letter = `u${all.filter((x) => x.name === "input").length + 1}`;
  const rows = (entry_) => `[${zeros(n).map((_, i) => `[${zeros(n).map((__, j) => entry_(i, j)).join(", ")}]`).join(", ")}]`;
  const down = (x) => list([...zeros(n - 1), x]);
  const keys = {
    gravity: `g = ${down("-g")}`,
    spring: `${place}\nanchor = ${zero}\nstiffness = "k"\nlength = 0`,
    torsion: 'stiffness = "k"',
    attraction: `strength = "mu"\ncentre = ${down("R")}`,
    far_centre: `strength = "mu"\ncentre = ${down("R")}`,
    self_gravity: 'G = "G"',
    field: `E = ${down("E")}\ncharges = [${Array(Math.max(points, 1)).fill('"q"').join(", ")}]`,
    harmonic: `W = ${rows((i, j) => (i === j ? '"k"' : 0))}`,
    volume: 'U = "k*(det_A - 1)^2"',
    expression: `U = "k*r1_${n > 3 ? 1 : "x"}^2"`,
    covector: `name = "${letter}"`,
    force: `name = "${letter}"\n${place}`,
    torque: `name = "${letter}"`,
  };
  return section === "damping" ? `[[damping]]\ncoefficient = "kappa"${points ? "" : `\nat = ${zero}`}` : `[[${section}]]\nkind = "${kind}"\n${keys[kind]}`;
}

/* a text whose group is another: vectors of the space as long as its new dimension; of what is cut the last entry, if it is
 * not 0, is that of gravity */
export function fitted(text, before, schema) {
  const now = schema.groups[shown(raw(text, tables(text)[0], "group"))]?.n;
  if (!now || !before || now === before) return text;
  let made = text;
  tables(text).forEach((table, k) => {
    for (const key of ["at", "g", "anchor", "centre", "E"]) {
      const value = listed(raw(made, table && tables(made)[k], key));
      if (value?.length !== before) continue;
      const own = now > before ? [...value, ...zeros(now - before)] : value.slice(0, now);
      if (key === "g" && now > before && value.slice(0, -1).every((x) => x === "0")) own.splice(0, own.length, ...zeros(now - 1), value.at(-1));
      if (key === "g" && now < before && own.every((x) => x === "0")) own[now - 1] = value.at(-1);
      made = put(made, k, key, list(own));
    }
  });
  return made;
}
