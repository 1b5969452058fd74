/* A form that writes a problem file: group, body, forces, start, parameters. It edits the text of these tables, and leaves
 * all others and comments as they are. */
import { velocity } from "./completion.js";
import { about, declared, parameters, withDefault, withoutParameter } from "./declared.js";
import { make } from "./dom.js";
import { BODY, OTHERS, bodies, bodyOf, fitted, force, withBody } from "./made.js";
import { entry, lineAt, put, raw, tables, uncommented, withTable, without } from "./source.js";
import { listed, numeral, shown, toml } from "./values.js";

const FORCES = ["potential", "input", "damping"], MOST = 16;
const SHOWN = ["", ...BODY, ...FORCES, "parameters", "initial"];

export class Form {
  constructor(place, schema, changed) {
    Object.assign(this, { place, schema, changed, text: "", faults: [], forgotten: new Map(), bodies: new Map(), unread: new Map() });
    place.addEventListener("submit", (e) => e.preventDefault());
    document.addEventListener("faults", (e) => {
      this.faults = e.detail;
      if (place.hidden) return;
      if (this.unreadable !== this.broken) this.show(this.words);
      else this.mark();
    });
    document.addEventListener("text", (e) => { this.latest = e.detail; });
    document.addEventListener("go", (e) => {
      if (!place.hidden) this.go(e.detail);
    });
  }

  get broken() { return this.faults.some((x) => x.message.includes(": not TOML: ")); }

  /* the text as it is now; a button alone where its last derivation found that it is no TOML */
  show(words) {
    const text = this.latest ?? "";
    if (text !== this.text) for (const x of [this.forgotten, this.bodies, this.unread]) x.clear();
    Object.assign(this, { words, text, unreadable: this.broken });
    if (text && !this.broken) return this.draw();
    const afresh = make("button", { type: "button", click: () => {
      if (!text.trim() || confirm(words.sure)) this.write(this.schema.scaffold);
    } }, words.start);
    return this.place.replaceChildren(make("p", { role: "alert" }, words.unread), afresh);
  }

  /* another text, as it is */
  write(text) {
    this.text = text;
    this.changed(text);
    this.draw();
  }

  /* another text that an edit of a field made */
  edit(text) { this.write(declared(this.text, text, this.forgotten)); }

  get group() {
    const name = shown(raw(this.text, tables(this.text)[0], "group"));
    return { name, ...this.schema.groups[name] };
  }

  /* ---- fields */

  field(label, mark, value, put_, more = {}) {
    const input = make("input", { ...more, "data-mark": mark, change: () => put_(input.value) });
    input.value = value;
    return make("label", {}, `${label} `, input);
  }

  /* of a key of the k-th table */
  key(k, key, label = this.words.keys[key] ?? key) {
    const own = tables(this.text)[k], value = raw(this.text, own, key);
    const list = this.schema.lists.includes(key) || listed(value) !== null;
    const few = key === "frame" || key === "direction" ? this.schema.values[key] : null;
    if (few) return this.choice(label, few, shown(value) || few[0], (x) => this.edit(put(this.text, k, key, JSON.stringify(x))), `${k}.${key}`);
    const hint = list ? { title: this.words.semicolons } : {};
    return this.field(label, `${k}.${key}`, shown(value), (x) => this.edit(put(this.text, k, key, ["name", "title"].includes(key) ? x.trim() ? JSON.stringify(x.trim()) : undefined : toml(x, list))), hint);
  }

  choice(label, values, value, put_, mark) {
    const option = (x) => make("option", { value: x }, this.words.keys[x] ?? this.words[x] ?? x);
    const select = make("select", { "data-mark": mark ?? false, change: () => put_(select.value) }, ...values.map((x) => (Array.isArray(x) ? make("optgroup", { label: x[0] }, ...x[1].map(option)) : option(x))));
    select.value = value;
    return make("label", {}, `${label} `, select);
  }

  /* the number of a parameter, with a comma or a point; what is none is told beside it, is not written, and stays there
   * with what is told until it is one, whatever is drawn or derived meanwhile */
  number(label, k, key, value, put_, more) {
    return this.field(label, `${k}.${key}`, this.unread.get(key) ?? value, (typed) => {
      const x = typed.trim() ? numeral(typed) : "";
      if (x === null) this.unread.set(key, typed);
      else this.unread.delete(key);
      return x === null ? this.mark() : put_(x);
    }, { inputmode: "decimal", ...more });
  }

  /* a table of several with its number, its keys, and a button to take it away */
  row(name, k, count, keys) {
    const { words } = this;
    return make("div", { class: "table", role: "group", "aria-label": `${name} ${count}`, "data-table": k }, make("strong", {}, name === words.point ? `${name} ${count}` : name), ...keys.map((x) => this.key(k, x)),
      make("button", { type: "button", class: "quiet", "aria-label": `${words.remove} ${name} ${count}`, click: () => this.edit(without(this.text, k)) }, "✕"));
  }

  /* ---- its parts */

  head() {
    const { words, group, schema } = this, families = {};
    for (const x of schema.named) (families[x.split("(")[0]] ??= []).push(x);
    const others = group.name && !schema.groups[group.name] ? [group.name] : [];
    const chosen = this.choice(words.group, [...others, ...Object.entries(families)], group.name, (x) => this.edit(fitted(put(this.text, 0, "group", JSON.stringify(x)), group.n, schema)), "0.group");
    return make("fieldset", {}, this.key(0, "name", words.name), this.key(0, "title"), ...(group.name ? [chosen] : []));
  }

  body(all) {
    const { words, schema, group } = this, kind = bodyOf(this.text), made = bodies(group.n ?? 3);
    if (all.some((x) => OTHERS.includes(x.name)) || all[0].entries.some((x) => BODY.includes(x.key))) return [];
    const change = (x) => {
      this.bodies.set(kind, all.filter((y) => BODY.includes(y.name)).map((y) => uncommented(this.text.slice(y.from, y.to))).join("\n"));
      this.edit(withBody(this.text, this.bodies.get(x) || made[x]));
    };
    const count = { point: 0, solid: 0 };
    const rows = all.flatMap((x, k) => {
      if (x.name === "point" && x.many) return [this.row(words.point, k, ++count.point, ["mass", "at", ...(group.name.includes(" x ") ? ["block"] : [])])];
      const said = x.name === "body" ? "solid" : "kind", sizes = schema.solid[shown(raw(this.text, x, said))];
      if ((x.name !== "body" && x.name !== "solid") || !sizes) return [];
      const kinds = this.choice(words.keys.kind ?? words.kind, Object.keys(schema.solid).filter((y) => y !== "mesh"), shown(raw(this.text, x, said)), (y) => this.edit(this.resized(k, said, y)), `${k}.${said}`);
      const keys = sizes.filter((y) => !["rotation", "shift", "quadric"].includes(y) || entry(x, y)).filter((y) => y !== "semi_axes" || !entry(x, "quadric"));
      return [make("div", { class: "table", role: "group", "aria-label": words.solid, "data-table": k }, kinds, ...keys.map((y) => this.key(k, y)))];
    });
    const add = make("button", { type: "button", class: "quiet", click: () => this.edit(withTable(this.text, `[[point]]\nmass = "m"\nat = [${Array(group.n ?? 3).fill(0).join(", ")}]`, rows.length ? ["point"] : ["", "parameters"])) }, words.addpoint);
    const choice = this.choice(words.madeof, [...Object.keys(made), ...(kind in made ? [] : [kind])], kind, change);
    return [make("fieldset", {}, make("legend", {}, words.body), choice, ...rows, ...(kind === "points" || count.point ? [add] : []))];
  }

  /* a solid of another kind, with the sizes that this has */
  resized(k, said, kind) {
    let text = put(this.text, k, said, JSON.stringify(kind));
    const keys = Object.values(this.schema.solid).flat(), own = this.schema.solid[kind];
    for (const { key } of tables(text)[k].entries) if (keys.includes(key) && !own.includes(key)) text = put(text, k, key);
    const fresh = { sides: '["a", "b", "c"]', semi_axes: '["a", "b", "c"]', vertices: "[[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]]", outer: '"a"', inner: '"b"' };
    for (const key of own) {
      if (["density", "rotation", "shift", "quadric"].includes(key) || entry(tables(text)[k], key)) continue;
      text = put(text, k, key, fresh[key] ?? JSON.stringify(key[0]));
    }
    return text;
  }

  forces(all) {
    const { words, schema, group } = this, count = {};
    const rows = all.flatMap((x, k) => {
      if (!FORCES.includes(x.name) || !x.many) return [];
      const kind = shown(raw(this.text, x, "kind")), keys = schema[x.name]?.[kind] ?? schema.tables[x.name] ?? [];
      count[x.name] = (count[x.name] ?? 0) + 1;
      const points = all.some((y) => y.name === "point"), own = (y) => entry(x, y);
      const fits = (y) => own(y) || (y === "at" ? !points && !own("on") && !own("between") : y === "on" || y === "between" ? points && !own("at") : y !== "block");
      return [this.row(words.keys[kind] ?? words.keys[x.name] ?? kind, k, count[x.name], keys.filter(fits))];
    });
    const stated = all.some((x) => OTHERS.includes(x.name)), potentials = Object.keys(schema.potential).map((x) => `potential.${x}`);
    const kinds = stated ? ["input.covector"] : [...potentials, ...Object.keys(schema.input).map((x) => `input.${x}`), "damping"];
    const add = make("select", { "aria-label": words.addforce, change: () => this.edit(withTable(this.text, force(this.text, add.value, group.n ?? 3), [...FORCES, ...BODY, ...OTHERS])) },
      make("option", { value: "" }, `${words.addforce} …`), ...kinds.map((x) => make("option", { value: x }, words.keys[x.split(".").at(-1)] ?? x)));
    if (all.some((x) => x.name === "fluid")) return [];
    return [make("fieldset", {}, make("legend", {}, words.potentials), ...rows, add)];
  }

  start(all) {
    const { words } = this, k = all.findIndex((x) => x.name === "initial"), own = all[k];
    const has = own?.entries.map((x) => x.key) ?? [], names = [...new Set([...velocity(this.schema, this.text), ...has])];
    const few = names.length > MOST ? names.filter((x, j) => j < MOST || has.includes(x)) : names;
    if (!few.length) return [];
    const set = (name, typed) => {
      const value = toml(typed, name === "exp");
      if (!own) return this.edit(value === undefined ? this.text : withTable(this.text, `[initial]\n${name} = ${value}`));
      const text = put(this.text, k, name, value);
      return this.edit(tables(text)[k].entries.length ? text : without(text, k));
    };
    return [make("fieldset", {}, make("legend", {}, words.startsat), ...few.map((name) => this.field(name, `${k}.${name}`, own ? shown(raw(this.text, own, name)) : "", (x) => set(name, x), { inputmode: name === "exp" ? false : "decimal" })))];
  }

  parameters(all) {
    const { words } = this, k = all.findIndex((x) => x.name === "parameters"), own = parameters(this.text);
    if (!own.length) return [];
    return [make("fieldset", {}, make("legend", {}, words.parameters), ...own.map(({ key, begin, end }) => {
      const value = this.text.slice(begin, end), told = about(value);
      const set = (x) => this.write(put(this.text, k, key, withDefault(value, x)));
      const label = told.unit ? `${key} (${told.unit})` : key;
      return make("span", { class: "box" }, this.number(label, k, key, told.default, set, { title: told.meaning ?? false }),
        make("button", { type: "button", class: "quiet", "aria-label": `${words.remove} ${key}`, click: () => this.write(withoutParameter(this.text, key)) }, "✕"));
    }))];
  }

  draw() {
    const all = tables(this.text), focus = document.activeElement?.dataset?.mark, { words } = this;
    const rest = new Set(all.filter((x) => !SHOWN.includes(x.name) || (x.name === "body" && bodyOf(this.text) === "given")).map((x) => (x.many ? `[[${x.name}]]` : `[${x.name}]`)));
    for (const x of all[0].entries) if (!["name", "title", "group"].includes(x.key) || this.text[x.begin] === "{") rest.add(x.key);
    const kept = rest.size ? [make("p", { class: "warning" }, words.kept([...rest].join(", ")))] : [];
    this.place.replaceChildren(this.head(), ...this.body(all), ...this.forces(all), ...this.start(all), ...this.parameters(all), ...kept);
    if (focus && this.place.contains(document.activeElement) === false) this.at(focus)?.focus();
    this.mark();
  }

  /* ---- what is wrong */

  at(mark) { return this.place.querySelector(`[data-mark="${CSS.escape(mark)}"]`); }

  /* the field, or the row, that a line of the text is of */
  where(line) {
    const all = tables(this.text), k = all.findLastIndex((x) => lineAt(this.text, x.from) <= line && x.to);
    const found = all[k]?.entries.find((x) => lineAt(this.text, x.from) <= line && line <= lineAt(this.text, x.end));
    return (found && this.at(`${k}.${found.key}`)) ?? this.place.querySelector(`[data-table="${k}"] input`);
  }

  tell(input, message) {
    const id = `fault-${input.dataset.mark}`;
    this.place.querySelector(`#${CSS.escape(id)}`)?.remove();
    input.setAttribute("aria-invalid", "true");
    input.setAttribute("aria-describedby", id);
    input.closest("label").after(make("span", { id, class: "error", role: "alert" }, message));
  }

  mark() {
    for (const x of this.place.querySelectorAll("[aria-invalid]")) x.removeAttribute("aria-invalid");
    for (const x of this.place.querySelectorAll("span.error")) x.remove();
    for (const { line, message } of this.faults) {
      const input = this.where(line);
      if (input) this.tell(input, message.replace(/^derive: (\S+\.toml: )?/, ""));
    }
    const k = tables(this.text).findIndex((x) => x.name === "parameters");
    for (const [key, typed] of this.unread) {
      const input = this.at(`${k}.${key}`);
      if (input) this.tell(input, this.words.nonumber(typed.trim()));
      else this.unread.delete(key);
    }
  }

  go(line) {
    const input = this.where(line);
    if (input) input.focus();
    else document.getElementById("as-text")?.click();
  }
}
