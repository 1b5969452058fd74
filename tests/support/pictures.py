"""The pictures of README, in docs/pictures: python -m tests.support.pictures.

A page of lecture notes as PDF, a step of the walk as a page in a browser, and the playground; all
of ``top``.  It needs TeX, pdftoppm, Chromium, playwright and Node.
"""

import shutil
import subprocess
import tempfile
from pathlib import Path

from playwright.sync_api import sync_playwright

from derive.command.cli import main
from tests.support.needs import BROWSERS
from tests.support.playground_site import built, chromium, served, walked

PICTURES = Path(__file__).parents[2] / "docs" / "pictures"
PDF_STEP = "top.euler"
STEPS = ("top.torque", "top.energy")
"""The page of the notes that has this step; the first and the last step of the picture beside."""


def notes(folder):
    """The page of the PDF, 80 dots an inch."""
    main(["notes", "top", "--out", f"{folder}/top.pdf"])
    text = subprocess.run(["pdftotext", f"{folder}/top.pdf", "-"], stdout=-1, text=True, check=True)
    page = 1 + next(i for i, x in enumerate(text.stdout.split("\f")) if f"\n{PDF_STEP}\n" in x)
    size = ["-gray", "-png", "-singlefile", "-r", "80", "-f", f"{page}", "-l", f"{page}"]
    crop = ["-x", "10", "-y", "70", "-W", "640", "-H", "830"]
    subprocess.run(["pdftoppm", *size, *crop, f"{folder}/top.pdf", PICTURES / "notes"], check=True)


def walk(folder):
    """The steps in a browser, from the top of the first to the bottom of the last."""
    main(["walk", "top", "--format", "html", "--out", f"{folder}/top.html"])
    browser = next(filter(shutil.which, BROWSERS))
    with sync_playwright() as p:
        shown = p.chromium.launch(executable_path=shutil.which(browser), args=["--no-sandbox"])
        page = shown.new_page(viewport={"width": 760, "height": 900}, color_scheme="light")
        page.goto(f"file://{folder}/top.html")
        boxes = [page.locator(f"[id='{x}']").bounding_box() for x in STEPS]
        top, bottom = boxes[0]["y"] - 10, boxes[1]["y"] + boxes[1]["height"] + 10
        clip = {"x": 0, "y": top, "width": 760, "height": bottom - top}
        page.screenshot(path=PICTURES / "walk.png", full_page=True, clip=clip)
        shown.close()


def playground():
    """The playground with the equations of a top, in a browser."""
    with served(built().parent) as (address, _), chromium() as browser:
        page = browser.new_page(viewport={"width": 1280, "height": 760}, color_scheme="light")
        page.goto(f"{address}play/#top")
        walked(page, "top")
        page.evaluate(f"play.equations.go({PDF_STEP!r})")
        page.screenshot(path=PICTURES / "playground.png")


if __name__ == "__main__":
    PICTURES.mkdir(exist_ok=True)
    with tempfile.TemporaryDirectory() as folder:
        notes(folder)
        walk(folder)
    playground()
