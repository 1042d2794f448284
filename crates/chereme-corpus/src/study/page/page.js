const data = JSON.parse(document.getElementById("data").textContent);
const screenBox = document.getElementById("screen");
const help = document.getElementById("help");
const KEY = "chereme-study:" + data.plan_sha256;
const CODE = /^[\p{L}\p{N}][\p{L}\p{N}\-_. ]{0,59}$/u;

// The file of answers; everything else follows from it.
let person = null;
let language = (navigator.language || "en").toLowerCase().startsWith("fr") ? "fr" : "en";
// Shows the present screen again, after a change of language.
let again = () => {};
// Handles a key on the present screen; true if it did something.
let onKey = () => false;
let dirty = false;

const t = (name) => TEXTS[language][name];
const said = (texts, otherwise) => (texts && (texts[language] || texts.en || Object.values(texts)[0])) || otherwise || "";

// Builds an element: attributes, event handlers that begin with "on", and children.
function el(name, attributes, ...children) {
  const it = document.createElement(name);
  for (const [key, value] of Object.entries(attributes || {})) {
    if (key.startsWith("on")) it.addEventListener(key.slice(2), value);
    else if (value === true) it.setAttribute(key, "");
    else if (value !== false && value !== null && value !== undefined) it.setAttribute(key, value);
  }
  it.append(...children.flat(Infinity).filter((child) => child !== null && child !== undefined && child !== false));
  return it;
}

const button = (text, onclick, attributes) => el("button", { type: "button", onclick, ...attributes }, text);

// A film in sign language that somebody put into the folder: media/NAME.fr.mp4, media/NAME.mp4, or the same as .webm.
function signed(name) {
  const safe = name.replace(/[^\p{L}\p{N}\-_.]/gu, "_");
  const tries = [`${safe}.${language}.mp4`, `${safe}.${language}.webm`, `${safe}.mp4`, `${safe}.webm`];
  const video = el("video", { class: "signed", muted: true, playsinline: true, controls: true, preload: "metadata", hidden: true });
  video.muted = true;
  const next = () => {
    if (tries.length) video.src = "media/" + encodeURIComponent(tries.shift());
    else video.remove();
  };
  video.addEventListener("loadedmetadata", () => { video.hidden = false; });
  video.addEventListener("error", next);
  next();
  return video;
}

function show(...children) {
  onKey = () => false;
  screenBox.replaceChildren(...children.flat().filter(Boolean));
  window.scrollTo(0, 0);
  screenBox.focus({ preventScroll: true });
  tools();
}

function tools() {
  document.documentElement.lang = language;
  document.title = said(data.title, data.study);
  document.getElementById("title").textContent = said(data.title, data.study);
  const switched = () => {
    language = language === "fr" ? "en" : "fr";
    if (person) person.language = language;
    keep();
    again();
  };
  document.getElementById("tools").replaceChildren(
    person && !person.finished ? button(t("save"), () => save()) : "",
    button(t("help"), showHelp, { "aria-keyshortcuts": "?" }),
    button(t("language"), switched, { lang: language === "fr" ? "en" : "fr" }),
  );
}

function progress(done, of) {
  const bar = document.getElementById("progress");
  const percent = of ? Math.round((100 * done) / of) : 0;
  bar.setAttribute("aria-valuenow", percent);
  bar.firstElementChild.style.width = percent + "%";
}

// ---- keeping answers

function keep() {
  if (!person) return;
  dirty = true;
  try { localStorage.setItem(KEY, JSON.stringify(person)); } catch { /* The file that people save is what counts. */ }
}

function kept() {
  try { return readable(localStorage.getItem(KEY)); } catch { return null; }
}

// Returns saved answers if they can be continued here.
function readable(text) {
  let it;
  try { it = JSON.parse(text); } catch { return null; }
  const whole = it && it.format === "chereme-answers" && it.version === 1 && it.plan_sha256 === data.plan_sha256
    && typeof it.participant === "string" && Number.isInteger(it.seed) && it.seed >= 0 && Array.isArray(it.answers)
    && it.answers.every((answer) => answer && Number.isInteger(answer.n)) && (it.skipped === undefined || Array.isArray(it.skipped)) && it.profile && typeof it.profile === "object" && it.consent && typeof it.consent === "object";
  return whole ? it : null;
}

// Saves the answers that this browser keeps before those of `next` take their place, if they would be lost.
function rescue(next) {
  const earlier = kept();
  const same = earlier && next && earlier.participant === next.participant && earlier.seed === next.seed;
  if (!earlier || !earlier.answers.length || (same && earlier.answers.length <= next.answers.length)) return;
  person = earlier;
  save();
}

function save() {
  const plain = (text) => text.replace(/[^\p{L}\p{N}\-_]+/gu, "-");
  const name = `${plain(data.study)}-${plain(person.participant)}.json`;
  const blob = new Blob([JSON.stringify(person, null, 1) + "\n"], { type: "application/json" });
  const link = el("a", { href: URL.createObjectURL(blob), download: name });
  document.body.append(link);
  link.click();
  link.remove();
  setTimeout(() => URL.revokeObjectURL(link.href), 60000);
  dirty = false;
  return name;
}

window.addEventListener("beforeunload", (event) => { if (dirty) event.preventDefault(); });

// ---- help

function helpContent() {
  return [
    el("p", {}, t("how1")), el("p", {}, t("how2")), el("p", {}, t("how3")),
    el("dl", { class: "keys" }, t("keys").filter(([key]) => key !== "0" || data.questions.some((question) => question.cannot_say)).map(([key, what]) => [el("dt", {}, el("kbd", {}, key)), el("dd", {}, what)])),
  ];
}

function showHelp() {
  help.replaceChildren(el("h2", {}, t("how")), signed("instructions"), ...helpContent(), button(t("close"), () => help.close(), { class: "main" }));
  if (!help.open) help.showModal();
}

// ---- screens before the films

function welcome() {
  again = welcome;
  const earlier = kept();
  const code = el("input", { id: "code", type: "text", maxlength: 60, autocomplete: "off", spellcheck: "false", "aria-describedby": "why" });
  code.value = (person && person.participant) || newCode();
  const box = (name) => el("input", { type: "checkbox", id: name });
  const [adult, analysis, publication] = ["adult", "analysis", "publication"].map(box);
  const fault = el("p", { class: "fault", role: "alert" });
  const start = () => {
    if (!adult.checked || !analysis.checked) { fault.textContent = t("needed"); (adult.checked ? analysis : adult).focus(); return; }
    if (!CODE.test(code.value.trim())) { fault.textContent = t("codeWrong"); code.focus(); return; }
    begin(code.value.trim(), publication.checked);
  };
  const file = el("input", { type: "file", accept: ".json,application/json", hidden: true, onchange: async () => {
    const found = file.files.length ? readable(await file.files[0].text()) : null;
    if (found) proceed(found); else fault.textContent = t("fileWrong");
  } });
  const labelled = (input) => el("label", { class: "check" }, input, el("span", {}, t(input.id)));
  const section = (name) => said(data.consent[name]) && el("section", {}, el("h2", {}, t(name)), el("p", {}, said(data.consent[name])));
  show(
    el("h1", {}, t("welcome")), signed("consent"),
    el("p", {}, said(data.consent.purpose, t("purpose"))), el("p", {}, t("private")), section("kept"), section("contact"),
    el("div", { class: "card" },
      labelled(adult), labelled(analysis), labelled(publication), el("p", {}, t("stop")),
      el("label", { for: "code", class: "name" }, t("code")), code, el("p", { id: "why", class: "quiet" }, t("codeWhy"))),
    fault,
    el("p", { class: "row" }, button(t("start"), start, { class: "main" }),
      earlier && button(t("resume"), () => proceed(earlier)),
      button(t("file"), () => file.click()), file),
  );
  progress(0, 1);
  onKey = (event) => event.key === "Enter" && (event.target === code || event.target === screenBox) && (start(), true);
}

function newCode() {
  const letters = "abcdefghjkmnpqrstuvwxyz23456789";
  const random = crypto.getRandomValues(new Uint32Array(6));
  return Array.from(random, (number) => letters[number % letters.length]).join("");
}

function begin(code, publication) {
  // ?n=12 in the address gives participant number 12 the row of that number; others draw one once.
  const number = Number(new URLSearchParams(location.search).get("n"));
  const seed = Number.isInteger(number) && number > 0 ? number - 1 : crypto.getRandomValues(new Uint32Array(1))[0];
  rescue(null);
  const now = new Date();
  const two = (value) => String(value).padStart(2, "0");
  person = {
    format: "chereme-answers", version: 1, study: data.study, plan_sha256: data.plan_sha256, participant: code, seed,
    started_day: `${now.getFullYear()}-${two(now.getMonth() + 1)}-${two(now.getDate())}`, language,
    device: { w: innerWidth, h: innerHeight, dpr: devicePixelRatio || 1 },
    consent: { analysis: true, publication }, profile: {}, finished: false, answers: [],
  };
  keep();
  instructions();
}

// Goes on with answers that were kept or saved.
function proceed(saved) {
  rescue(saved);
  person = saved;
  language = saved.language === "fr" ? "fr" : "en";
  keep();
  if (person.finished) thanks(); else if (person.answers.length) trial(); else instructions();
}

function instructions() {
  again = instructions;
  show(el("h1", {}, t("how")), signed("instructions"), ...helpContent(),
    el("p", { class: "row" }, button(t("begin"), () => trial(), { class: "main" })));
  onKey = (event) => event.key === "Enter" && (trial(), true);
}

// ---- films and questions

const row = () => data.rows[person.seed % data.rows.length];
const asked = (it, after) => data.questions.filter((question) =>
  (question.after || "first") === after && (!question.parts || !question.parts.length || question.parts.includes(it.part)));
const both = (it) => [...asked(it, "first"), ...asked(it, "second")];
const answersTo = (n) => person.answers.filter((answer) => answer.n === n);

// Shows the first trial that is not answered.
function trial() {
  const order = row();
  const skipped = person.skipped || [];
  const at = order.findIndex(([index], at) => !skipped.includes(at + 1) && answersTo(at + 1).length < both(data.trials[index]).length);
  if (at < 0) { profile(); return; }
  // A trial that was left in the middle begins again: its film has to be seen for its questions.
  person.answers = person.answers.filter((answer) => answer.n !== at + 1);
  const part = (place) => data.trials[order[place][0]].part;
  if (at > 0 && part(at) !== part(at - 1)) interlude(order, at); else view(order, at);
}

function interlude(order, at) {
  again = () => interlude(order, at);
  const number = data.parts.indexOf(data.trials[order[at][0]].part) + 1;
  show(el("h1", {}, `${t("part")} ${number} ${t("of")} ${data.parts.length}`), el("p", {}, t("partWhy")),
    el("p", { class: "row" }, button(t("next"), () => view(order, at), { class: "main" })));
  onKey = (event) => event.key === "Enter" && (view(order, at), true);
}

function view(order, at) {
  const [index, block] = order[at];
  const it = data.trials[index];
  const now = { n: at + 1, plays: 0, slow: 0, hidden: 0, ended: 0, since: 0, given: new Map(), stage: "first" };
  if (!asked(it, "first").length) now.stage = "second";

  const film = el("video", { class: "film", playsinline: true, preload: "auto", tabindex: -1 });
  film.muted = true;
  film.src = "media/" + it.film;
  const broken = el("div", { class: "notice", role: "alert", hidden: true });
  film.addEventListener("error", () => { now.broken = true; ready(); });
  const play = (rate) => {
    film.pause();
    film.currentTime = 0;
    film.playbackRate = rate;
    if (rate < 1) now.slow += 1;
    film.play().catch(() => { /* Browsers that forbid playing by itself leave it to the button. */ });
  };
  film.addEventListener("ended", () => {
    now.plays += 1;
    now.ended += 1;
    if (now.ended === 1) now.since = performance.now();
    ready();
  });
  film.addEventListener("click", () => play(1));
  const hides = () => { if (document.hidden) now.hidden += 1; };
  document.addEventListener("visibilitychange", hides);

  const hint = el("p", { class: "hint", "aria-live": "polite" });
  const list = el("div", { class: "questions" });
  const next = button(t("next"), () => goOn(), { class: "main", disabled: true, "aria-keyshortcuts": "Enter" });
  const seen = () => now.ended >= (now.stage === "first" || !asked(it, "first").length ? 1 : 2);
  const open = () => asked(it, now.stage);
  let fields = [];

  // Unlocks the questions of this viewing once the film was seen.
  function ready() {
    const can = seen();
    fields.forEach((field) => { field.box.disabled = !can; });
    const left = fields.filter((field) => !now.given.has(field.question.name));
    next.disabled = !can || left.length > 0;
    fields.forEach((field) => field.box.classList.toggle("current", can && field === left[0]));
    // An empty hint keeps its line, so that nothing moves when it goes.
    broken.hidden = !now.broken || can;
    if (!broken.hidden) broken.replaceChildren(el("p", {}, t("broken")), button(t("without"), skip));
    hint.textContent = can || now.broken ? "" : t(now.stage === "first" || !asked(it, "first").length ? "watch" : "watchAgain");
    return left[0];
  }

  function ask() {
    fields = open().map((question) => field(question, now.given.get(question.name), (given) => {
      now.given.set(question.name, { ...given, plays: now.plays, slow: now.slow, ms: Math.max(0, Math.round(performance.now() - now.since)) });
      ready();
    }));
    list.replaceChildren(...fields.map((one) => one.box));
    ready();
  }

  // Goes on without a film that cannot be shown; what was answered before stays.
  function skip() {
    person.skipped = [...(person.skipped || []), now.n];
    leave();
  }

  function goOn() {
    if (next.disabled) return;
    if (now.stage === "first" && asked(it, "second").length) {
      now.stage = "second";
      now.ended = Math.min(now.ended, 1);
      ask();
      play(1);
      return;
    }
    leave();
  }

  function leave() {
    document.removeEventListener("visibilitychange", hides);
    for (const question of both(it).filter((one) => now.given.has(one.name))) {
      const given = now.given.get(question.name);
      const scale = question.kind.scale;
      person.answers.push({
        n: now.n, block, part: it.part, item: it.item, condition: it.condition, role: it.role, question: question.name,
        scale: scale ? [scale.low, scale.high] : null, value: given.value, choice: given.choice, right: null,
        plays: given.plays, ms: given.ms, hidden: now.hidden, slow: given.slow,
      });
    }
    film.pause();
    keep();
    trial();
  }

  function draw() {
    again = draw;
    next.textContent = t("next");
    const number = it.role === "training" ? t("training") : `${t("film")} ${at + 1} ${t("of")} ${order.length}`;
    show(
      el("div", { class: "trial" },
        el("div", { class: "stage" },
          el("p", { class: "count" }, number), it.role === "training" && el("p", { class: "quiet" }, t("trainingWhy")),
          film, broken,
          el("p", { class: "row" }, button(t("again"), () => play(1), { "aria-keyshortcuts": "Space R" }), button(t("slow"), () => play(0.5), { "aria-keyshortcuts": "S" }))),
        el("div", { class: "answers" }, hint, list, el("p", { class: "row" }, next))),
    );
    ask();
    onKey = (event) => {
      const key = event.key.toLowerCase();
      const control = event.target.closest && event.target.closest("button, a, dialog");
      if (key === "r" || (key === " " && !control)) { play(1); return true; }
      if (key === "s") { play(0.5); return true; }
      if (key === "enter" && !control) {
        if (next.disabled && seen()) { hint.textContent = t("answerAll"); }
        goOn();
        return true;
      }
      const left = fields.find((one) => !now.given.has(one.question.name)) || fields[fields.length - 1];
      if (seen() && left && /^[0-9]$/.test(key)) return left.digit(Number(key));
      if (seen() && left && key.startsWith("arrow") && !event.target.closest("fieldset")) { left.focus(); return true; }
      return false;
    };
  }
  progress(at, order.length);
  draw();
  play(1);
  // The next film is fetched while this one is watched.
  if (at + 1 < order.length) { const ahead = el("video", { preload: "auto" }); ahead.src = "media/" + data.trials[order[at + 1][0]].film; }
}

// A question as a group of radio buttons; `give` hears the answer.
function field(question, given, give) {
  const name = "q-" + question.name;
  const scale = question.kind.scale;
  const options = scale
    ? Array.from({ length: scale.high - scale.low + 1 }, (_, at) => ({ value: scale.low + at, label: said((scale.labels || {})[scale.low + at]) }))
    : question.kind.choice.options.map((option) => ({ choice: option.name, label: said(option.text, option.name), picture: option.picture }));
  if (question.cannot_say) options.push({ aside: true, label: t("cannotSay") });
  const inputs = [];
  const list = options.map((option) => {
    const input = el("input", { type: "radio", name, onchange: () => give({ value: option.value ?? null, choice: option.choice ?? null }) });
    input.checked = Boolean(given) && (given.value ?? null) === (option.value ?? null) && (given.choice ?? null) === (option.choice ?? null);
    inputs.push(input);
    const kind = option.aside ? "aside" : scale ? "point" : option.picture ? "picture" : "word";
    return el("label", { class: kind }, input,
      option.picture && el("img", { src: "media/" + encodeURIComponent(option.picture), alt: "" }),
      scale && !option.aside && el("strong", {}, String(option.value)), option.label && el("span", {}, option.label));
  });
  const box = el("fieldset", {}, el("legend", {}, said(question.text, question.name)), signed("question-" + question.name),
    el("div", { class: scale ? "scale" : options.some((one) => one.picture) ? "pictures" : "words" }, list.filter((_, at) => !options[at].aside)),
    list.filter((_, at) => options[at].aside));
  const pick = (at) => {
    if (at < 0 || at >= inputs.length) return false;
    inputs[at].checked = true;
    inputs[at].dispatchEvent(new Event("change"));
    return true;
  };
  return {
    question, box,
    digit: (number) => number === 0 && question.cannot_say && !(scale && scale.low === 0) ? pick(inputs.length - 1) : pick(scale ? (number < scale.low || number > scale.high ? -1 : number - scale.low) : number - 1),
    focus: () => pick(0) && inputs[0].focus(),
  };
}

// ---- screens after the films

function profile() {
  if (!data.profile.length) { finish(); return; }
  again = profile;
  const groups = data.profile.map((question) => {
    const name = "p-" + question.name;
    const one = (value, label, skip) => {
      const input = el("input", { type: "radio", name, onchange: () => {
        if (skip) delete person.profile[question.name]; else person.profile[question.name] = value;
        keep();
      } });
      input.checked = skip ? !(question.name in person.profile) : person.profile[question.name] === value;
      return el("label", { class: skip ? "word skip" : "word" }, input, el("span", {}, label));
    };
    return el("fieldset", {}, el("legend", {}, said(question.text, question.name)), signed("profile-" + question.name),
      el("div", { class: "words" }, question.options.map((option) => one(option.name, said(option.text, option.name), false)), one(null, t("skip"), true)));
  });
  show(el("h1", {}, t("about")), el("p", {}, t("aboutWhy")), el("div", { class: "about" }, groups),
    el("p", { class: "row" }, button(t("finish"), finish, { class: "main" })));
  progress(1, 1);
  onKey = (event) => event.key === "Enter" && !event.target.closest("button") && (finish(), true);
}

function finish() {
  person.finished = true;
  keep();
  thanks();
}

function thanks() {
  again = thanks;
  const done = el("p", { role: "status" });
  const saveAll = () => { done.textContent = t("saved").replace("{name}", save()); };
  const other = () => {
    if (dirty) save();
    try { localStorage.removeItem(KEY); } catch { /* Nothing was kept. */ }
    person = null;
    dirty = false;
    welcome();
  };
  show(el("h1", {}, t("thanks")), signed("end"), el("p", {}, t("thanksWhy")),
    said(data.consent.contact) && el("p", {}, said(data.consent.contact)),
    el("p", {}, t("yourCode"), " ", el("strong", { class: "code" }, person.participant)),
    el("p", { class: "row" }, button(t("saveAll"), saveAll, { class: "main" }), button(t("again2"), other)), done);
  progress(1, 1);
  onKey = (event) => event.key === "Enter" && !event.target.closest("button") && (saveAll(), true);
}

document.addEventListener("keydown", (event) => {
  if (event.ctrlKey || event.metaKey || event.altKey || event.repeat || help.open) return;
  if (event.target.matches("input[type=text]") && event.key !== "Enter") return;
  if (event.key === "?") { event.preventDefault(); showHelp(); return; }
  if (onKey(event)) event.preventDefault();
});

welcome();
