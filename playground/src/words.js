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
    nomotion: "No motion:", moved: "The emitted JavaScript moves the body; from rest it is pushed a little.",
    notes: "Notes", record: "Record", code: "Code", notebook: "Notebook", options: "Options",
    languages: "Languages", save: (x) => `Save ${x}`, command: "The same at home", copy: "Copy",
    page: "Web page", body: "Body", points: "points", moments: "moments as letters", group: "Group", name: "Name",
    mass: "mass", at: "at", add: "Add", remove: "Remove", potentials: "Forces", solid: "solid", parameters: "Parameters",
    formonly: "This problem has tables that the form does not show: it would leave them out. Edit its text.",
    value: "default", start: "Start afresh", steps: "Steps", kind: "kind", point: "point", density: "density",
    keys: {
      far_centre: "far centre", self_gravity: "self-gravity", covector: "input: covector", force: "input: force", hollow_ball: "hollow ball", semi_axes: "semi-axes",
      on: "on point", between: "between points", anchor: "anchored at", title: "Title", body: "body",
    },
    unread: "The text is no TOML yet: the form shows it when what is wrong there is mended.", sure: "A new problem replaces this text. Go on?",
    kept: (x) => `Kept as text, unchanged: ${x}.`, nonumber: (x) => `“${x}” is no number`, semicolons: "entries with , between them; with ; where they have decimal commas",
    addpoint: "Add a point", addforce: "Add a force", madeof: "made of", startsat: "Velocity at the start", given: "moments, given",
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
    nomotion: "Pas de mouvement :", moved: "Le JavaScript émis meut le corps ; au repos, il est un peu poussé.",
    notes: "Notes", record: "Archive", code: "Code", notebook: "Carnet", options: "Options",
    languages: "Langages", save: (x) => `Enregistrer ${x}`, command: "La même chose chez vous", copy: "Copier",
    page: "Page web", body: "Corps", points: "points", moments: "moments en lettres", group: "Groupe", name: "Nom",
    mass: "masse", at: "en", add: "Ajouter", remove: "Enlever", potentials: "Forces", solid: "solide", parameters: "Paramètres",
    formonly: "Ce problème a des tables que le formulaire ne montre pas : il les omettrait. Modifiez son texte.",
    value: "défaut", start: "Recommencer", steps: "Étapes", kind: "genre", point: "point", density: "densité",
    keys: {
      gravity: "pesanteur", spring: "ressort", torsion: "ressort de torsion", attraction: "attraction", far_centre: "centre lointain", self_gravity: "pesanteur propre", field: "champ",
      harmonic: "champ harmonique", volume: "énergie de volume", expression: "expression", covector: "entrée : covecteur", force: "entrée : force", input: "entrée", damping: "amortissement",
      title: "Titre", name: "nom", mass: "masse", at: "en", on: "au point", block: "bloc", between: "entre les points", anchor: "ancré en", stiffness: "raideur", length: "longueur", rest: "repos",
      strength: "intensité", centre: "centre", charges: "charges", coefficient: "coefficient", frame: "repère", space: "espace", body: "corps", kind: "genre", density: "densité",
      ball: "boule", box: "pavé", ellipsoid: "ellipsoïde", cylinder: "cylindre", cone: "cône", hollow_ball: "boule creuse", tetrahedron: "tétraèdre",
      radius: "rayon", height: "hauteur", sides: "côtés", semi_axes: "demi-axes", outer: "extérieur", inner: "intérieur", vertices: "sommets", rotation: "rotation", shift: "décalage",
    },
    unread: "Le texte n’est pas encore du TOML : le formulaire le montre dès que l’erreur y est corrigée.", sure: "Un nouveau problème remplace ce texte. Continuer ?",
    kept: (x) => `Gardés comme texte, sans changement : ${x}.`, nonumber: (x) => `« ${x} » n’est pas un nombre`, semicolons: "des valeurs séparées par , ; par ; si elles ont des virgules décimales",
    addpoint: "Ajouter un point", addforce: "Ajouter une force", madeof: "fait de", startsat: "Vitesse au départ", given: "moments, donnés",
  },
};

/* put the words of a language where the page asks for them */
export function inWords(words, root = document) {
  for (const e of root.querySelectorAll("[data-word]")) e.textContent = words[e.dataset.word];
  for (const e of root.querySelectorAll("[data-label]")) e.setAttribute("aria-label", words[e.dataset.label]);
}
