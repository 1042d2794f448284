// The page of a sign: a player in the place of the still picture.

const SPEEDS = [0.1, 0.25, 0.5, 0.75, 1, 1.5, 2];
const CAMERAS = ["front", "side", "hands", "face"];
// The film formats that browsers write, the most widely played one first.
const FILMS = [["video/mp4", "mp4"], ["video/webm", "webm"]];

function signPage(stage) {
  const says = el("p", { class: "hint", role: "status" });
  const hint = el("p", { class: "hint keys" });
  const controls = el("div", { class: "controls", role: "group" });
  const scrub = el("input", { type: "range", min: 0, step: "any", class: "scrub" });
  const speed = el("select", {}, SPEEDS.map((it) => el("option", { value: it, selected: it === 1 })));
  const slow = el("label", {}, el("span", {}), " ", speed);
  let player = null;
  const texts = () => {
    speak();
    for (const it of document.querySelectorAll("a.own")) it.href = it.getAttribute("href").split("#")[0] + "#lang=" + language;
    for (const it of document.querySelectorAll("[data-t]")) it.textContent = t(it.dataset.t);
    hint.textContent = player ? t("keys") : "";
    scrub.setAttribute("aria-label", t("scrub"));
    slow.firstChild.textContent = t("slow");
    for (const it of speed.options) it.textContent = Number(it.value).toLocaleString(language) + "×";
    const part = player && (player.from > 0 || player.to < player.frames - 1);
    const pressed = { play: player && player.playing, mirror: player && player.mirror, loopFrom: part, loopTo: part };
    for (const it of controls.querySelectorAll("button")) {
      const name = it.dataset.name;
      if (name === "play") it.textContent = player.playing ? t("pause") : t("play");
      else if (name === "camera") it.textContent = t("camera") + ": " + t(player.camera === "hands" ? "near2" : player.camera);
      else it.textContent = t(name.replace(/[A-Z]/, (letter) => "-" + letter.toLowerCase()));
      if (name === "mirror") it.setAttribute("aria-pressed", String(Boolean(pressed[name])));
      if (name === "loopAll") it.hidden = !part;
    }
    if (player) player.renderer.canvas.setAttribute("aria-label", t("image", { gloss: stage.dataset.gloss }));
  };
  document.documentElement.classList.toggle("embed", hash().has("embed"));
  shareLines(document.getElementById("share"), stage.dataset.gloss);
  changeLanguage(texts);
  texts();
  const keep = () => keepCopy(() => {});
  if (!stage.dataset.motion) { keep(); return; }
  const screen = el("div", { class: "screen" });
  const canvasOf = () => el("canvas", { width: 480, height: 600, role: "img", tabindex: 0 });
  loadMotion("../../", stage.dataset.motion, stage.dataset.body).then(([motion, body]) => {
    const renderer = makeRenderer(canvasOf());
    if (!renderer) { says.textContent = t("still"); return; }
    if (renderer.isSlow) says.textContent = t("plain");
    player = makePlayer(renderer, body, motion);
    screen.append(el("figure", {}, renderer.canvas, el("figcaption", {}, stage.dataset.gloss)));
    stage.querySelector("img").replaceWith(screen);
    stage.append(scrub, controls, says, hint);
    scrub.max = player.frames - 1;
    scrub.addEventListener("input", () => { player.seek(Number(scrub.value)); texts(); });
    speed.addEventListener("change", () => { player.speed = Number(speed.value); });
    player.changed = () => {
      scrub.value = player.time;
      const share = (frame) => (100 * frame) / Math.max(1, player.frames - 1) + "%";
      scrub.style.setProperty("--from", share(player.from));
      scrub.style.setProperty("--to", share(player.to));
    };
    const actions = {
      play: () => player.play(!player.playing), back: () => player.step(-1), next: () => player.step(1),
      loopFrom: () => player.part(player.time, player.time < player.to ? player.to : undefined),
      loopTo: () => player.part(player.time > player.from ? player.from : undefined, player.time),
      loopAll: () => player.part(),
      mirror: () => { player.mirror = !player.mirror; player.draw(); },
      camera: () => {
        player.camera = CAMERAS[(CAMERAS.indexOf(player.camera) + 1) % CAMERAS.length];
        Object.assign(player.turn, { yaw: 0, pitch: 0, zoom: 1 });
        player.draw();
      },
      wide: () => (document.fullscreenElement ? document.exitFullscreen() : stage.requestFullscreen()),
      film: () => saveFilm(player, stage.dataset.gloss, says),
    };
    const missing = { wide: !stage.requestFullscreen, film: !filmFormat(renderer.canvas) };
    for (const it in actions) if (!missing[it]) controls.append(el("button", { type: "button", "data-name": it, onclick: () => { actions[it](); texts(); } }));
    controls.append(slow);
    const slower = (by) => { speed.selectedIndex = Math.min(Math.max(speed.selectedIndex + by, 0), SPEEDS.length - 1); player.speed = Number(speed.value); };
    Object.assign(actions, { slower: () => slower(-1), faster: () => slower(1) });
    const keys = { " ": "play", ",": "back", ".": "next", s: "slower", d: "faster", m: "mirror", c: "camera", f: "wide", "[": "loopFrom", "]": "loopTo", "\\": "loopAll" };
    document.addEventListener("keydown", (event) => {
      if (event.ctrlKey || event.metaKey || event.altKey) return;
      const action = keys[event.key.toLowerCase()];
      if (!action || missing[action] || event.target.closest("select") || (event.key === " " && event.target.closest("button, a, input, summary"))) return;
      event.preventDefault();
      actions[action]();
      texts();
    });
    turnByHand(player);
    document.addEventListener("fullscreenchange", () => fitScreen(player, stage));
    window.addEventListener("resize", () => fitScreen(player, stage));
    for (const it of document.querySelectorAll("button.beside")) {
      it.hidden = false;
      it.addEventListener("click", () => showBeside(player, screen, it, canvasOf()));
    }
    // People who asked for less movement start it themselves.
    player.draw();
    player.play(!matchMedia("(prefers-reduced-motion: reduce)").matches);
    texts();
  }, () => { stage.append(says); says.textContent = t("missing"); }).finally(keep);
}

// Turns the body by pointer and arrows, and brings it nearer by + and −.
function turnByHand(player) {
  const { canvas } = player.renderer;
  const turn = (yaw, pitch, zoom = 1) => {
    const it = player.turn;
    it.yaw += player.mirror ? -yaw : yaw;
    it.pitch = Math.min(Math.max(it.pitch + pitch, -1.4), 1.4);
    it.zoom = Math.min(Math.max(it.zoom * zoom, 0.5), 6);
    player.draw();
  };
  canvas.addEventListener("pointerdown", (event) => canvas.setPointerCapture(event.pointerId));
  canvas.addEventListener("pointermove", (event) => {
    if (event.buttons && canvas.hasPointerCapture(event.pointerId)) turn(-event.movementX / 120, event.pointerType === "touch" ? 0 : -event.movementY / 120);
  });
  const steps = { ArrowLeft: [-0.2, 0], ArrowRight: [0.2, 0], ArrowUp: [0, -0.2], ArrowDown: [0, 0.2], "+": [0, 0, 1.2], "=": [0, 0, 1.2], "-": [0, 0, 1 / 1.2] };
  canvas.addEventListener("keydown", (event) => {
    if (event.ctrlKey || event.metaKey || event.altKey) return;
    if (event.key === "0") { Object.assign(player.turn, { yaw: 0, pitch: 0, zoom: 1 }); player.draw(); }
    else if (steps[event.key]) turn(...steps[event.key]);
    else return;
    event.preventDefault();
  });
}

// Gives the canvas the pixels of a whole screen, or those of the page.
function fitScreen(player, stage) {
  const wide = document.fullscreenElement === stage;
  const ratio = Math.min(2, window.devicePixelRatio || 1);
  const height = wide ? Math.round((window.innerHeight - 140) * ratio) : 600;
  for (const { renderer } of [player, player.beside].filter((it) => it)) Object.assign(renderer.canvas, { width: Math.round(height * 0.8), height });
  player.draw();
}

// Shows a minimal pair beside the sign, both in step; another press puts it away.
function showBeside(player, screen, button, canvas) {
  const isShown = button.getAttribute("aria-pressed") === "true";
  for (const it of document.querySelectorAll("button.beside")) it.setAttribute("aria-pressed", "false");
  while (screen.children.length > 1) screen.lastChild.remove();
  player.beside = null;
  for (const it of [screen, screen.closest("main")]) it.classList.toggle("two", !isShown);
  if (isShown) return;
  button.setAttribute("aria-pressed", "true");
  const { motion, body, gloss } = button.dataset;
  loadMotion("../../", motion, body).then(([it, skin]) => {
    const renderer = makeRenderer(canvas);
    if (!renderer) return;
    canvas.setAttribute("aria-label", t("image", { gloss }));
    player.beside = makePlayer(renderer, skin, it);
    screen.append(el("figure", {}, canvas, el("figcaption", {}, gloss + " ", el("span", {}, button.parentElement.querySelector(".differs").cloneNode(true)))));
    player.draw();
    screen.scrollIntoView({ block: "nearest" });
  }, () => {});
}

const filmFormat = (canvas) => canvas.captureStream && window.MediaRecorder && FILMS.find(([kind]) => MediaRecorder.isTypeSupported(kind));

// Saves one round as a film, at the speed and from the side that are chosen.
function saveFilm(player, gloss, says) {
  const { canvas } = player.renderer;
  const [mimeType, ending] = filmFormat(canvas);
  const recorder = new MediaRecorder(canvas.captureStream(60), { mimeType, videoBitsPerSecond: 4e6 });
  const parts = [];
  recorder.ondataavailable = (event) => parts.push(event.data);
  recorder.onstop = () => {
    const address = URL.createObjectURL(new Blob(parts, { type: mimeType }));
    el("a", { href: address, download: gloss + "." + ending }).click();
    setTimeout(() => URL.revokeObjectURL(address), 60000);
    says.textContent = t("film-saved", { name: gloss + "." + ending });
  };
  says.textContent = t("film-busy");
  player.seek(player.from);
  recorder.start();
  player.play(true);
  setTimeout(() => recorder.stop(), (1000 * (player.to - player.from)) / player.rate / player.speed + 1000 * ROUND_PAUSE);
}

// Shows the address of a sign, and the text that shows it in another page.
function shareLines(place, gloss) {
  if (!place || !/^https?:$/.test(location.protocol)) return;
  const address = location.href.split("#")[0];
  const title = gloss.replace(/&/g, "&amp;").replace(/"/g, "&quot;");
  const field = (name, value) => el("p", {}, el("label", {}, el("span", { "data-t": name }), el("input", { readonly: true, value, onfocus: (event) => event.target.select() })));
  place.append(el("details", {}, el("summary", { "data-t": "share" }), field("share-link", address),
    field("share-frame", `<iframe src="${address}#embed=1" title="${title}" width="500" height="860" allow="fullscreen"></iframe>`)));
}

const stage = document.getElementById("stage");
if (stage) signPage(stage);
