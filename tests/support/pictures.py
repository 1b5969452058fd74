"""The pictures of README and of the page that moves, in docs/pictures: python -m
tests.support.pictures [notes] [walk] [motion] [moving] [playground].

A page of lecture notes as PDF, a step of the walk as a page in a browser, the page with the body in
it, and the playground; all of ``top``.  It needs TeX, pdftoppm, Chromium, playwright and Node.
"""

import shutil
import subprocess
import sys
import tempfile
from io import BytesIO
from pathlib import Path

from PIL import Image
from playwright.sync_api import sync_playwright

from derive.command.cli import main
from playground.site import built
from tests.support.needs import BROWSERS
from tests.support.playground_site import chromium, served

PICTURES = Path(__file__).parents[2] / "docs" / "pictures"
FRAMES, SPAN = 60, 0.48
"""Of the picture that plays: how many, and of what time."""
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


def shown(playwright, **how):
    """A page in a browser that asks for less motion."""
    browser = next(filter(shutil.which, BROWSERS))
    arguments = ["--no-sandbox"]
    running = playwright.chromium.launch(executable_path=shutil.which(browser), args=arguments)
    return running, running.new_page(color_scheme="light", reduced_motion="reduce", **how)


def motion(folder):
    """The page of a motion at an instant, with its trail."""
    start = ["--set", "zeta_3=150", "--exp", "0.5,0,0"]
    main(["simulate", "top", "--t", "2", *start, "--html", f"{folder}/motion.html"])
    with sync_playwright() as p:
        browser, page = shown(p, viewport={"width": 880, "height": 540})
        page.goto(f"file://{folder}/motion.html")
        page.evaluate('document.getElementById("motion").motion.seek(0.75)')
        page.wait_for_function('document.getElementById("motion").motion.time === 0.75')
        page.wait_for_timeout(200)
        page.screenshot(path=PICTURES / "motion.png")
        browser.close()


def moving(folder):
    """The top as it moves: once round by its precession, a sixth as fast, over and over."""
    start = ["--set", "zeta_3=100", "--exp", "0.5,0,0"]
    main(["simulate", "top", "--t", f"{SPAN}", *start, "--html", f"{folder}/moving.html"])
    frames = []
    with sync_playwright() as p:
        browser, page = shown(p, viewport={"width": 560, "height": 460})
        page.goto(f"file://{folder}/moving.html")
        for k in range(FRAMES):
            at = SPAN * k / FRAMES
            page.evaluate(f'document.getElementById("motion").motion.seek({at})')
            page.wait_for_function(f'document.getElementById("motion").motion.time === {at}')
            page.wait_for_timeout(60)  # the trail is drawn
            frames.append(Image.open(BytesIO(page.locator(".stage").screenshot())))
        browser.close()
    rest = {"save_all": True, "append_images": frames[1:], "duration": 50, "loop": 0}
    frames[0].save(PICTURES / "moving.webp", quality=60, method=6, **rest)


def walk(folder):
    """The steps in a browser, from the top of the first to the bottom of the last."""
    main(["walk", "top", "--format", "html", "--out", f"{folder}/top.html"])
    with sync_playwright() as p:
        browser, page = shown(p, viewport={"width": 760, "height": 900})
        page.goto(f"file://{folder}/top.html")
        boxes = [page.locator(f"[id='{x}']").bounding_box() for x in STEPS]
        top, bottom = boxes[0]["y"] - 10, boxes[1]["y"] + boxes[1]["height"] + 10
        clip = {"x": 0, "y": top, "width": 760, "height": bottom - top}
        page.screenshot(path=PICTURES / "walk.png", full_page=True, clip=clip)
        browser.close()


def playground(_):
    """The playground as it opens: a top that moves, and its equations, in a browser."""
    with served(built().parent) as (address, _), chromium() as browser:
        page = browser.new_page(viewport={"width": 1280, "height": 800}, color_scheme="light")
        page.goto(f"{address}play/")
        page.wait_for_timeout(4000)  # it moves, and has a trail
        page.screenshot(path=PICTURES / "playground.png")


if __name__ == "__main__":
    PICTURES.mkdir(exist_ok=True)
    made = {"notes": notes, "walk": walk, "motion": motion, "moving": moving}
    made["playground"] = playground
    with tempfile.TemporaryDirectory() as folder:
        for name in sys.argv[1:] or made:
            made[name](folder)
