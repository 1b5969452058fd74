"""The lecture as it is shown: its records, its text in each form, made once for these sources."""

import re
from dataclasses import replace

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


def by_itself(chapter):
    """A chapter without what it refers to in others."""

    def without(entry):
        texts = (
            tuple(re.sub("@[a-z_]+", "", x) if isinstance(x, str) else x for x in text)
            for text in entry.texts
        )
        return replace(entry, texts=tuple(texts))

    blocks = (replace(b, entries=tuple(map(without, b.entries))) for b in chapter.blocks)
    return replace(chapter, blocks=tuple(blocks))
