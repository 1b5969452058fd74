/* The motion of the problem, in a frame: a new one for every problem, so that nothing of the last is left. */
import { make } from "./dom.js";

export class Motion {
  constructor(place) {
    this.place = place;
    addEventListener("message", ({ data, source, origin }) => {
      if (origin !== location.origin || source !== this.frame?.contentWindow) return;
      if (data.listens) source.postMessage(this.told, location.origin);
      else if (data.fault) this.say(data.fault);
      else this.frame.dataset.moved = "";
    });
  }

  show(words, lang, told) {
    this.told = { ...told, lang, title: words.motion };
    this.frame = make("iframe", { src: "moving.html", title: words.motion });
    this.place.replaceChildren(make("p", { class: "note" }, words.moved), this.frame);
  }

  say(text) {
    this.frame = null;
    this.place.replaceChildren(make("p", { class: "fault" }, text));
  }

  clear() {
    this.frame = null;
    this.place.replaceChildren();
  }
}
