/* what is wider than its place is moved by keys, too */
const watch = new ResizeObserver((seen) => {
  seen.forEach(({ target }) => {
    const over = target.scrollWidth - target.clientWidth;
    if (Math.sign(over) === 1) target.tabIndex = 0;
    else target.removeAttribute("tabindex");
  });
});
document.querySelectorAll(".display, .wide, p, figcaption, li").forEach((x) => watch.observe(x));
