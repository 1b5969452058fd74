/* A problem as a Jupyter notebook that derives it. */

/* A text as a literal of Python: its own lines between triple quotes, raw where nothing in it hinders that. */
export function literal(text) {
  const hidden = /[^\P{C}\n\t]/u;
  for (const quotes of ["'''", '"""']) {
    const edge = quotes[0], ends = text.startsWith(edge) || text.endsWith(edge) || text.endsWith("\\");
    if (!text.includes(quotes) && !ends && !hidden.test(text)) return `r${quotes}${text}${quotes}`;
  }
  const escaped = text.replace(/[\\"]/g, "\\$&").replace(/[^\P{C}\n\t]/gu, (c) => {
    const code = c.codePointAt(0).toString(16);
    return code.length > 4 ? `\\U${code.padStart(8, "0")}` : `\\u${code.padStart(4, "0")}`;
  });
  return `"""${escaped}"""`;
}

/* A text as Markdown that shows it, and nothing else. */
const shown = (text) => text.replace(/[\\`*_{}[\]()<>#+\-.!|$&~]/g, "\\$&").replace(/\s+/g, " ");

const PROBLEM = (name, text) => `from pathlib import Path
from tempfile import TemporaryDirectory

import derive

problem = ${literal(text)}

with TemporaryDirectory() as folder:  # your own files stay as they are
    file = Path(folder, "${name}.toml")
    file.write_text(problem, encoding="utf-8")
    d = derive.derive(file)`;

const CHECK = `verdicts = d.check()
wrong = [v.label for v in verdicts if not v.holds]
print("wrong: " + ", ".join(wrong) if wrong else f"{len(verdicts)} verdicts: every step holds")`;

const MOTION = `try:
    run = d.simulate(5.0)  # start={"zeta_1": 1.0, …} for other numbers
    print(run)
except ValueError as told:  # a number is missing
    print(told)`;

const CODE = `files = d.emit(languages=("c", "python"))  # d.emit("FOLDER") writes them
print(*files)`;

/* the notebook, as JSON; title: a sentence of any text */
export function notebook(name, text, title) {
  const lines = (x) => x.split(/(?<=\n)/);
  const code = (id, source) => ({ cell_type: "code", id, execution_count: null, metadata: {}, outputs: [], source: lines(source) });
  const told = (id, source) => ({ cell_type: "markdown", id, metadata: {}, source: lines(source) });
  return JSON.stringify({
    nbformat: 4, nbformat_minor: 5,
    metadata: { kernelspec: { display_name: "Python 3", language: "python", name: "python3" } },
    cells: [
      told("about", `# ${shown(title)}\n\nIt needs derive, in a clone of its repository: \`pip install .\``),
      code("problem", PROBLEM(name, text)), code("walk", "d"), code("check", CHECK), code("motion", MOTION), code("code", CODE),
    ],
  }, null, 1);
}
