/* what is wider than its place is moved by keys, too */
const watch = new ResizeObserver((seen) => {
  seen.forEach(({ target }) => {
    const over = target.scrollWidth - target.clientWidth;
    if (Math.sign(over) === 1) target.tabIndex = 0;
    else target.removeAttribute("tabindex");
  });
});
document.querySelectorAll(".display, .wide, p, figcaption, li").forEach((x) => watch.observe(x));

/* a step a screen: those behind the ticks */
const button = document.getElementById("project"), sheet = new CSSStyleSheet();
const [ofSteps, ofScreens] = ["of-steps", "of-screens"].map((x) => document.getElementById(x).textContent);
sheet.replaceSync(ofSteps.slice(ofSteps.indexOf("{") + 1, ofSteps.lastIndexOf("}")) + ofScreens);
const stepof = (n, all) => button.dataset.place.replace("{n}", n).replace("{all}", all);
const projector = new Projector(document.getElementById("projector"), {
  equations: {
    root: {
      adoptedStyleSheets: [sheet],
      querySelectorAll: (x) => document.querySelectorAll(x),
      getElementById: (x) => document.getElementById(x),
    },
  },
  words: () => ({ stepof, now: button.dataset.now }),
  passed: () => {},
  beside: () => {},
  left: (id) => { location.hash = id; },
});
const project = () => projector.enter(document.querySelector("article:target")?.id);
button.hidden = false;
button.addEventListener("click", project);
addEventListener("keydown", (e) => {
  if (e.ctrlKey || e.metaKey || e.altKey) return;
  if (projector.key(e.key)) e.preventDefault();
  else if (e.key === "p") project();
});
