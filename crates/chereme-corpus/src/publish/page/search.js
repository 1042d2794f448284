// The first page: text, four choices, signs that fit, and signs that nearly fit.

const GROUPS = ["fist", "thumb", "index", "little", "two", "three", "four", "five", "ring", "other", "word"];
const FACETS = ["h", "p", "m", "n"];
const SHOWN = 60;
const NEAR = 36;
let data = null;
let state = { q: "", h: null, p: null, m: null, n: null };
let shown = SHOWN;
// For each facet and choice, the values that fit it.
const fits = {};

const fold = (text) => text.normalize("NFKD").replace(/[\u0300-\u036f]/g, "").toLowerCase()
  .replace(/œ/g, "oe").replace(/æ/g, "ae").replace(/ß/g, "ss").replace(/ø/g, "o").replace(/ł/g, "l").replace(/\s+/g, " ").trim();

const valueName = (value) => value[language] || value.en || value.id;
const named = (facet, at) => {
  const value = data.facets[facet][at];
  const name = valueName(value);
  return facet === "h" && fold(name) !== fold(value.id) ? value.id + " (" + name + ")" : name;
};

CH.data = (given) => {
  data = given;
  data.facets.n = [{ id: "1" }, { id: "2" }];
  for (const facet of ["h", "p", "m"]) {
    const values = data.facets[facet];
    fits[facet] = new Map();
    values.forEach((value, at) => {
      for (let up = at, steps = 0; up !== undefined && steps < 20; up = values[up].up, steps += 1) {
        const key = values[up].id;
        if (!fits[facet].has(key)) fits[facet].set(key, new Set());
        fits[facet].get(key).add(at);
      }
      if (facet === "h") {
        const key = "@" + value.group;
        if (!fits.h.has(key)) fits.h.set(key, new Set());
        fits.h.get(key).add(at);
      }
    });
  }
  fits.n = new Map([["1", new Set([0])], ["2", new Set([1])]]);
  // For each value, the choices that it fits.
  const keysOf = {};
  for (const facet of FACETS) {
    keysOf[facet] = data.facets[facet].map(() => []);
    for (const [key, values] of fits[facet]) for (const at of values) keysOf[facet][at].push(key);
  }
  for (const [at, sign] of data.signs.entries()) {
    sign.at = at;
    sign.keys = {};
    for (const facet of FACETS) {
      const own = has(facet, sign);
      sign.keys[facet] = [...new Set(own.flatMap((at) => keysOf[facet][at]))];
    }
    sign.f = sign.f || fold(sign.g);
    sign.words = "\n" + sign.f + "\n";
  }
  readState();
  build();
};

const has = (facet, sign) => (facet === "n" ? (sign.n ? [sign.n - 1] : []) : sign[facet] || []);

function readState() {
  const from = hash();
  for (const facet of FACETS) {
    const wanted = from.get(facet);
    state[facet] = wanted !== null && fits[facet].has(wanted) ? wanted : null;
  }
  state.q = from.get("q") || "";
  if (TEXTS[from.get("lang")]) language = from.get("lang");
}

function writeState() {
  const to = new URLSearchParams();
  if (state.q) to.set("q", state.q);
  for (const facet of FACETS) if (state[facet] !== null) to.set(facet, state[facet]);
  to.set("lang", language);
  history.replaceState(null, "", "#" + to.toString());
}

// How well a text fits a sign: 0 the whole gloss or word, 1 the beginning of a word, 2 within a word; nothing if it does not.
function textRank(sign, words, starts) {
  if (!words.length) return 0;
  for (const word of words) if (!sign.words.includes(word)) return null;
  if (sign.words.includes("\n" + words.join(" ") + "\n")) return 0;
  return starts.every((it) => it.test(sign.words)) ? 1 : 2;
}

// The expression for a word's beginning.
const start = (word) => new RegExp("[\\s\\-_(']" + word.replace(/[.*+?^${}()|[\]\\]/g, "\\$&"));

// What a value has in common with its neighbours: the fingers of a handshape; the wider value, or else the first word.
const kin = (facet, at) => {
  const value = data.facets[facet][at];
  return facet === "h" && value.group !== "other" && value.group !== "word" ? [value.group] : [value.up, value.id.split(/[\s_-]/)[0]].filter((it) => it !== undefined);
};

// The distance of a sign from a choice: 0 it fits, 0.5 its neighbour does, 1 it does not, and a little more if it is not coded.
function distance(facet, sign) {
  const wanted = fits[facet].get(state[facet]);
  const own = has(facet, sign);
  if (own.some((at) => wanted.has(at))) return 0;
  if (!own.length) return 1.01;
  if (facet === "n") return 1;
  const near = new Set([...wanted].flatMap((at) => kin(facet, at)));
  return own.some((at) => kin(facet, at).some((it) => near.has(it))) ? 0.5 : 1;
}

function found() {
  const words = fold(state.q).split(" ").filter((it) => it);
  const starts = words.map(start);
  const chosen = FACETS.filter((facet) => state[facet] !== null);
  const exact = [];
  const near = [];
  // How many signs would remain for each choice, if it took the place of the one of its kind.
  const counts = { h: new Map(), p: new Map(), m: new Map(), n: new Map() };
  const count = (facet, sign) => {
    for (const key of sign.keys[facet]) counts[facet].set(key, (counts[facet].get(key) || 0) + 1);
  };
  for (const sign of data.signs) {
    const rank = textRank(sign, words, starts);
    if (rank === null) continue;
    const off = chosen.map((facet) => [facet, distance(facet, sign)]).filter((it) => it[1] > 0);
    if (!off.length) {
      exact.push([rank, sign]);
      for (const facet of FACETS) count(facet, sign);
    } else {
      if (off.length === 1) count(off[0][0], sign);
      const sum = off.reduce((sum, it) => sum + it[1], 0);
      if (sum < 1 || (sum <= 1.01 && chosen.length > 1)) near.push([sum, rank, sign, off.map((it) => it[0])]);
    }
  }
  // The signs of an exact answer stand in the order of the data, which is that of their glosses.
  exact.sort((a, b) => a[0] - b[0] || a[1].at - b[1].at);
  near.sort((a, b) => a[0] - b[0] || a[1] - b[1] || a[2].at - b[2].at);
  return { exact: exact.map((it) => it[1]), near, counts };
}

// ---- the choices

const wide = () => matchMedia("(min-width: 60rem)").matches;
const buttons = [];
const copyShown = copyLines();
let moving = null;

function choice(facet, key, label, attributes, ...inside) {
  const count = el("span", { class: "count" });
  const button = el("button", Object.assign({ type: "button", "aria-pressed": "false", onclick: () => {
    state[facet] = state[facet] === key ? null : key;
    shown = SHOWN;
    update();
    // On a narrow page the answer would lie below all choices.
    const details = button.closest("details");
    if (details && state[facet] !== null && !wide()) {
      details.open = false;
      details.querySelector("summary").focus();
    }
  } }, attributes), ...inside, count);
  buttons.push({ facet, key, label, button, count });
  return button;
}

// Arrows move between the choices of a group, and one of them is in the order of Tab.
function roving(group) {
  const own = () => [...group.querySelectorAll("button")];
  own().forEach((button, at) => { button.tabIndex = at ? -1 : 0; });
  group.addEventListener("focusin", (event) => own().forEach((it) => { it.tabIndex = it === event.target ? 0 : -1; }));
  group.addEventListener("keydown", (event) => {
    const step = { ArrowRight: 1, ArrowDown: 1, ArrowLeft: -1, ArrowUp: -1 }[event.key];
    const all = own();
    const to = event.key === "Home" ? 0 : event.key === "End" ? all.length - 1 : all.indexOf(event.target) + step;
    if (!step && event.key !== "Home" && event.key !== "End") return;
    event.preventDefault();
    if (all[to]) all[to].focus();
  });
  return group;
}

function handshapes() {
  const values = data.facets.h;
  const groups = GROUPS.filter((group) => values.some((it) => it.group === group));
  const hint = values.some((it) => it.as) && el("p", { class: "hint", "data-t": "namesakes" });
  return [hint, ...groups.map((group) => {
    const own = values.map((value, at) => [value, at]).filter((it) => it[0].group === group);
    const all = own.length > 1 && choice("h", "@" + group, () => t("all"), { class: "word" }, el("span", { class: "name" }));
    const cells = own.map(([value, at]) => choice("h", value.id, () => named("h", at), { class: "cell" },
      value.pic && el("img", { src: "hands/" + value.pic + ".png", width: 64, height: 64, alt: "", loading: "lazy" }),
      el("span", { class: "name" }), value.like && el("small", { "data-like": value.like })));
    return roving(el("div", { class: "group", role: "group", "data-group": group }, el("h2", {}), all, cells));
  })];
}

function places() {
  const values = data.facets.p;
  const panels = data.panels.map((panel) => {
    const spots = values.filter((it) => it.panel === panel.name).map((value) => choice("p", value.id, () => valueName(value),
      { class: "spot", style: null }, el("span", { class: "name" })));
    values.filter((it) => it.panel === panel.name).forEach((value, at) => {
      spots[at].style.left = value.x + "%";
      spots[at].style.top = value.y + "%";
    });
    const picture = el("div", { class: "panel" }, el("img", { src: "places/" + panel.name + ".png", width: panel.w, height: panel.h, alt: "", loading: "lazy" }), spots);
    return el("figure", { "data-panel": panel.name }, el("figcaption", {}), roving(picture));
  });
  const list = roving(el("div", { class: "group", role: "group", "data-label": "place" }, values.map((value) => choice("p", value.id, () => valueName(value), { class: "word" }, el("span", { class: "name" })))));
  return [el("div", { class: "panels" }, panels), list];
}

// Drawn marks for the common movements.
const ICONS = {
  straight: "M3 16h22M19 10l6 6-6 6", arc: "M4 22C8 6 22 6 27 20M20 18l7 2 1-7", circle: "M26 16a10 10 0 1 1-4-8M23 3l-1 5 5 1", zigzag: "M3 20l6-9 6 9 6-9 6 9",
  wavy: "M3 16c4-10 8-10 12 0s8 10 12 0", spiral: "M16 16c2-3 6 0 4 4s-10 3-10-4 8-11 15-6", hold: "M10 7v18M21 7v18", tap: "M16 3v18M10 15l6 6 6-6M6 27h20",
  twisting: "M7 12a10 8 0 0 1 18 0M25 6v6h-6M25 20a10 8 0 0 1-18 0M7 26v-6h6", nodding: "M6 8c14 0 18 6 18 16M18 18l6 6 5-7", swinging: "M5 10c4 14 18 14 22 0M22 10l5 0 1 5", wiggle: "M7 24V12M13 24V8M19 24V12M25 24V8",
  opening: "M16 16L5 9M16 16L27 9M16 16V4M5 15V9h6M21 9h6v6", closing: "M5 6l9 9M27 6l-9 9M14 9v6H8M18 9v6h6M16 18v9", brush: "M4 20h24M8 12h14M17 7l5 5-5 5", path: "M4 22c8 0 8-12 16-12h7M22 5l5 5-5 5",
};

function icon(id) {
  if (!ICONS[id]) return null;
  const svg = document.createElementNS("http://www.w3.org/2000/svg", "svg");
  for (const [key, value] of [["viewBox", "0 0 32 32"], ["width", "32"], ["height", "32"], ["aria-hidden", "true"]]) svg.setAttribute(key, value);
  const path = document.createElementNS("http://www.w3.org/2000/svg", "path");
  path.setAttribute("d", ICONS[id]);
  svg.append(path);
  return svg;
}

function movements() {
  return [roving(el("div", { class: "group", role: "group", "data-label": "movement" }, data.facets.m.map((value) => choice("m", value.id, () => valueName(value), { class: "cell small" }, icon(value.id), el("span", { class: "name" })))))];
}

function hands() {
  return [roving(el("div", { class: "group", role: "group", "data-label": "hands" }, [["1", "one"], ["2", "two"]].map(([key, name]) => choice("n", key, () => t(name), { class: "word" }, el("span", { class: "name" })))))];
}

function build() {
  moving = movingCards();
  const search = el("input", { id: "q", type: "search", autocomplete: "off", spellcheck: "false", oninput: (event) => {
    state.q = event.target.value;
    shown = SHOWN;
    update();
  } });
  const picker = (facet, name, inside) => data.facets[facet].length > 0 && el("details", { "data-facet": facet, open: state[facet] !== null && wide() }, el("summary", {}, el("span", { "data-t": name }), " ", el("b", { class: "chosen" })), inside);
  document.getElementById("choices").append(
    el("p", { class: "row" }, el("label", { for: "q", "data-t": "search" }), search, el("button", { type: "button", id: "clear", "data-t": "clear", onclick: clear })),
    el("p", { class: "hint", "data-t": "about" }),
    picker("h", "shape", handshapes()) || "", picker("p", "place", places()) || "", picker("m", "movement", movements()) || "", picker("n", "hands", hands()) || "",
    el("p", { class: "hint keys", "data-t": "keys-search" }));
  document.getElementById("answer").append(el("p", { class: "row" }, el("span", { id: "total", role: "status" }), data.signs.some((sign) => sign.v) && moving.choice), el("ol", { id: "exact", class: "cards" }), el("p", { id: "moreRow" }, el("button", { type: "button", id: "more", "data-t": "more", onclick: () => { shown += 4 * SHOWN; update(); } })),
    el("h2", { id: "nearTitle", "data-t": "near" }), el("ol", { id: "near", class: "cards" }));
  document.querySelector("footer").append(copyShown.line);
  search.value = state.q;
  changeLanguage(update);
  window.addEventListener("hashchange", () => { readState(); search.value = state.q; update(); });
  document.addEventListener("keydown", (event) => {
    if (event.ctrlKey || event.metaKey || event.altKey) return;
    if (event.key === "/" && event.target !== search) { event.preventDefault(); search.focus(); }
    if (event.key === "Escape") clear();
    const only = document.querySelectorAll("#exact a");
    if (event.key === "Enter" && event.target === search && only.length === 1) only[0].click();
  });
  update();
  keepCopy(copyShown.draw);
}

function clear() {
  state = { q: "", h: null, p: null, m: null, n: null };
  shown = SHOWN;
  document.getElementById("q").value = "";
  update();
}

function card(sign, off) {
  const shape = (sign.h || []).map((at) => data.facets.h[at]).find((it) => it.pic);
  const picture = sign.v ? el("div", { class: "picture" }, el("img", { src: "sign/" + encodeURIComponent(sign.d || sign.g) + "/still.png", width: 120, height: 150, alt: "", loading: "lazy" }))
    : shape ? el("img", { class: "hand", src: "hands/" + shape.pic + ".png", width: 64, height: 64, alt: "", loading: "lazy" }) : el("span", { class: "nothing" });
  const words = (sign.w || []).filter((it) => it[0] === language).map((it) => it[1]);
  const others = words.length ? words : (sign.w || []).map((it) => it[1]);
  const differs = off && off.map((facet) => {
    const own = has(facet, sign);
    const name = { h: "shape", p: "place", m: "movement", n: "hands" }[facet];
    return t(name) + (own.length ? " " + own.map((at) => (facet === "n" ? t(at ? "two" : "one") : facet === "h" ? data.facets.h[at].id : named(facet, at))).join(", ") : " " + t("unknown"));
  });
  return el("li", {}, el("a", { href: link(sign.d || sign.g) + "#lang=" + language, "data-motion": sign.v && (sign.d || sign.g), "data-body": sign.v }, picture, el("b", {}, sign.g), el("span", {}, others.slice(0, 3).join(", ")), differs && el("em", {}, t("differs", { what: differs.join("; ") }))));
}

function update() {
  speak();
  for (const it of document.querySelectorAll("[data-t]")) it.textContent = t(it.dataset.t);
  for (const it of document.querySelectorAll("[data-group]")) {
    it.querySelector("h2").textContent = t("groups-" + it.dataset.group);
    it.setAttribute("aria-label", t("groups-" + it.dataset.group));
  }
  for (const it of document.querySelectorAll("[data-label]")) it.setAttribute("aria-label", t(it.dataset.label));
  for (const it of document.querySelectorAll("[data-like]")) it.textContent = t("like", { shape: it.dataset.like });
  for (const it of document.querySelectorAll("[data-panel] figcaption")) it.textContent = t("panels-" + it.parentElement.dataset.panel);
  const answer = found();
  for (const { facet, key, label, button, count } of buttons) {
    const n = answer.counts[facet].get(key) || 0;
    const pressed = state[facet] === key;
    count.textContent = n;
    button.setAttribute("aria-pressed", String(pressed));
    button.classList.toggle("empty", n === 0 && !pressed);
    const text = label();
    button.title = text;
    button.querySelector(".name").textContent = text;
    if (button.classList.contains("spot")) button.setAttribute("aria-label", text + ", " + n);
  }
  for (const details of document.querySelectorAll("details[data-facet]")) {
    const key = state[details.dataset.facet];
    const known = buttons.find((it) => it.facet === details.dataset.facet && it.key === key);
    details.querySelector(".chosen").textContent = known ? (key.startsWith("@") ? t("groups-" + key.slice(1)) : known.label()) : "";
  }
  const n = answer.exact.length;
  document.getElementById("total").textContent = n === 0 ? t("none") : n === 1 ? t("sign") : t("signs", { n });
  document.getElementById("exact").replaceChildren(...answer.exact.slice(0, shown).map((sign) => card(sign)));
  document.getElementById("moreRow").hidden = n <= shown;
  const near = answer.near.slice(0, NEAR);
  document.getElementById("nearTitle").hidden = !near.length;
  document.getElementById("near").replaceChildren(...near.map((it) => card(it[2], it[3])));
  moving.follow();
  copyShown.draw();
  writeState();
}
