// What both kinds of pages share: language, elements, and the numbers in data files.

const CH = { bodies: {}, motions: {}, waiting: {} };
window.CH = CH;

// A language is a text of its own in the table, and no method of every object.
Object.setPrototypeOf(TEXTS, null);
const hash = () => new URLSearchParams(location.hash.slice(1));
let language = hash().get("lang");
if (!TEXTS[language]) {
  try { language = localStorage.getItem("chereme-language"); } catch { language = null; }
}
if (!TEXTS[language]) language = Object.keys(TEXTS).find((it) => (navigator.language || "").startsWith(it)) || "en";

const t = (name, values) => {
  let text = TEXTS[language][name];
  for (const key in values || {}) text = text.replace("{" + key + "}", () => values[key]);
  return text;
};

function el(name, attributes, ...children) {
  const made = document.createElement(name);
  for (const key in attributes) {
    const value = attributes[key];
    if (key.startsWith("on")) made.addEventListener(key.slice(2), value);
    else if (value === true) made.setAttribute(key, "");
    else if (value !== false && value !== null && value !== undefined) made.setAttribute(key, value);
  }
  made.append(...children.flat().filter((it) => it !== null && it !== undefined && it !== false));
  return made;
}

function speak() {
  document.documentElement.dataset.lang = language;
  document.documentElement.lang = language;
  const choice = document.getElementById("language");
  choice.hidden = false;
  choice.value = language;
  choice.setAttribute("aria-label", t("choose-language"));
}

function changeLanguage(after) {
  const choice = document.getElementById("language");
  for (const it in TEXTS) choice.append(el("option", { value: it, lang: it }, TEXTS[it].language));
  choice.addEventListener("change", () => {
    language = choice.value;
    try { localStorage.setItem("chereme-language", language); } catch { /* It is chosen again next time. */ }
    speak();
    after();
  });
}

// Loads a movement and its body, each once.
CH.body = (name, it) => { CH.bodies[name] = it; };
CH.motion = (name, it) => { CH.motions[name] = it; };
CH.face = (name, it) => { CH.bodies[name].face = it; };
const loads = {};
const load = (path) => (loads[path] = loads[path] || new Promise((done, fail) => {
  document.head.append(el("script", { src: path, onload: done, onerror: fail }));
}));
const loadMotion = (root, motion, body) => Promise.all([load(root + "data/motion/" + encodeURIComponent(motion) + ".js"), load(root + "data/body/" + body + ".js")])
  .then(() => CH.motions[motion].face.length && load(root + "data/body/" + body + "-face.js"))
  .then(() => [CH.motions[motion], CH.bodies[body]]);

const link = (name) => "sign/" + encodeURIComponent(name) + "/index.html";

// The numbers of data files: see codes.rs.
class Numbers {
  constructor(text) {
    const letters = atob(text);
    this.bytes = new Uint8Array(letters.length);
    for (let at = 0; at < letters.length; at += 1) this.bytes[at] = letters.charCodeAt(at);
    this.at = 0;
  }

  number() {
    let rest = 0;
    let scale = 1;
    for (;;) {
      const byte = this.bytes[this.at];
      this.at += 1;
      rest += (byte & 127) * scale;
      if (!(byte & 128)) break;
      scale *= 128;
    }
    return rest % 2 ? -(rest + 1) / 2 : rest / 2;
  }

  row(length) {
    const order = this.bytes[this.at];
    this.at += 1;
    const row = new Float64Array(length);
    if (order === 0) return row.fill(this.number());
    if (order === 3) {
      row[0] = this.number();
      for (let at = 0; at < length - 1;) {
        const distance = this.number();
        const rise = this.number();
        for (let step = 1; step <= distance; step += 1) row[at + step] = row[at] + (rise * step) / distance;
        at += distance;
      }
      return row;
    }
    for (let at = 0; at < length; at += 1) row[at] = this.number();
    for (let again = 0; again < order; again += 1) for (let at = 1; at < length; at += 1) row[at] += row[at - 1];
    return row;
  }
}
