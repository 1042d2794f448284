// The copy of the dictionary on this device, if it comes from a web server: see sw.js.

const ROOT = new URL(".", document.currentScript.src).href;
const COPY = "chereme-copy " + ROOT;
// A dictionary of at most so many bytes is kept whole without a question.
const SMALL = 8e6;
let copy = null;

const remembered = (value) => {
  try {
    if (value) localStorage.setItem(COPY, value);
    return localStorage.getItem(COPY);
  } catch { return value || null; }
};

const megabytes = (bytes) => Math.max(0.1, bytes / 1e6).toLocaleString(language, { maximumFractionDigits: bytes < 1e7 ? 1 : 0 });

async function wish(what) {
  if (what !== "forget") {
    const found = await navigator.serviceWorker.register(ROOT + "sw.js", { updateViaCache: "none" });
    await navigator.serviceWorker.ready;
    if (!found.active) return;
  }
  const registration = await navigator.serviceWorker.getRegistration(ROOT);
  if (registration && registration.active) registration.active.postMessage(what === "forget" || what === "all" || what === "state" ? { wish: what } : { wish: "visited", names: what });
}

// Keeps a copy: the search, and what this page shows. `changed` is called with the state of the copy.
function keepCopy(changed) {
  if (!/^https?:$/.test(location.protocol)) return;
  document.head.append(el("link", { rel: "manifest", href: ROOT + "manifest.webmanifest" }));
  if (!("serviceWorker" in navigator)) return;
  let isFirst = true;
  navigator.serviceWorker.addEventListener("message", (event) => {
    copy = event.data.forgotten ? { forgotten: true } : event.data;
    const whole = remembered() === "all" || (copy.bytes <= SMALL && !(navigator.connection && navigator.connection.saveData));
    if (isFirst && whole && copy.kept < copy.files) wish("all").catch(() => {});
    isFirst = false;
    changed();
  });
  if (remembered() === "none") { copy = { forgotten: true }; changed(); return; }
  const shown = performance.getEntriesByType("resource").map((it) => it.name);
  wish([location.href, ...shown]).catch(() => {});
}

// The lines about the copy at the foot of the first page.
function copyLines() {
  const says = el("span", { role: "status" });
  const all = el("button", { type: "button", onclick: () => {
    remembered("all");
    if (navigator.storage && navigator.storage.persist) navigator.storage.persist();
    copy = { busy: true, kept: 0, files: copy.files || 0 };
    draw();
    wish("all").catch(() => {});
  } });
  const none = el("button", { type: "button", onclick: () => { remembered("none"); wish("forget").catch(() => {}); } });
  const line = el("p", { class: "row", hidden: true }, says, all, none);
  function draw() {
    line.hidden = !copy;
    if (!copy) return;
    const { forgotten, busy, failed, files, kept, bytes } = copy;
    const done = !forgotten && files > 0 && kept >= files;
    says.textContent = forgotten ? t("copy-none") : busy ? t(files ? "copy-busy" : "copy-begins", { kept, files }) : done ? t("copy-all") : failed ? t("copy-failed", { kept, files }) : t("copy-part");
    all.hidden = busy || done;
    all.textContent = bytes ? t("copy-keep", { size: megabytes(bytes) }) : t("copy-again");
    none.hidden = Boolean(forgotten);
    none.textContent = t("copy-forget");
  }
  return { line, draw };
}
