"""The files of an emission read back before they are written: ``derive emit --validate``."""

from __future__ import annotations

import sys
from collections.abc import Mapping

from ..code.options import Options
from ..code.program import Program
from ..record.record import Derivation
from ..validate.chart import Chart
from ..validate.emission import Emission


def validated(
    files: Mapping[str, str],
    fresh: Mapping[str, str],
    d: Derivation,
    program: Program,
    prefix: str,
    options: Options,
) -> bool:
    """Do the files that can be read back equal the record?  A line on stderr for each of them.

    ``fresh``: what is emitted now.  False as well where none of the files can be read back.
    ``MissingParserError`` when there is C among them and no parser of it.
    """
    chart = Chart(options.layout, options.attitude, options.velocity)
    given = options.frame == "given"
    reports = Emission(files, prefix, chart, program.numbers(), given, fresh).reports(d)
    for report in reports:
        print(f"{', '.join(report.files)}: {report.text}", file=sys.stderr)
    if not any(report.read for report in reports):
        print("derive: nothing of this can be validated", file=sys.stderr)
        return False
    return all(report.holds for report in reports)
