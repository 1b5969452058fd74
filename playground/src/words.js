/* The words of the page, in English and French; those of the equations come from the package. */
export const WORDS = {
  en: {
    home: "derive", language: "Language", ready: "Problem", own: "of your own", write: "The problem",
    how: "How to write it", text: "Text", form: "Form", link: "Copy link", linked: "Link copied",
    read: "What is derived", equations: "Equations", motion: "Motion", take: "Take", check: "Check",
    stop: "Stop", progress: "Progress", editor: "The problem file, TOML",
    loading: "Loading Python …", deriving: "Deriving …", checking: "Checking …", emitting: "Writing …", keeping: "What is kept is sought …",
    derived: (n, s) => `${n} steps, ${s} s`, checked: (n, bound) => `${n} steps hold; a false one passes below ${bound}`,
    failed: (n) => `${n} steps FAIL`, stopped: "Stopped.", late: (s) => `Stopped after ${s} s: too large for this page. The command at home has no such limit.`,
    line: (n) => `line ${n}`, damaged: "This link is damaged: here is the example instead.",
    plain: "This browser has no WebAssembly, which runs the derivation. At home:",
    broken: "Python could not be loaded. Reload the page, or at home:",
    holds: (bound) => `holds; a false one passes below ${bound}`, fails: "does not hold",
    mathml: "copy the MathML", tex: "copy the LaTeX", copied: "copied",
    nomotion: "No motion:", moved: "Computed here by the emitted JavaScript.",
    pushed: "The file starts it at rest: it has been pushed.", stale: "The text has changed: this is the motion of before.",
    into: "Into the problem", left: (x) => `Set in the text, but for ${x}: change that there.`,
    notes: "Notes", record: "Record", code: "Code", notebook: "Notebook", options: "Options",
    languages: "Languages", save: (x) => `Save ${x}`, command: "The same at home", copy: "Copy",
    page: "Web page", body: "Body", points: "points", moments: "moments as letters", group: "Group", name: "Name",
    mass: "mass", at: "at", add: "Add", remove: "Remove", potentials: "Forces", solid: "solid", parameters: "Parameters",
    formonly: "This problem has tables that the form does not show: it would leave them out. Edit its text.",
    value: "default", start: "Start afresh", steps: "Steps", kind: "kind", point: "point", density: "density",
  },
  fr: {
    home: "derive", language: "Langue", ready: "Problème", own: "le vôtre", write: "Le problème",
    how: "Comment l’écrire", text: "Texte", form: "Formulaire", link: "Copier le lien", linked: "Lien copié",
    read: "Ce qui est déduit", equations: "Équations", motion: "Mouvement", take: "Emporter", check: "Vérifier",
    stop: "Arrêter", progress: "Progression", editor: "Le fichier du problème, TOML",
    loading: "Chargement de Python …", deriving: "Calcul …", checking: "Vérification …", emitting: "Écriture …", keeping: "Recherche de ce qui est conservé …",
    derived: (n, s) => `${n} étapes, ${String(s).replace(".", ",")} s`, checked: (n, bound) => `${n} étapes sont exactes ; une fausse passe à moins de ${bound}`,
    failed: (n) => `${n} étapes sont FAUSSES`, stopped: "Arrêté.", late: (s) => `Arrêté après ${s} s : trop grand pour cette page. La commande, chez vous, n’a pas cette limite.`,
    line: (n) => `ligne ${n}`, damaged: "Ce lien est abîmé : voici l’exemple à la place.",
    plain: "Ce navigateur n’a pas WebAssembly, qui fait le calcul. Chez vous :",
    broken: "Python n’a pas pu être chargé. Rechargez la page, ou chez vous :",
    holds: (bound) => `exacte ; une fausse passe à moins de ${bound}`, fails: "fausse",
    mathml: "copier le MathML", tex: "copier le LaTeX", copied: "copié",
    nomotion: "Pas de mouvement :", moved: "Calculé ici par le JavaScript émis.",
    pushed: "Le fichier le fait partir du repos : il a été poussé.", stale: "Le texte a changé : ceci est le mouvement d’avant.",
    into: "Dans le problème", left: (x) => `Mis dans le texte, sauf ${x} : à changer là.`,
    notes: "Notes", record: "Archive", code: "Code", notebook: "Carnet", options: "Options",
    languages: "Langages", save: (x) => `Enregistrer ${x}`, command: "La même chose chez vous", copy: "Copier",
    page: "Page web", body: "Corps", points: "points", moments: "moments en lettres", group: "Groupe", name: "Nom",
    mass: "masse", at: "en", add: "Ajouter", remove: "Enlever", potentials: "Forces", solid: "solide", parameters: "Paramètres",
    formonly: "Ce problème a des tables que le formulaire ne montre pas : il les omettrait. Modifiez son texte.",
    value: "défaut", start: "Recommencer", steps: "Étapes", kind: "genre", point: "point", density: "densité",
  },
};

/* put the words of a language where the page asks for them */
export function inWords(words, root = document) {
  for (const e of root.querySelectorAll("[data-word]")) e.textContent = words[e.dataset.word];
  for (const e of root.querySelectorAll("[data-label]")) e.setAttribute("aria-label", words[e.dataset.label]);
}
