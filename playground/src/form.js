/* A form that writes a problem file: group, body, forces, parameters. It shows what it can write, and no other file. */
import { make } from "./dom.js";

const TOP = ["name", "title", "group", "parameters", "point", "body", "solid", "potential"];
const KINDS = { gravity: ["g"], spring: ["between", "on", "anchor", "stiffness", "length"], attraction: ["strength", "centre"], expression: ["U"] };
const SIZES = { ball: ["radius"], box: ["sides"], cylinder: ["radius", "height"], cone: ["radius", "height"], ellipsoid: ["semi_axes"], hollow_ball: ["outer", "inner"] };
const WORDS = "sin cos tan exp log sqrt abs t pi";

const quoted = (x) => JSON.stringify(String(x));
const number = (x) => typeof x === "number" || /^[-+]?\d+(\.\d+)?$/.test(x);
const atom = (x) => (number(x) ? String(x) : quoted(x));
const list = (x) => String(x).split(",").map((y) => y.trim()).filter(Boolean);
const written = (key, x) => (Array.isArray(x) ? `${key} = [${x.map(atom).join(", ")}]` : `${key} = ${atom(x)}`);

/* may the form write this file without leaving anything out? */
export function fits(data) {
  if (!data || !Object.keys(data).every((x) => TOP.includes(x)) || typeof data.group !== "string") return false;
  const flat = (x) => (Array.isArray(x) ? x.every((y) => typeof y !== "object") : typeof x !== "object");
  const plain = (table, keys) => Object.entries(table).every(([key, x]) => keys.includes(key) && flat(x));
  const { point = [], solid = [], body, potential = [], parameters = {} } = data;
  return point.every((x) => plain(x, ["mass", "at"]))
    && solid.length <= 1 && solid.every((x) => x.kind in SIZES && plain(x, ["kind", "density", ...SIZES[x.kind]]))
    && (!body || plain(body, ["moments"]) || body.solid in SIZES && plain(body, ["solid", "density", ...SIZES[body.solid]]))
    && potential.every((x) => x.kind in KINDS && plain(x, ["kind", ...KINDS[x.kind]]))
    && Object.values(parameters).every((x) => flat(x) || plain(x, ["default", "unit", "meaning"]));
}

/* the text of a file with these data */
export function toml(data) {
  const out = [`name = ${quoted(data.name)}`, ...(data.title ? [`title = ${quoted(data.title)}`] : []), `group = ${quoted(data.group)}`, ""];
  const table = (header, entries) => out.push(header, ...Object.entries(entries).filter(([, x]) => x !== "" && x !== undefined).map(([k, x]) => written(k, x)), "");
  const names = used(data);
  if (names.length) {
    out.push("[parameters]");
    for (const name of names) {
      const about = data.parameters?.[name] ?? {};
      const plain = typeof about === "object" ? about : { default: about };
      const inside = Object.entries(plain).filter(([, x]) => x !== "" && x !== null).map(([k, x]) => written(k, x));
      out.push(`${name} = { ${inside.join(", ")} }`.replace("{  }", "{}"));
    }
    out.push("");
  }
  if (data.body) table("[body]", data.body);
  for (const x of data.solid ?? []) table("[[solid]]", x);
  for (const x of data.point ?? []) table("[[point]]", x);
  for (const x of data.potential ?? []) table("[[potential]]", x);
  return `${out.join("\n").trim()}\n`;
}

/* the names in all expressions, which are parameters */
function used(data) {
  const texts = [data.body, ...(data.solid ?? []), ...(data.point ?? []), ...(data.potential ?? [])].filter(Boolean)
    .flatMap((x) => Object.entries(x).filter(([key]) => !["kind", "solid", "moments"].includes(key)).flatMap(([, y]) => y)).map(String);
  const found = new Set(texts.flatMap((x) => x.match(/[A-Za-z]\w*/g) ?? []));
  const known = new Set(WORDS.split(" "));
  const kept = [...found].filter((x) => !known.has(x) && !/^r\d+_\w$/.test(x));
  return [...new Set([...Object.keys(data.parameters ?? {}), ...kept])];
}

export class Form {
  constructor(place, groups, changed) {
    Object.assign(this, { place, changed });
    this.groups = Object.entries(groups).flatMap(([name, [least, most]]) => [2, 3, 4].filter((n) => n >= least && n <= most).map((n) => `${name}(${n})`));
    place.addEventListener("submit", (e) => e.preventDefault());
  }

  show(data, words) {
    this.words = words;
    this.data = fits(data) ? structuredClone(data) : null;
    if (!this.data) {
      const afresh = make("button", { type: "button", click: () => {
        this.data = { name: "mine", group: "SO(3)", point: [{ mass: "m", at: ["a", 0, 0] }, { mass: "m", at: [0, "b", 0] }, { mass: "m", at: [0, 0, "c"] }] };
        this.write(true);
      } }, words.start);
      this.place.replaceChildren(make("p", {}, words.formonly), afresh);
      return;
    }
    this.draw();
  }

  write(anew = false) {
    this.changed(toml(this.data));
    if (anew) this.draw();
  }

  field(label, value, put, more = {}) {
    const input = make("input", { ...more, change: () => { put(input.value.trim()); this.write(); } });
    input.value = Array.isArray(value) ? value.join(", ") : value ?? "";
    return make("label", {}, `${label} `, input);
  }

  choice(label, values, value, put) {
    const select = make("select", { change: () => { put(select.value); this.write(true); } }, ...values.map((x) => make("option", { value: x }, this.words[x] ?? x)));
    select.value = value;
    return make("label", {}, `${label} `, select);
  }

  /* a table of a list, by its keys, with a button to take it away */
  table(name, list_, k, keys, lists) {
    const x = list_[k], { words } = this;
    return make("div", { class: "table", role: "group", "aria-label": `${name} ${k + 1}` }, ...keys.map((key) => this.field(words[key] ?? key, x[key], (v) => {
      if (v) x[key] = lists.includes(key) ? list(v) : v;
      else delete x[key];
    })), make("button", { type: "button", class: "quiet", "aria-label": `${words.remove} ${name} ${k + 1}`, click: () => { list_.splice(k, 1); this.write(true); } }, "✕"));
  }

  draw() {
    const { data, words } = this, group = this.groups.includes(data.group) ? this.groups : [data.group, ...this.groups];
    const kind = data.point?.length ? "points" : data.body?.moments ? "moments" : "solid";
    const solid = data.solid?.[0] ?? data.body ?? {}, key = data.solid ? "kind" : "solid", n = Number(data.group.match(/\((\d)/)?.[1] ?? 3);
    const bodies = {
      points: () => ({ point: [{ mass: "m", at: ["a", ...Array(n - 1).fill(0)] }] }),
      moments: () => ({ body: { moments: "symbolic" } }),
      solid: () => ({ body: { solid: "box", density: "rho", sides: ["a", "b", "c"] } }),
    };
    const set = (made) => {
      for (const x of ["point", "body", "solid"]) delete data[x];
      Object.assign(data, made);
    };
    const body = kind === "points" ? [
      ...data.point.map((_, k) => this.table(words.point, data.point, k, ["mass", "at"], ["at"])),
      make("button", { type: "button", class: "quiet", click: () => { data.point.push({ mass: "m", at: Array(n).fill(0) }); this.write(true); } }, `${words.add}: ${words.point}`),
    ] : kind === "solid" ? [
      this.choice(words.kind, Object.keys(SIZES), solid[key], (v) => { set({ body: { solid: v, density: solid.density ?? "rho", ...Object.fromEntries(SIZES[v].map((x) => [x, x.endsWith("s") && x !== "radius" ? ["a", "b", "c"] : x])) } }); }),
      ...["density", ...SIZES[solid[key]]].map((x) => this.field(words[x] ?? x, solid[x], (v) => { solid[x] = v.includes(",") ? list(v) : v; })),
    ] : [];
    const forces = data.potential ??= [];
    const fresh = { gravity: { g: [...Array(n - 1).fill(0), "-g"] }, spring: { on: 1, anchor: Array(n).fill(0), stiffness: "k", length: 0 }, attraction: { strength: "mu", centre: [...Array(n - 1).fill(0), "R"] }, expression: { U: "k*r1_x^2" } };
    const add = make("select", { "aria-label": `${words.add}: ${words.potentials}`, change: () => { forces.push({ kind: add.value, ...structuredClone(fresh[add.value]) }); this.write(true); } },
      make("option", { value: "" }, `${words.add} …`), ...Object.keys(fresh).map((x) => make("option", { value: x }, x)));
    const names = used(data);
    const value = (name) => { const x = data.parameters?.[name]; return typeof x === "object" ? x.default : x; };
    this.place.replaceChildren(
      make("fieldset", {}, this.field(words.name, data.name, (v) => { data.name = v; }), this.choice(words.group, group, data.group, (v) => { data.group = v; })),
      make("fieldset", {}, make("legend", {}, words.body), this.choice(words.body, Object.keys(bodies), kind, (v) => set(bodies[v]())), ...body),
      make("fieldset", {}, make("legend", {}, words.potentials), ...forces.map((x, k) => this.table(x.kind, forces, k, KINDS[x.kind], ["g", "between", "anchor", "centre"])), add),
      ...(names.length ? [make("fieldset", {}, make("legend", {}, words.parameters), ...names.map((name) => this.field(name, value(name), (v) => {
        const about = (data.parameters ??= {})[name];
        const plain = typeof about === "object" ? { ...about } : {};
        if (v === "") delete plain.default;
        else plain.default = Number(v);
        data.parameters[name] = plain;
      }, { type: "number", step: "any" })))] : []),
    );
  }
}
