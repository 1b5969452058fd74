/* Words, numbers and elements of a page. */

const letters = "alpha α beta β gamma γ delta δ epsilon ε zeta ζ eta η theta θ kappa κ lambda λ mu μ nu ν xi ξ rho ρ sigma σ tau τ phi φ chi χ psi ψ omega ω Gamma Γ Delta Δ Theta Θ Pi Π Omega Ω".split(" ");
const low = (digits) => [...digits].map((d) => "₀₁₂₃₄₅₆₇₈₉"[d] ?? d).join("");

/* zeta_1 is ζ₁; longer names stay words */
const called = (name) => {
  const [, stem, end] = new RegExp("^([A-Za-z]+?)_?([0-9_]*)$").exec(name) ?? [];
  const short = letters[letters.indexOf(stem) + 1 || -1] ?? (stem?.length < 3 ? stem : "");
  return short ? short + low(end.replaceAll("_", ",")) : name.replaceAll("_", " ");
};

/* a number as it is shown: mark(text, page) with its decimal sign and power of ten, shown(v, page, digits, like) with the
 * decimals that another of the same row has: it keeps its width while it moves */
const mark = (text, page) => {
  const [digits, power] = (page.comma ? text.replace(".", ",") : text).replace("-", "−").split("e");
  return power ? `${digits}·10${[...power].map((x) => ({ "−": "⁻", "-": "⁻", "+": "" }[x] ?? "⁰¹²³⁴⁵⁶⁷⁸⁹"[x])).join("")}` : digits;
};
const shown = (v, page, digits, like) => {
  const size = abs(like);
  if (v === 0 || digits > 2 && abs(v) < 1e-14) return "0";
  return mark(size < 1e-3 || size >= 1e6 ? v.toExponential(min(digits - 1, 3)) : v.toFixed(max(0, digits - 1 - floor(log10(size)))), page);
};

const on = (what, name, does, how) => what.addEventListener(name, does, how);
const make = (tag, given = {}, ...inside) => {
  const made = document.createElement(tag);
  for (const [name, v] of Object.entries(given)) {
    if (typeof v === "function") on(made, name, v);
    else made.setAttribute(name, v);
  }
  made.append(...inside);
  return made;
};
