/* The editor of the problem file: colours of TOML, completion of its keys, faults at their lines. */
import { autocompletion, completionKeymap, startCompletion } from "@codemirror/autocomplete";
import { defaultKeymap, history, historyKeymap } from "@codemirror/commands";
import { HighlightStyle, StreamLanguage, bracketMatching, syntaxHighlighting } from "@codemirror/language";
import { toml } from "@codemirror/legacy-modes/mode/toml";
import { lintGutter, setDiagnostics } from "@codemirror/lint";
import { Compartment, EditorState } from "@codemirror/state";
import { EditorView, drawSelection, highlightActiveLine, keymap, lineNumbers } from "@codemirror/view";
import { tags } from "@lezer/highlight";
import { completions } from "./completion.js";

const colours = HighlightStyle.define([
  { tag: tags.comment, color: "var(--soft)", fontStyle: "italic" },
  { tag: tags.string, color: "var(--string)" },
  { tag: [tags.number, tags.bool, tags.atom], color: "var(--number)" },
  { tag: [tags.propertyName, tags.keyword], color: "var(--key)" },
]);

export function editor(parent, schema, words, changed) {
  const label = new Compartment();
  const about = (w) => EditorView.contentAttributes.of({ "aria-label": w.editor, tabindex: "0" });
  const told = (text) => {
    document.dispatchEvent(new CustomEvent("text", { detail: text }));
    changed(text);
  };
  const view = new EditorView({
    parent,
    state: EditorState.create({
      extensions: [
        lineNumbers(), history(), drawSelection(), highlightActiveLine(), bracketMatching(), lintGutter(), EditorView.lineWrapping,
        StreamLanguage.define(toml), syntaxHighlighting(colours),
        autocompletion({ override: [completions({ ...schema, start: startCompletion })] }),
        keymap.of([...completionKeymap, ...historyKeymap, ...defaultKeymap]),
        label.of(about(words)),
        EditorView.updateListener.of((u) => { if (u.docChanged) told(u.state.doc.toString()); }),
      ],
    }),
  });
  const whole = () => view.state.doc.toString();
  return {
    get text() { return whole(); },
    set text(text) {
      if (text !== whole()) view.dispatch({ changes: { from: 0, to: view.state.doc.length, insert: text } });
    },
    inWords: (w) => view.dispatch({ effects: label.reconfigure(about(w)) }),
    /* faults: [{ line, message, severity }] */
    show(faults) {
      const { doc } = view.state;
      document.dispatchEvent(new CustomEvent("faults", { detail: faults }));
      const found = faults.map(({ line, message, severity }) => {
        const at = doc.line(Math.max(1, Math.min(line, doc.lines)));
        return { from: at.from + (at.text.length - at.text.trimStart().length), to: at.to, message, severity };
      });
      view.dispatch(setDiagnostics(view.state, found));
    },
    go(line) {
      document.dispatchEvent(new CustomEvent("go", { detail: line }));
      if (parent.hidden) return;
      const at = view.state.doc.line(Math.max(1, Math.min(line, view.state.doc.lines)));
      view.dispatch({ selection: { anchor: at.from }, scrollIntoView: true });
      view.focus();
    },
  };
}
