// The page of a sign: a player in the place of the still picture.

const SPEEDS = [1, 0.5, 0.25];
const CAMERAS = ["front", "side", "hands"];

CH.body = (name, it) => { CH.bodies[name] = it; };
CH.motion = (name, it) => { CH.motions[name] = it; };

const load = (path) => new Promise((done, fail) => {
  document.head.append(el("script", { src: path, onload: done, onerror: fail }));
});

function signPage(stage) {
  const says = el("p", { class: "hint", role: "status" });
  const controls = el("div", { class: "controls", role: "group" });
  const hint = el("p", { class: "hint keys" });
  stage.append(controls, says, hint);
  let player = null;
  const texts = () => {
    speak();
    const back = document.getElementById("back");
    back.href = back.getAttribute("href").split("#")[0] + "#lang=" + language;
    for (const it of document.querySelectorAll("a.pair")) it.href = it.getAttribute("href").split("#")[0] + "#lang=" + language;
    hint.textContent = player ? t("keys") : "";
    for (const it of controls.children) {
      const name = it.dataset.name;
      if (name === "play") it.textContent = player && player.playing ? t("pause") : t("play");
      else if (name === "slow") it.textContent = t("slow") + " " + (player ? player.speed : 1).toLocaleString(language) + "×";
      else if (name === "camera") it.textContent = t("camera") + ": " + t(player && player.camera === "hands" ? "near2" : player ? player.camera : "front");
      else it.textContent = t(name);
      if (name === "mirror") it.setAttribute("aria-pressed", String(Boolean(player && player.mirror)));
    }
    if (player) player.canvas.setAttribute("aria-label", t("image", { gloss: stage.dataset.gloss }));
  };
  changeLanguage(texts);
  texts();
  const keep = () => keepCopy(() => {});
  if (!stage.dataset.motion) { keep(); return; }
  const name = stage.dataset.motion;
  const body = stage.dataset.body;
  const files = [load("../../data/motion/" + encodeURIComponent(name) + ".js"), load("../../data/body/" + body + ".js")];
  Promise.all(files).then(() => {
    const canvas = el("canvas", { width: 480, height: 600, role: "img" });
    const shown = makePlayer(canvas, CH.bodies[body], CH.motions[name]);
    if (!shown) { says.textContent = t("still"); return; }
    player = shown;
    stage.querySelector("img").replaceWith(canvas);
    const act = (it, run) => controls.append(el("button", { type: "button", "data-name": it, onclick: () => { run(); texts(); } }));
    const actions = {
      play: () => player.play(!player.playing), back: () => player.step(-1), next: () => player.step(1),
      slow: () => { player.speed = SPEEDS[(SPEEDS.indexOf(player.speed) + 1) % SPEEDS.length]; },
      mirror: () => { player.mirror = !player.mirror; player.draw(); },
      camera: () => { player.camera = CAMERAS[(CAMERAS.indexOf(player.camera) + 1) % CAMERAS.length]; player.draw(); },
    };
    for (const it in actions) act(it, actions[it]);
    const keys = { " ": "play", ",": "back", ".": "next", s: "slow", m: "mirror", c: "camera" };
    document.addEventListener("keydown", (event) => {
      if (event.ctrlKey || event.metaKey || event.altKey) return;
      const action = keys[event.key.toLowerCase()];
      if (!action || (event.key === " " && event.target.closest("button, a, input"))) return;
      event.preventDefault();
      actions[action]();
      texts();
    });
    // People who asked for less movement start it themselves.
    player.play(!matchMedia("(prefers-reduced-motion: reduce)").matches);
    texts();
  }, () => { says.textContent = t("missing"); }).finally(keep);
}

const stage = document.getElementById("stage");
if (stage) signPage(stage);
