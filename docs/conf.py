"""The site of these pages and of the docstrings: ``make docs``, by Sphinx, into build/docs.

The pages of the site lie as the files of the repository lie, README and its like at the root: a
link is one link here and there.  Nothing is fetched, neither to build the site nor to read it.
"""

import base64
import re
import shutil
import tomllib
import zlib
from pathlib import Path

import derive

project = "derive"
release = derive.__version__
extensions = ["myst_parser", "sphinx.ext.autodoc"]
root_doc = "README"
include_patterns = ["*.md", "docs/*.md", "docs/*/*.md"]

ROOT = Path(__file__).parents[1]
CONTENTS = {
    "Begin": "tutorial systems playground commands",
    "Describe": "problem-file lagrangian fluid kinematics",
    "Ask": "motion symmetries equilibria lecture",
    "Compute": "code python",
    "Trust": "trust paper architecture",
}
"""Caption → pages of the table of contents."""

html_theme = "furo"
html_static_path, html_css_files = ["site.css"], ["site.css"]
html_title = "derive"
html_favicon = "../playground/src/icon.svg"
html_copy_source = html_show_copyright = False
myst_heading_anchors = 3
autodoc_member_order = "bysource"
autodoc_class_signature = "separated"
autodoc_default_options = {"members": True, "exclude-members": "__init__"}
add_module_names = False
autodoc_typehints_format = "short"
highlight_language = "text"  # what has no language is what was printed


BELOW = {
    root_doc: CONTENTS,
    "docs/problem-file": {"": "potentials/*"},
    "docs/fluid": {"": "dirichlet zeitlin"},
    "docs/motion": {"": "plot ensembles"},
    "docs/symmetries": {"": "integrals reduction"},
    "docs/equilibria": {"": "control"},
    "docs/lecture": {"": "notes"},
    "docs/code": {"": "compare options steps discrete build fmu"},
    "docs/python": {"": "sympy record"},
    "docs/trust": {"": "performance not-here strangers ../SECURITY"},
    "docs/architecture": {"": "extending reference ../CONTRIBUTING ../CHANGELOG"},
}
"""Page → the pages below it in the table of contents, under their captions."""


def contents(app, docname, source):
    """The table of contents, which pages do not show, at their ends."""
    for caption, patterns in BELOW.get(docname, {}).items():
        files = [x for p in patterns.split() for x in sorted((ROOT / "docs").glob(f"{p}.md"))]
        pages = [f"/{x.resolve().relative_to(ROOT).with_suffix('')}" for x in files]
        captions = [f":caption: {caption}"] if caption else []
        fence = ["```{toctree}", ":hidden:", *captions, "", *pages, "```"]
        source[0] += "\n\n" + "\n".join(fence) + "\n"


MARKED = re.compile(r"[^\W\d][\u0300-\u036f]+")
COLUMN, COMPOSED = "display:inline-block;width:1ch;text-align:center", "font-family:sans-serif"


def marks(app, pagename, templatename, context, doctree):
    """A letter with its dot as one, in blocks of text: of many fonts of one width the dot stands
    above what follows."""
    letter = rf'<span style="{COLUMN}"><span style="{COMPOSED}">\g<0></span></span>'
    context["body"] = re.sub(
        r"<pre>.*?</pre>",
        lambda block: MARKED.sub(letter, block[0]),
        context.get("body", ""),
        flags=re.DOTALL,
    )


def playground(app, pagename, templatename, context, doctree):
    """The way to the playground at the head of every page, where it stands beside them."""
    if app.tags.has("play"):
        there = context["pathto"]("play/index.html", True)
        context["theme_announcement"] = (
            f'<a href="{there}">The playground: derive in this browser</a>'
        )


PROBLEM = ("group", "algebra", "fluid", "kinematics")
"""Keys of which a whole problem file has one; others are of a page's parts of files."""


def packed(text):
    """A problem file as the address of the playground has it: playground/src/link.js unpacks it."""
    deflate = zlib.compressobj(9, zlib.DEFLATED, -zlib.MAX_WBITS)
    data = deflate.compress(text.encode()) + deflate.flush()
    return base64.urlsafe_b64encode(data).decode().rstrip("=")


def opened_there(app, doctree, docname):
    """Below each problem file of a page the way to the playground, where that stands beside."""
    if not app.tags.has("play"):
        return
    from docutils import nodes  # not there where a test reads this file and makes no site

    there = "../" * docname.count("/") + "play/index.html"
    for block in [*doctree.findall(nodes.literal_block)]:
        if block.get("language") != "toml":
            continue
        data = tomllib.loads(block.astext())
        if "name" in data and any(key in data for key in PROBLEM):
            link = f'<p><a href="{there}#p={packed(block.astext())}">Open in the playground</a></p>'
            block.parent.insert(block.parent.index(block) + 1, nodes.raw("", link, format="html"))


def index(app, exception):
    """README by the name that browsers look for."""
    if exception is None:
        shutil.copy(Path(app.outdir) / f"{root_doc}.html", Path(app.outdir) / "index.html")


def setup(app):
    """Where Sphinx calls these."""
    app.connect("source-read", contents)
    app.connect("html-page-context", playground)
    app.connect("html-page-context", marks)
    app.connect("doctree-resolved", opened_there)
    app.connect("build-finished", index)
