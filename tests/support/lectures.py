"""The lecture as it is shown: its records, its text in each form, made once for these sources."""

from derive.command.lecturing import records_of
from derive.lecture import document
from derive.lecture.lecture_text import chapters
from derive.views.language import language
from tests.support.cached import on_disk

CHAPTERS = chapters()
FORMS = {"page": document.page, "latex": document.latex}


@on_disk
def records():
    """Those of all chapters, by their names."""
    return records_of(CHAPTERS)


@on_disk
def shown(form, lang, solutions="chapter"):
    """The whole lecture as a page or as LaTeX."""
    made = document.Lecture(CHAPTERS, language(lang), records(), solutions=solutions)
    return FORMS[form](made)
