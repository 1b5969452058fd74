"""The site of these pages and of the docstrings: ``make docs``, by Sphinx, into build/docs.

The pages of the site lie as the files of the repository lie, README and its like at the root: a
link is one link here and there.  Nothing is fetched, neither to build the site nor to read it.
"""

import base64
import re
import shutil
import tomllib
import zlib
from functools import partial
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


def contents_shown(app, pagename, templatename, context, doctree):
    """Above the table of contents of every page the way to the playground, where that stands
    beside; its captions say of which level they are, as readers of screens ask."""
    tree = context.get("furo_navigation_tree", "").replace(
        'role="heading"', 'role="heading" aria-level="2"'
    )
    if app.tags.has("play"):
        there = context["pathto"]("play/index.html", True)
        link = f'<a class="reference internal" href="{there}">Open the playground</a>'
        tree = f'<ul><li class="toctree-l1">{link}</li></ul>{tree}'
    context["furo_navigation_tree"] = tree


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


ASKED = re.compile(r"derive walk (\S+) --answer")


def typeset(app, doctree, docname):
    """Before what a command printed of an answer, its equations of motion, set."""
    from docutils import nodes

    from derive.command.showing import load_problem
    from derive.pipeline import walk
    from derive.problem.toml import problem_of
    from derive.views.answer import summary
    from derive.views.layout import as_read
    from derive.views.outline import latex_names
    from derive.views.printing.signs import Notation
    from derive.views.printing.tex import formula
    from derive.views.printing.typeset import literal

    own, asked = {}, ""
    for block in [*doctree.findall(nodes.literal_block)]:
        text = block.astext()
        if block.get("language") == "toml" and "name" in (data := tomllib.loads(text)):
            own[f"{data['name']}.toml"] = data
        if block.get("language") == "sh":
            found = ASKED.search(text)
            asked = found[1] if found else ""
        elif asked and "=" in text and block.get("language") != "toml":
            problem = problem_of(own[asked]) if asked in own else load_problem(asked)
            d = as_read(walk(problem))
            told = summary(d).blocks[0][1].equations
            set_ = partial(formula, names=latex_names(d), notation=Notation())
            rows = (set_(e.lhs) + literal(" = ") + set_(e.rhs) for e in told)
            shown = "".join(f'<div class="answer">{x.plain().mathml()}</div>' for x in rows)
            block.parent.insert(block.parent.index(block), nodes.raw("", shown, format="html"))
            asked = ""


def index(app, exception):
    """README by the name that browsers look for."""
    if exception is None:
        shutil.copy(Path(app.outdir) / f"{root_doc}.html", Path(app.outdir) / "index.html")


def setup(app):
    """Where Sphinx calls these."""
    app.connect("source-read", contents)
    app.connect("html-page-context", marks)
    app.connect("html-page-context", contents_shown, priority=900)  # of the theme's own tree
    app.connect("doctree-resolved", typeset)
    app.connect("doctree-resolved", opened_there)
    app.connect("build-finished", index)
