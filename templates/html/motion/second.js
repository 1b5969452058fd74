/* A second motion of the same problem, by the same step: it starts ε apart, relatively, in one number of the velocity.
 * scene.other is its run, and where that is the body has a ghost; words: { show, of }; adjuster: see mount. */
function second_motion({ page, velocity }, words, adjuster, restart) {
  let on = false, by = 1e-3;
  const box = make("input", { type: "checkbox", change: () => {
    on = box.checked;
    more.hidden = !on;
    restart();
  } });
  const list = make("select", { "aria-label": words.of, title: words.of, change: restart }, ...page.adjusted.map((s) => make("option", { value: page.names[s] }, called(page.names[s]))));
  const row = adjuster("epsilon", "", "", by, 0, (v) => (by = v));
  const more = make("span", { class: "two", hidden: "" }, list, row);
  return {
    element: make("span", { class: "two" }, make("label", { class: "within" }, box, " ", words.show), more),
    /* where it starts, where the first one starts at x; null without one */
    start(x) {
      const s = page.adjusted[list.selectedIndex], y = [...x];
      y[s] += by * (abs(x[s]) || max(...velocity.map((k) => abs(x[k]))) || 1);
      return on ? y : null;
    },
    /* the name of the number and ε, as an address has them */
    get told() { return on ? [list.value, by] : undefined; },
    set told([name, v]) {
      list.value = name;
      if (list.selectedIndex < 0) list.selectedIndex = 0;
      on = box.checked = true;
      more.hidden = false;
      const exact = row.querySelector("input");
      exact.value = v;
      exact.dispatchEvent(new Event("change"));
    },
  };
}
