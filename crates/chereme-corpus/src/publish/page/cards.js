// Signs move in their cards: the one that is pointed at or has the focus, all in view, or none, as the reader chooses.

const MOVING = ["pointed", "seen", "none"];
// For each frame of the screen, cards are drawn for at most so many milliseconds.
const CARD_BUDGET = 14;

function movingCards() {
  const remembered = () => { try { return localStorage.getItem("chereme-moving"); } catch { return null; } };
  const less = matchMedia("(prefers-reduced-motion: reduce)").matches;
  const usual = less ? "none" : matchMedia("(hover: none)").matches ? "seen" : "pointed";
  let mode = [hash().get("moving"), remembered()].find((it) => MOVING.includes(it)) || usual;
  let renderer;
  const cards = new Map();
  let next = 0;
  let before = null;
  const begin = (link) => {
    if (cards.has(link) || !link.dataset.motion) return;
    const card = { player: null };
    cards.set(link, card);
    loadMotion("", link.dataset.motion, link.dataset.body).then(([motion, body]) => {
      if (cards.get(link) !== card) return;
      if (renderer === undefined) renderer = makeRenderer(el("canvas", { width: 240, height: 300 }));
      if (!renderer) return;
      card.player = makePlayer(renderer, body, motion);
      Object.assign(card.player, { time: 0 });
      card.canvas = el("canvas", { width: 240, height: 300, "aria-hidden": "true" });
      link.querySelector("img").after(card.canvas);
      if (cards.size === 1 || before === null) { before = performance.now(); requestAnimationFrame(tick); }
    }, () => {});
  };
  const end = (link) => {
    const card = cards.get(link);
    if (card && card.canvas) card.canvas.remove();
    cards.delete(link);
  };
  function tick(now) {
    const all = [...cards.values()].filter((it) => it.player && it.canvas.isConnected);
    const seconds = Math.min(now - before, 250) / 1000;
    before = all.length ? now : null;
    all.forEach((card) => card.player.pass(seconds));
    const stop = performance.now() + CARD_BUDGET;
    for (let count = 0; count < all.length && performance.now() < stop; count += 1) {
      const { player, canvas } = all[(next += 1) % all.length];
      player.draw();
      canvas.getContext("2d").drawImage(renderer.canvas, 0, 0);
      canvas.dataset.drawn = Number(canvas.dataset.drawn || 0) + 1;
    }
    if (all.length) requestAnimationFrame(tick);
  }
  const seen = window.IntersectionObserver && new IntersectionObserver((entries) => {
    for (const entry of entries) (entry.isIntersecting ? begin : end)(entry.target);
  });
  const list = document.getElementById("answer");
  const pointed = (event, run) => {
    const link = event.target.closest && event.target.closest(".cards a");
    if (mode === "pointed" && link && !link.contains(event.relatedTarget)) run(link);
  };
  for (const it of ["pointerover", "focusin"]) list.addEventListener(it, (event) => pointed(event, begin));
  for (const it of ["pointerout", "focusout"]) list.addEventListener(it, (event) => pointed(event, end));
  // Follows the cards of a new answer.
  const follow = () => {
    [...cards.keys()].forEach((link) => { if (!link.isConnected || mode !== "seen") end(link); });
    if (!seen) return;
    seen.disconnect();
    if (mode === "seen") document.querySelectorAll(".cards a[data-motion]").forEach((link) => seen.observe(link));
  };
  const choice = el("select", { onchange: () => {
    mode = choice.value;
    try { localStorage.setItem("chereme-moving", mode); } catch { /* It is chosen again next time. */ }
    follow();
  } }, MOVING.filter((it) => seen || it !== "seen").map((it) => el("option", { value: it, selected: it === mode, "data-t": "moving-" + it })));
  return { follow, choice: el("label", { class: "moving" }, el("span", { "data-t": "moving" }), " ", choice) };
}
