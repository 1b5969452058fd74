/* The colours of the style sheet: shades of the body, and plain ones. */
function colours_of(element) {
  const style = getComputedStyle(element);
  const read = (name) => style.getPropertyValue(`--${name}`).trim();
  const rgb = (hex) => [1, 3, 5].map((i) => parseInt(hex.slice(i, i + 2), 16));
  const shades = (name) => Array.from({ length: 33 }, (_, i) => {
    const light = 0.62 + 0.48 * i / 32;
    return `rgb(${rgb(read(name)).map((v) => min(255, round(light < 1 ? v * light : v + (255 - v) * (light - 1)))).join(" ")})`;
  });
  const colours = { read, tones: [["body", "pale"], ["other", "pale"]].map((pair) => pair.map(shades)) };
  colours.ghost = read("ghost");
  colours.ghosts = ["ghost", "pale"].map(shades);
  for (const name of ["ink", "soft", "line", "paper", "mark", "e1", "e2", "e3"]) colours[name] = read(name);
  colours.lines = ["e3", "e1", "e2", "mark", "other", "soft"].map(read);
  return colours;
}
