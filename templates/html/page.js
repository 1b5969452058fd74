document.querySelectorAll("button[data-tex]").forEach((button) => {
  button.hidden = !navigator.clipboard;
  button.addEventListener("click", async () => {
    await navigator.clipboard.writeText(button.dataset.tex);
    button.textContent = "✓";
    setTimeout(() => { button.textContent = "TeX"; }, 1200);
  });
});
