/* A problem as one sentence, made of its tables and of phrases by their keys: its numbers are dragged, moved by the arrow
 * keys or typed, its words chosen. It edits the text as the form does. */
import { about, parameters, withDefault } from "./declared.js";
import { make } from "./dom.js";
import { Form } from "./form.js";
import { fitted } from "./made.js";
import { entry, put, raw, tables } from "./source.js";
import { listed, names, numeral, shown } from "./values.js";

const FORCES = ["potential", "input", "damping"], SAID = ["", "lagrangian", "body", "solid", "point", ...FORCES, "parameters", "initial"];
/* a cone that is turned over and lifted by its height stands on its apex */
const OVER = "[[1,0,0],[0,-1,0],[0,0,-1]]";
const WORDLESS = ["name", "kind", "solid", "on", "between", "block", "frame", "direction"];

export class Sentence extends Form {
  get phrases() { return this.words.phrases; }

  /* a number: written(x) is the text with another one */
  drag(label, mark, value, written, unit = "") {
    const sized = (e) => { e.style.width = `${Math.max(e.value.length, 1) + 1}ch`; };
    const put_ = (x) => {
      for (const e of this.place.querySelectorAll(`[data-mark="${CSS.escape(mark)}"]`)) {
        e.value = x;
        sized(e);
      }
      this.text = written(x);
      this.changed(this.text);
    };
    const from = (start, by) => {
      const x = Number(start), step = 10 ** Math.floor(Math.log10(Math.abs(x) || 1) - 1);
      return String(Number((step * Math.round(x / step + by)).toPrecision(9)));
    };
    let held = null;
    const input = make("input", {
      inputmode: "decimal", "aria-label": label, title: label, "data-mark": mark, autocomplete: "off",
      input: () => sized(input),
      change: () => {
        const x = numeral(input.value);
        input.setAttribute("aria-invalid", String(x === null));
        if (x !== null) put_(x);
      },
      keydown: (e) => {
        const by = { ArrowUp: 1, ArrowDown: -1, PageUp: 10, PageDown: -10 }[e.key];
        if (!by) return;
        e.preventDefault();
        put_(from(numeral(input.value) ?? value, by));
      },
      pointerdown: (e) => {
        held = [e.clientX, numeral(input.value) ?? value, false];
        input.setPointerCapture(e.pointerId);
      },
      pointermove: (e) => {
        if (!held || !(held[2] ||= Math.abs(e.clientX - held[0]) > 4)) return;
        put_(from(held[1], Math.round((e.clientX - held[0]) / 4)));
      },
      pointerup: () => { held = null; },
      pointercancel: () => { held = null; },
    });
    input.value = value;
    sized(input);
    return make("label", { class: "token" }, input, unit && ` ${unit.replace(/\^([23])/g, (_, x) => "²³"[x - 2])}`);
  }

  /* the number of a parameter */
  parameter(name, label) {
    const k = tables(this.text).findIndex((x) => x.name === "parameters");
    const value = raw(this.text, tables(this.text)[k], name), told = about(value);
    this.told.add(name);
    return this.drag(told.meaning ?? label, `${k}.${name}`, told.default, (x) => put(this.text, k, name, withDefault(raw(this.text, tables(this.text)[k], name), x)), told.unit);
  }

  /* a number, a parameter that has one, or an expression, whose names are told behind */
  atom(x, label, mark, written) {
    if (numeral(x) !== null) return this.drag(label, mark, x, written);
    const own = parameters(this.text).find(({ key }) => key === x);
    if (own && about(this.text.slice(own.begin, own.end)).default) return this.parameter(x, label);
    for (const name of names(x)) this.left.add(name);
    return make("code", {}, x);
  }

  /* the value of a key of the k-th table */
  value(k, key, label) {
    const value = raw(this.text, tables(this.text)[k], key), all = listed(value);
    if (!all) return [this.atom(shown(value), label, `${k}.${key}`, (x) => put(this.text, k, key, x))];
    const list = (i, x) => `[${all.map((y, j) => (j === i ? x : numeral(y) ?? JSON.stringify(y))).join(", ")}]`;
    return ["(", ...all.flatMap((y, i) => [i ? ", " : "", this.atom(y, label, `${k}.${key}${i ? `.${i}` : ""}`, (x) => put(this.text, k, key, list(i, all[i] = x)))]), ")"];
  }

  /* "of radius 0.03 m, of height 0.05 m" */
  keys(k, skip = []) {
    const own = tables(this.text)[k].entries.map((x) => x.key).filter((x) => !WORDLESS.includes(x) && !skip.includes(x));
    return own.flatMap((key, i) => {
      const label = this.phrases.of[key] ?? this.words.keys[key] ?? this.words[key] ?? key;
      return [i && key !== "at" ? ", " : " ", `${label} `, ...this.value(k, key, label)];
    });
  }

  /* one of some phrases, chosen by its key */
  word(label, phrases, value, put_, mark) {
    const known = value in phrases ? Object.keys(phrases) : [value, ...Object.keys(phrases)];
    const select = make("select", { "aria-label": label, "data-mark": mark, change: () => put_(select.value) }, ...known.map((x) => make("option", { value: x }, phrases[x] ?? x)));
    select.value = value;
    return make("label", { class: "token" }, select);
  }

  /* what the body is: solids, points, or what stands for them */
  what(all) {
    const { phrases, words } = this;
    const found = all.flatMap((x, k) => {
      const said = x.name === "body" ? "solid" : "kind", kind = shown(raw(this.text, x, said));
      if (x.name === "point" && x.many) return [[phrases.point, ...this.keys(k)]];
      if (x.name === "lagrangian" && entry(x, "L")) return [[phrases.lagrangian, " ", ...this.value(k, "L", "L")]];
      if (!["body", "solid"].includes(x.name)) return [];
      const upright = kind === "cone" && raw(this.text, x, "rotation")?.replace(/\s/g, "") === OVER && listed(raw(this.text, x, "shift"))?.[2] === shown(raw(this.text, x, "height"));
      const keys = upright ? [...this.keys(k, ["rotation", "shift"]), phrases.apex] : this.keys(k);
      if (kind in phrases.solid) return [[this.word(words.solid, phrases.solid, kind, (y) => this.edit(this.resized(k, said, y)), `${k}.${said}`), ...keys]];
      return [[phrases.moments]];
    });
    if (found.length > 1) return [phrases.made, ...joined(found, phrases.and)];
    const [first = [phrases.system]] = found;
    for (const x of first[0].querySelectorAll?.("option") ?? []) x.textContent = capital(x.textContent);
    return [typeof first[0] === "string" ? capital(first[0]) : first[0], ...first.slice(1)];
  }

  moves(all) {
    const { phrases, words, schema } = this, name = shown(raw(this.text, all[0], "group"));
    const n = schema.groups[name]?.n;
    const set = (x) => this.edit(fitted(put(this.text, 0, "group", JSON.stringify(x)), n, schema));
    return name ? [" ", this.word(words.group, phrases.group, name, set, "0.group")] : [];
  }

  forces(all) {
    const { phrases, words } = this;
    const found = all.flatMap((x, k) => {
      if (!FORCES.includes(x.name) || !x.many) return [];
      const kind = shown(raw(this.text, x, "kind")) || x.name, name = shown(raw(this.text, x, "name"));
      const keys = this.keys(k);
      return [[phrases.force[kind] ?? words.keys[kind] ?? kind, ...(name ? [" ", make("code", {}, name)] : []), ...(keys.length ? [" (", ...keys.slice(1), ")"] : [])]];
    });
    return found.length ? [phrases.under, ...joined(found, phrases.and)] : [];
  }

  start(all) {
    const k = all.findIndex((x) => x.name === "initial");
    const found = (all[k]?.entries ?? []).map(({ key }) => [make("code", {}, key), " = ", ...this.value(k, key, key)]);
    return found.length ? [this.phrases.starts, ...joined(found, this.phrases.and)] : [];
  }

  where() {
    const found = [...this.left].filter((x) => !this.told.has(x) && parameters(this.text).some(({ key }) => key === x));
    return found.length ? [this.phrases.where, ...joined(found.map((x) => [make("code", {}, x), " = ", this.parameter(x, x)]), this.phrases.and)] : [];
  }

  draw() {
    Object.assign(this, { told: new Set(), left: new Set() });
    const all = tables(this.text), focus = document.activeElement?.dataset?.mark;
    const rest = [...new Set(all.filter((x) => !SAID.includes(x.name)).map((x) => (x.many ? `[[${x.name}]]` : `[${x.name}]`)))];
    const parts = [...this.what(all), ...this.moves(all), ...this.forces(all), ...this.start(all), ...this.where(), "."];
    this.place.replaceChildren(make("p", {}, ...parts), ...(rest.length ? [make("p", { class: "warning" }, this.words.kept(rest.join(", ")))] : []));
    if (focus) this.at(focus)?.focus();
    this.mark();
  }
}

/* "a, b and c" */
function joined(all, and) {
  return all.flatMap((x, i) => [i === 0 ? "" : i === all.length - 1 ? ` ${and} ` : ", ", ...x]);
}

const capital = (x) => x[0].toUpperCase() + x.slice(1);
