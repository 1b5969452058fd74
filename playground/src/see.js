/* The motion of the problem, in a frame: a new one for every problem, so that nothing of the last is left. */
import { make } from "./dom.js";

export class Motion {
  constructor(place) {
    this.place = place;
    addEventListener("message", ({ data, source, origin }) => {
      if (origin !== location.origin || source !== this.frame?.contentWindow) return;
      if (data.listens) source.postMessage(this.told, location.origin);
      else if (data.fault) this.say(data.fault);
      else Object.assign(this.frame.dataset, data);
      this.send();
    });
  }

  show(words, lang, told) {
    this.told = { ...told, lang, title: words.motion };
    this.more = null;
    this.frame = make("iframe", { src: "moving.html", title: words.motion });
    this.place.replaceChildren(make("p", { class: "note" }, words.moved), this.frame);
  }

  /* what it keeps, which is found behind it */
  keep(told) {
    this.more = { ...told, lang: this.told.lang, title: this.told.title };
    this.send();
  }

  send() {
    if (!this.more || this.frame?.dataset.moved === undefined) return;
    this.frame.contentWindow.postMessage(this.more, location.origin);
    this.more = null;
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
