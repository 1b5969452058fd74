/* A motion in an element of a page: mount(element, page, pieces) builds all that is seen, and returns
 * what moves it: { time, state, seek, play, pause, run, until, second, keep, scene, recolour }, and the numbers as they are: { given, trail }.
 *
 * page: { module: the emitted module, with gauss; x, p, u: the start, in the module's order;
 * t, tol: how long, how exact; entries: [row, column, place] of the element of the group in x, whose
 * order × order matrices have the basis, [row, column, entry] of each; names: { place: name } of what is
 * shown of x, adjusted: the places whose numbers can be set, curves: those drawn where no body is; lost: is the energy not kept?
 * outputs: the names of what is read off the motion, where there is some, panels: the places of those of one unit;
 * labels: { name: [meaning, unit] }; kept: { name: [words, unit] }; weightless: the names of what is kept
 * only where all of weight, trees, are 0; units: { t, energy }; body: see moving_body.py; words, comma }.
 * pieces: { stage, side, graph: what draws there; second: another motion beside this; turned_start; flattened, where a
 * group stretches; the shapes of the body, and what makes them }.
 * Texts of a problem come in as text, never as markup. */
function mount(element, page, pieces) {
  const { module, words } = page, aria = "aria-label";
  const still = matchMedia("(prefers-reduced-motion: reduce)").matches;
  const scheme = matchMedia("(prefers-color-scheme: dark)");

  /* ---- what is moved by the reader */

  const p = [...page.p], u = [...page.u], x0 = [...page.x], theta = page.basis.map(() => 0);
  const element_at = page.entries.map((e) => e[2]);
  const velocity = [...x0.keys()].filter((s) => !element_at.includes(s));
  const start = () => {
    const x = [...x0];
    if (theta.some((a) => a !== 0)) pieces.turned_start(page, x, theta);
    return x;
  };

  const energy = module.energy ?? (module.CONSERVED?.includes("energy")
    && ((t, x, k) => module.conserved(t, x, k)[module.CONSERVED.indexOf("energy")]));
  const scene = { page, p, u, velocity, energy, ask, run: null, other: null, trail: [], states, get time() { return time; }, redraw: () => scene.run && show(scene.run.at(time).slice(), before) };
  let run, time = 0, until = page.t, wanted = null, playing = false, cells = [], each = 0, first = {}, noise = {}, told = 0;
  let keeping = module, k = null;  // what gives the numbers that are kept, and its constants
  let moved;  // what gravity moves

  const message = make("p", { class: "message", role: "status" });
  const tell = (text, where = home) => {
    message.textContent = text;
    where.append(message);
  };
  let changed = "", place_of = null;
  function restart() {
    run = scene.run = null;
    try {
      run = scene.run = begun(page, p, u, start());
      const other = second?.start(start());
      scene.other = other ? begun(page, p, u, other) : null;
    } catch (e) {
      tell(`${words.singular}${changed}.`, place_of ?? home);
      for (const cell of table.querySelectorAll("td")) cell.textContent = "";
      pause();
    }
    element.classList.toggle("none", !run);
    if (!run) return;
    tell("");
    time = 0;
    for (const x of views) x.restart?.(run.at(0));
    cells = [];
    each = min(normal / 60, TURN / rate(0, run.at(0), run.k));
    begin_to_keep();
    tabulate();
    wanted = null;
    told = 0;
    ask();
  }

  function begin_to_keep() {
    k = keeping === module ? run.k : keeping.constants(p);
    moved = page.weight?.some((t) => valued(module, p).number(t)) && page.weightless;
    first = invariants(0, run.at(0));
    noise = {};
    for (const name of Object.keys(page.kept).filter((x) => x in first)) {
      const alike = Object.keys(first).filter((x) => page.kept[x]?.[1] === page.kept[name][1]).map((x) => abs(first[x]));
      noise[name] = max(page.tol * max(...alike), 1e-12 * max(...Object.values(first).map(abs)));
    }
  }

  function invariants(t, x) {
    const found = {};
    if (module.energy) found.energy = module.energy(t, x, run.k);
    const values = keeping.conserved?.(t, x, k);
    values?.forEach((v, i) => {
      const name = keeping.CONSERVED[i];
      const said = page.kept[name] ?? words[name];  // the module may keep more than the page has words for yet
      if (said && v === v && !(moved && moved.includes(name))) found[name] = v;  // a component along what is 0 is none
    });
    if (module.defect) found.defect = module.defect(x);
    if (module.multiplier) found.multiplier = module.multiplier(t, x, run.k, u);
    return found;
  }

  const stage = pieces.stage(scene, pieces), home = make("div", { class: "stage" }, stage.element, stage.legend ?? ""), side = pieces.side?.(scene, pieces), graph = pieces.graph?.(scene, page.in_time, page.apart), views = [stage, side, graph].filter(Boolean);

  /* ---- the frame */

  let asked = 0, before = 0;
  function ask() {
    asked ||= requestAnimationFrame(frame);
  }

  /* of both motions, where there are two */
  const runs = () => (scene.other ? [run, scene.other] : [run]);
  const last = () => min(...runs().map((x) => x.last));
  const over = () => runs().some((x) => x.ended) && time >= last();
  const reach = (t, late) => runs().map((x) => x.reach(t, late)).every(Boolean);
  function states(t) {
    return runs().map((x) => x.at(t).slice());
  }

  function frame(now) {
    asked = 0;
    if (!run) return;
    const late = performance.now() + 14;
    if (playing) {
      const by = min(0.1, (now - before) / 1000 || 1 / 60) * speed;
      const next = min(time + by, until);
      reach(next, late);
      time = min(next, last() >= next ? next : max(time, last()));
      if (time >= until && page.repeats && !scene.once) time = 0; // it begins again
      else if (time >= until || over()) pause();
    } else if (wanted !== null) {
      const ready = reach(wanted, late);
      time = min(wanted, last());
      if (ready || over()) wanted = null;
    }
    if (wanted === null) follow();
    before = now;
    show(run.at(time).slice(), now);
    if (playing || wanted !== null) ask();
  }

  /* The trail is the same however its last instant was reached: its instants are in cells of one length, up to FINE in one
   * where it turns fast, one for every TURN; it has the last cells in which there are no more than TRAIL, and now. */
  const TRAIL = 480, TURN = 0.15, FINE = 8;
  const places = element_at.length ? element_at : velocity;
  const large = (list) => max(...list.map(abs), 1e-12);
  const rate = (t, x, k) => {
    const rates = module.rhs(t, x, k, u);
    return large(places.map((s) => rates[s])) / large(places.map((s) => x[s]));
  };
  /* cell k, and in it what is past */
  const cell = (k) => grown({ k, count: max(1, min(FINE, ceil(each * rate(k * each, run.at(k * each), run.k) / TURN))), past: [] });
  function grown(of) {
    for (let i = of.past.length, t; i < of.count && (t = (of.k + i / of.count) * each) <= time; ++i) of.past.push([t, ...states(t)]);
    return of;
  }
  function follow() {
    const now = floor(time / each), from = cells.at(-1)?.k ?? Infinity;
    let size = 0;
    if (now < from || now - from > TRAIL) {
      cells = [];
      for (let k = now; k >= 0 && size <= TRAIL; --k) size += cells[cells.push(cell(k)) - 1].past.length;
      cells.reverse();
    } else {
      grown(cells.at(-1));
      for (let k = from + 1; k <= now; ++k) cells.push(cell(k));
      size = cells.reduce((sum, x) => sum + x.past.length, 0);
    }
    while (size > TRAIL) size -= cells.shift().past.length;
    scene.trail = [...cells.flatMap((x) => x.past), [time, ...states(time)]];
  }

  function show(x, now) {
    for (const view of views) view.draw(x);
    clock.textContent = ["t =", mark(time.toFixed(digits), page), page.units.t].join(" ");
    if (document.activeElement !== slider || playing) slider.value = time / until * 1000;
    slider.setAttribute("aria-valuetext", clock.textContent);
    if (now - told > 90 || !playing) {
      told = now;
      for (const [name, v] of Object.entries(invariants(time, x))) {
        const [value, change] = rows[name];
        value.textContent = name in noise && abs(v) < noise[name] ? "0" : shown(v, page, name === "defect" ? 2 : 5, first[name]);
        value.classList.toggle("wrong", name === "multiplier" && !(v > 0));
        if (change) {
          const by = abs(v - first[name]);
          change.textContent = by === 0 ? "0" : mark(by.toExponential(0), page);
        }
      }
      if (over()) tell(pieces.flattened?.(page, x) ? words.flat : words.ended);
    }
  }

  /* ---- controls */

  const nice = (v) => {
    const power = 10 ** floor(log10(v));
    return power * [1, 2, 5, 10].reduce((best, c) => (c * power <= v * 1.001 ? c : best), 1);
  };
  let speed = 1;
  try {
    speed = nice(max(1e-6, min(max(1, page.t / 60), 16 / max(rate(0, start(), module.constants(p)), 1e-9))));
  } catch (e) { /* told by restart */ }
  const normal = speed;
  const digits = max(2, min(6, ceil(2 - log10(speed))));

  const button = (glyph, label, does) => make("button", { type: "button", [aria]: label, title: label, click: does }, glyph);
  const toggle = button("▶", words.play, () => (playing ? pause() : play()));
  function play() {
    if (!run) return;
    if (time >= until || over()) restart();
    playing = true;
    wanted = null;
    before = NaN;
    toggle.textContent = "❚❚";
    toggle.setAttribute(aria, toggle.title = words.pause);
    toggle.className = "runs";
    ask();
  }
  function pause() {
    playing = false;
    toggle.textContent = "▶";
    toggle.setAttribute(aria, toggle.title = words.play);
    toggle.className = "rests";
  }
  function seek(t) {
    pause();
    wanted = max(0, min(until, t));
    ask();
  }
  const stepped = (by) => seek((wanted ?? time) + by * speed / 30);
  const clock = make("span", { class: "clock" });
  const slider = make("input", {
    type: "range", min: 0, max: 1000, step: "any", value: 0, [aria]: words.time, class: "time",
    input: () => seek(slider.value / 1000 * until),
  });
  const speeds = make("select", { [aria]: words.speed, title: words.speed, change: () => {
    speed = +speeds.value;
    ask();
  } });
  for (let e = floor(log10(speed)) - 1; e < log10(speed) + 2; ++e) {
    for (const c of [1, 2, 5]) {
      const v = Number(`${c}e${e}`);
      speeds.append(make("option", { value: v, ...(abs(v / speed - 1) < 1e-6 ? { selected: "" } : {}) }, `× ${mark(String(v), page)}`));
    }
  }
  speed = +speeds.value;

  /* how long it goes on, in doublings; a motion that runs runs on */
  const lengths = make("select", { [aria]: words.length, title: words.length, change: () => {
    until = +lengths.value;
    if (time > until) seek(until);
    ask();
  } }, ...[1, 2, 4, 8, 16, 32].map((f) => make("option", { value: f * page.t }, [mark(String(+(f * page.t).toPrecision(6)), page), page.units.t].join(" "))));
  const within = words.within ? make("label", { class: "within" }, make("input", { type: "checkbox", change: (e) => {
    scene.within = e.target.checked;
    ask();
  } }), " ", words.within) : "";

  /* a number that is dragged sideways, moved by the arrow keys, or typed, after a click, Enter or at once: by a step for a
   * pixel where there is one, else by a part of itself, so that it keeps its sign */
  const adjusters = [];
  function adjuster(name, title, unit, initial, step, put) {
    const label = `${called(name)} ${title}`;
    const ends = step ? [initial - 1e3 * step, initial + 1e3 * step] : [initial / 100, initial * 100].sort((a, b) => a - b);
    const drag = make("span", { role: "slider", tabindex: 0, class: "drag", [aria]: label, "aria-valuemin": ends[0], "aria-valuemax": ends[1] });
    const exact = make("input", { inputmode: "decimal", autocomplete: "off", [aria]: label, hidden: "" });
    const wrong = (is) => exact.setAttribute("aria-invalid", is);
    let value;
    const write = (v) => {
      value = v;
      drag.textContent = mark(String(+v.toPrecision(6)), page);
      exact.value = drag.textContent.includes("·") ? v : drag.textContent; // as it can be typed
      drag.setAttribute("aria-valuenow", v);
      drag.setAttribute("aria-valuetext", `${exact.value} ${unit}`);
      wrong(false);
    };
    const take = (v) => {
      write(v);
      put(v);
      changed = `: ${called(name)} = ${exact.value}`;
      place_of = whole;
      restart();
    };
    const typing = (is) => {
      exact.hidden = !is;
      drag.hidden = is;
    };
    const by = (count, from = value) => {
      const v = step ? step * round(from / step + count) : +(from * exp(count / 150)).toPrecision(3);
      take(max(ends[0], min(ends[1], +v.toPrecision(9))));
    };
    let held = null;
    on(drag, "pointerdown", (e) => {
      held = [e.clientX, value, false];
      drag.setPointerCapture(e.pointerId);
    });
    on(drag, "pointermove", (e) => {
      if (!held || !(held[2] ||= abs(e.clientX - held[0]) > 2)) return;
      by(round(e.clientX - held[0]), held[1]);
    });
    const type = (begun) => {
      typing(true);
      if (begun) exact.value = begun;
      begun ? exact.focus() : exact.select();
    };
    on(drag, "pointercancel", () => (held = null));
    on(drag, "pointerup", () => {
      if (held && !held[2]) type();
      held = null;
    });
    on(drag, "keydown", (e) => {
      const count = { ArrowRight: 1, ArrowUp: 1, ArrowLeft: -1, ArrowDown: -1, PageUp: 10, PageDown: -10 }[e.key];
      if (count) by(count * (step ? 1 : 5));
      else if (e.key === "Home") take(initial);
      else if (e.key === "Enter") type();
      else if ("0123456789.,-−".includes(e.key)) type(e.key);
      else return;
      e.preventDefault();
      e.stopPropagation();
    });
    on(exact, "change", () => {
      const text = exact.value.trim().replace(",", ".").replaceAll("−", "-"), v = Number(text);
      if (text && Number.isFinite(v)) return take(v);
      wrong(true);
      tell(words.no_number, whole);
    });
    on(exact, "keydown", (e) => {
      if (e.key !== "Enter" && e.key !== "Escape") return;
      if (e.key === "Escape") write(value);
      exact.blur();
      drag.focus();
    });
    on(exact, "blur", () => typing(exact.getAttribute("aria-invalid") === "true"));
    adjusters.push(() => {
      put(initial);
      write(initial);
      typing(false);
    });
    write(initial);
    const whole = make("span", { class: "adjuster", "data-name": name, title },
      make("span", { class: "name" }, called(name)), title && make("small", {}, title), drag, exact, measured(unit));
    return whole;
  }
  const about = (name) => page.labels[name] ?? ["", ""];
  const fast = max(...velocity.map((s) => abs(x0[s])), 0);
  const measured = (unit) => make("span", { class: "unit" }, unit);
  const MOST = 24, FIRST = 8;
  const group = (title, note, rows) => rows.length
    ? [make("details", {}, make("summary", {}, title), ...(note ? [make("p", {}, note)] : []), ...rows)] : [];

  const rows = {};
  const table = make("table", {}, make("thead", {}, make("tr", {}, make("th", {}, words.kept), make("td", {}), make("th", {}, words.change))));
  const lines = make("tbody"), others = make("tbody");
  table.append(lines, words.others ? others : "");
  function tabulate() {
    lines.replaceChildren();
    others.replaceChildren(make("tr", { class: "unit" }, make("th", { colspan: 3 }, words.others)));
    for (const name of Object.keys(first)) {
      const cells = [make("td"), make("td")], lost = name === "multiplier" || name === "energy" && page.lost;
      rows[name] = lost || name === "defect" ? [cells[0]] : cells;
      const [label, unit] = page.kept[name] ?? [words[name], name === "defect" ? "" : page.units.energy];
      (lost ? others : lines).append(make("tr", { "data-name": name }, make("th", { scope: "row" }, label, measured(" " + unit)), ...cells));
    }
    table.tHead.hidden = !lines.firstChild;
    const [part] = page.body.parts, tilt = part?.n === 3 && !part.deforms ? part.map[2][2] : -1;
    graph?.offer([
      ...(tilt < 0 ? [] : [[page.tilt, (t, x) => x[tilt]]]),
      ...[...page.adjusted].sort((a, b) => !page.x[a] - !page.x[b]).map((s) => [`${called(page.names[s])} ${about(page.names[s])[0]}`.trim(), (t, x) => x[s]]),
      ...Object.keys(first).filter((name) => rows[name][1]).map((name) => [(page.kept[name] ?? [words[name]])[0], (t, x) => invariants(t, x)[name]]),
    ]);
  }

  if (side) side.element.className = side.shape;
  const beside = side ? [make("figure", {}, side.element, make("figcaption", {}, side.element.getAttribute(aria)), side.more ?? "")] : [];
  const coarse = (v) => 10 ** floor(log10(abs(v) || 1)) / 100;
  const of_start = page.adjusted.map((s) => adjuster(page.names[s], ...about(page.names[s]), x0[s], coarse(x0[s] || fast), (v) => (x0[s] = v)));
  const still_ones = of_start.filter((_, i) => !page.x[page.adjusted[i]]);
  const numbers = (names, list) => names.map((name, i) => adjuster(name, ...about(name), list[i], list[i] ? 0 : 0.01, (v) => (list[i] = v)));
  const parameters = numbers(module.PARAMETERS, p), inputs = numbers(module.INPUTS, u);
  const second = page.adjusted.length ? pieces.second?.(scene, page.second, adjuster, restart) : null;
  const settings = [
    ...of_start.filter((x) => !still_ones.includes(x)), ...parameters.splice(0, FIRST), ...inputs.splice(0, FIRST),
    ...group(words.start, "", still_ones),
    ...group(words.element, words.turned, theta.slice(0, MOST).map((_, k) => adjuster(`theta_${k + 1}`, "", "", 0, 0.01, (v) => (theta[k] = v)))),
    ...group(words.parameters, "", parameters), ...group(words.inputs, "", inputs),
  ];
  const reset = make("button", { type: "button", class: "reset", click: () => {
    for (const back of adjusters) back();
    restart();
  } }, words.reset);

  element.classList.add("motion");
  element.append(
    make("div", { class: "values" }, ...settings, reset),
    home,
    make("div", { class: "controls", role: "group", [aria]: words.controls },
      button("❘◂", words.again, () => seek(0)), button("◂", words.back, () => stepped(-1)), toggle,
      button("▸", words.step, () => stepped(1)), words.save ? button("↓", words.save, () => save_picture(stage.element)) : "", slider, clock, make("label", {}, words.until, " ", lengths), make("label", {}, words.pace, " ", speeds), within, second?.element ?? ""),
    make("div", { class: "beside" }, ...(graph ? [graph.figure, table, ...beside] : [...beside, table]), make("p", { class: "keys" }, words.keys)),
  );
  on(document, "keydown", (e) => {
    if (e.ctrlKey || e.metaKey || e.altKey || e.target.closest("input, select, summary, textarea, [role=slider]")) return;
    if (e.key === " " && e.target.closest("button")) return;
    const does = { " ": () => (playing ? pause() : play()), ArrowLeft: () => stepped(-1), ArrowRight: () => stepped(1), Home: () => seek(0), End: () => seek(until) }[e.key];
    if (does) {
      e.preventDefault();
      does();
    }
  });
  const recolour = () => {
    scene.colours = colours_of(element);
    ask();
  };
  on(scheme, "change", recolour);
  recolour();
  restart();
  if (!still) play();
  /* the same motion, and more that it keeps: by another module of the same problem, with words */
  function keep(other, kept) {
    if (!run) return;
    keeping = other;
    page.kept = kept;
    begin_to_keep();
    tabulate();
    ask();
  }
  return { given: { x: x0, p, u, theta }, get trail() { return scene.trail; }, get time() { return time; }, get playing() { return playing; }, get state() { return run.at(time); }, get run() { return run; }, second, get until() { return until; }, set until(t) {
    lengths.value = [...lengths.options].map((x) => +x.value).find((v) => v >= t) ?? lengths.options[lengths.length - 1].value;
    until = +lengths.value;
    ask();
  }, seek, play, pause, keep, scene, recolour };
}
